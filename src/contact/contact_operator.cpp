#include "contact/contact_operator.hpp"

#include "contact/kernels.hpp"
#include "contact/surface_reference.hpp"
#include "tribogel/contact/curve/operator.hpp"
#include "tribogel/contact/curve/rolling.hpp"
#include "tribogel/contact/surface/operator.hpp"
#include "tribogel/contact/surface/rolling.hpp"
#include "tribogel/contact/surface/turn_slope.hpp"

#include <algorithm>
#include <variant>

namespace tribogel
{

struct ContactOperator::Operators {
  std::variant<CurveContact, SurfaceContact> contact;
  Friction friction;
  CurveParameters curve; ///< parameters of either operator
  SurfaceParameters solid;
  std::vector<bool> carries;             ///< of each slave node: it has a multiplier, used or not
  std::vector<bool> on_crease, touching; ///< of a wall: nodes, facets

  bool in_half_plane() const { return contact.index() == 0; }
};

namespace
{

/// Rows and columns of a node's block in the order of NodeBlock::jacobian.
ContactBlock unknowns_of(int a, const NodeBlock &block)
{
  ContactBlock all;
  for (int k = 0; k < block.slave_rows; ++k)
    all.rows.push_back({ContactUnknown::slave, block.slave_nodes[static_cast<std::size_t>(k)]});
  for (int b : block.slave_nodes) all.columns.push_back({ContactUnknown::slave, b});
  for (int m : block.master_nodes) {
    all.rows.push_back({ContactUnknown::master, m});
    all.columns.push_back({ContactUnknown::master, m});
  }
  all.rows.push_back({ContactUnknown::multiplier, a});
  all.columns.push_back({ContactUnknown::multiplier, a});
  return all;
}

} // namespace

ContactOperator::ContactOperator(const Mesh &mesh, const Scene &scene, const Surface &slave,
                                 std::vector<bool> on_crease)
    : is(std::make_unique<Operators>())
{
  const bool wall = !on_crease.empty();
  const double softer = scene.softer_modulus();
  for (const SurfaceNode &node : slave.node) is->carries.push_back(node.multiplier);
  is->friction = scene.friction;
  is->on_crease = std::move(on_crease);
  is->touching.assign(slave.facet.size(), !wall);
  if (mesh.dim == 2) {
    is->curve = {.order = mesh.order,
                 .twist_length = scene.twist_length(),
                 .softer_modulus = softer,
                 .carries_multiplier = is->carries,
                 .facets_in_contact = wall ? 0 : -1,
                 .starts_at_crease = wall};
    is->contact = CurveContact(CurveGeometry(chain_of(slave), chain_of(mesh.master), is->curve));
  } else {
    is->solid = {.order = mesh.order,
                 .softer_modulus = softer,
                 .carries_multiplier = is->carries,
                 .exact_cells = scene.contact_integration == ContactIntegration::segments,
                 .left_out = std::vector<bool>(wall ? slave.facet.size() : 0, true),
                 .on_crease = is->on_crease};
    is->contact = SurfaceContact(SurfaceGeometry(quads_of(slave), quads_of(mesh.master), is->solid));
  }
}

ContactOperator::ContactOperator(ContactOperator &&) noexcept = default;
ContactOperator &ContactOperator::operator=(ContactOperator &&) noexcept = default;
ContactOperator::~ContactOperator() = default;

ContactOperator::Pairs ContactOperator::candidate_pairs(const ContactState<double> &state,
                                                        double margin) const
{
  return std::visit([&](const auto &contact) { return contact.candidate_pairs(state, margin); }, is->contact);
}

MortarReport ContactOperator::update(const ContactState<double> &state, const Pairs &pairs, bool derivatives,
                                     int first, int last)
{
  return std::visit([&](auto &contact) { return contact.update(state, pairs, derivatives, first, last); },
                    is->contact);
}

void ContactOperator::node(int a, NodeBlock &block) const
{
  std::visit([&](const auto &contact) { contact.node(a, is->friction, block); }, is->contact);
}

NodeResult ContactOperator::result(int a) const
{
  return std::visit([&](const auto &contact) { return contact.result(a, is->friction); }, is->contact);
}

std::pair<double, double> ContactOperator::resultant(int a) const
{
  return std::visit([&](const auto &contact) { return contact.resultant(a); }, is->contact);
}

SurfacePlace ContactOperator::slave_place(int a) const
{
  return std::visit([&](const auto &contact) { return contact.slave_place(a); }, is->contact);
}

SurfacePlace ContactOperator::master_place(int b) const
{
  return std::visit([&](const auto &contact) { return contact.master_place(b); }, is->contact);
}

/// A curve's blocks come node by node.
void ContactOperator::jacobian(int first, int last, const Emit &emit) const
{
  if (!is->in_half_plane()) return std::get<SurfaceContact>(is->contact).jacobian(is->friction, emit);
  NodeBlock block;
  for (int a = first; a < last; ++a) {
    if (!is->carries[a]) continue;
    node(a, block);
    ContactBlock all = unknowns_of(a, block);
    all.values = block.jacobian;
    emit(all);
  }
}

void ContactOperator::pattern(const Pairs &pairs, int first, int last, const Emit &emit) const
{
  if (!is->in_half_plane()) return std::get<SurfaceContact>(is->contact).pattern(pairs, first, last, emit);
  const auto &curve = std::get<CurveContact>(is->contact);
  for (int a = first; a < last; ++a)
    if (is->carries[a]) emit(unknowns_of(a, curve.pattern(a, pairs)));
}

/// The plate moves all of the slave's nodes alike: the sum of their columns. In the half plane an angle is an
/// unknown over the twist length; in space it turns frames.
void ContactOperator::motion_slopes(int first, int last, const AddSlope &add) const
{
  const double L = is->curve.twist_length;
  jacobian(first, last, [&](const ContactBlock &block) {
    for (std::size_t k = 0; k < block.columns.size(); ++k) {
      if (block.columns[k].kind != ContactUnknown::slave) continue;
      for (std::size_t i = 0; i < block.rows.size(); ++i) {
        const Eigen::Index row = 3 * static_cast<Eigen::Index>(i), column = 3 * static_cast<Eigen::Index>(k);
        add(travel, block.rows[i], block.values.block<3, 1>(row, column + 2));
        if (is->in_half_plane()) add(turn, block.rows[i], L * block.values.block<3, 1>(row, column + 1));
      }
    }
  });
  if (is->in_half_plane()) return;
  std::get<SurfaceContact>(is->contact)
      .turn_slope(is->friction,
                  [&](const ContactUnknown &row, const Vector3<double> &slope) { add(turn, row, slope); });
}

const Friction &ContactOperator::friction() const
{
  return is->friction;
}

const SlaveNode &ContactOperator::constants(int a) const
{
  return std::visit([&](const auto &contact) -> const SlaveNode & { return contact.constants(a); },
                    is->contact);
}

double ContactOperator::slave_size() const
{
  return std::visit([](const auto &contact) { return contact.slave_size(); }, is->contact);
}

double ContactOperator::facet_size() const
{
  return std::visit([](const auto &contact) { return contact.facet_size(); }, is->contact);
}

bool ContactOperator::is_wall() const
{
  return !is->on_crease.empty();
}

const std::vector<bool> &ContactOperator::on_crease() const
{
  return is->on_crease;
}

const std::vector<bool> &ContactOperator::touching() const
{
  return is->touching;
}

std::vector<bool> ContactOperator::touching_without(const std::vector<int> &failed) const
{
  std::vector<bool> facets = is->touching;
  for (int f : failed) facets[f] = false;
  if (!is->in_half_plane())
    return connected_to_crease(std::get<SurfaceContact>(is->contact).reference().slave_surface, is->on_crease,
                               facets);
  std::fill(std::find(facets.begin(), facets.end(), false), facets.end(), false);
  return facets;
}

void ContactOperator::touch(std::vector<bool> facets)
{
  if (facets == is->touching) return;
  is->touching = std::move(facets);
  if (is->in_half_plane()) {
    const CurveGeometry &old = std::get<CurveContact>(is->contact).reference();
    is->curve.facets_in_contact =
        static_cast<int>(std::count(is->touching.begin(), is->touching.end(), true));
    is->contact = CurveContact(CurveGeometry(old.slave, old.master, is->curve));
  } else {
    const SurfaceGeometry &old = std::get<SurfaceContact>(is->contact).reference();
    is->solid.left_out = is->touching;
    is->solid.left_out.flip();
    is->contact = SurfaceContact(SurfaceGeometry(old.slave, old.master, is->solid));
  }
}

void ContactOperator::roll(const ContactState<double> &state)
{
  if (is->in_half_plane()) {
    const CurveGeometry &geometry = std::get<CurveContact>(is->contact).reference();
    const LineChain whole(geometry.slave.facets, is->curve.order + 1,
                          static_cast<int>(geometry.slave.X.size()));
    const int count = rolling_facets(whole, positions(geometry.slave, state.slave), geometry.master_chain,
                                     positions(geometry.master, state.master));
    std::vector<bool> facets(is->touching.size(), false);
    std::fill_n(facets.begin(), count, true);
    touch(std::move(facets));
  } else {
    RollingFacets rolling = std::get<SurfaceContact>(is->contact).rolling_facets(state, is->on_crease);
    is->solid.neighbourhood = std::move(rolling.neighbourhood);
    is->touching.clear(); // rebuilt for the neighbourhoods too
    touch(std::move(rolling.touch));
  }
}

} // namespace tribogel
