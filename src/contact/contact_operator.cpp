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

ContactOperator::ContactOperator(const Mesh &mesh, const Scene &scene, const Surface &slave,
                                 std::vector<bool> on_crease)
    : impl(std::make_unique<Operators>())
{
  const bool wall = !on_crease.empty();
  const double softer = scene.softer_modulus();
  for (const SurfaceNode &node : slave.node) impl->carries.push_back(node.multiplier);
  impl->friction = scene.friction;
  impl->on_crease = std::move(on_crease);
  impl->touching.assign(slave.facet.size(), !wall);
  if (mesh.dim == 2) {
    impl->curve = {.order = mesh.order,
                   .twist_length = scene.twist_length(),
                   .softer_modulus = softer,
                   .carries_multiplier = impl->carries,
                   .facets_in_contact = wall ? 0 : -1,
                   .starts_at_crease = wall};
    impl->contact = CurveContact(CurveGeometry(chain_of(slave), chain_of(mesh.master), impl->curve));
  } else {
    impl->solid = {.order = mesh.order,
                   .softer_modulus = softer,
                   .carries_multiplier = impl->carries,
                   .exact_cells = scene.contact_integration == ContactIntegration::segments,
                   .left_out = std::vector<bool>(wall ? slave.facet.size() : 0, true),
                   .on_crease = impl->on_crease};
    impl->contact = SurfaceContact(SurfaceGeometry(quads_of(slave), quads_of(mesh.master), impl->solid));
  }
}

ContactOperator::ContactOperator(ContactOperator &&) noexcept = default;
ContactOperator &ContactOperator::operator=(ContactOperator &&) noexcept = default;
ContactOperator::~ContactOperator() = default;

ContactOperator::Pairs ContactOperator::candidate_pairs(const ContactState<double> &state,
                                                        double margin) const
{
  return std::visit([&](const auto &contact) { return contact.candidate_pairs(state, margin); },
                    impl->contact);
}

MortarReport ContactOperator::update(const ContactState<double> &state, const Pairs &pairs, bool derivatives,
                                     int first, int last)
{
  return std::visit([&](auto &contact) { return contact.update(state, pairs, derivatives, first, last); },
                    impl->contact);
}

void ContactOperator::node(int a, NodeBlock &block) const
{
  std::visit([&](const auto &contact) { contact.node(a, impl->friction, block); }, impl->contact);
}

NodeResult ContactOperator::result(int a) const
{
  return std::visit([&](const auto &contact) { return contact.result(a, impl->friction); }, impl->contact);
}

std::pair<double, double> ContactOperator::resultant(int a) const
{
  return std::visit([&](const auto &contact) { return contact.resultant(a); }, impl->contact);
}

SurfacePlace ContactOperator::slave_place(int a) const
{
  return std::visit([&](const auto &contact) { return contact.slave_place(a); }, impl->contact);
}

SurfacePlace ContactOperator::master_place(int b) const
{
  return std::visit([&](const auto &contact) { return contact.master_place(b); }, impl->contact);
}

void ContactOperator::jacobian(const Emit &emit) const
{
  std::visit([&](const auto &contact) { contact.jacobian(impl->friction, emit); }, impl->contact);
}

void ContactOperator::pattern(const Pairs &pairs, int first, int last, const Emit &emit) const
{
  std::visit([&](const auto &contact) { contact.pattern(pairs, first, last, emit); }, impl->contact);
}

/// The plate moves all of the slave's nodes alike: the sum of their columns. In the half plane an angle is an
/// unknown over the twist length; in space it turns frames.
void ContactOperator::motion_slopes(const AddSlope &add) const
{
  const double L = impl->curve.twist_length;
  jacobian([&](const ContactBlock &block) {
    for (std::size_t k = 0; k < block.columns.size(); ++k) {
      if (block.columns[k].kind != ContactUnknown::slave) continue;
      for (std::size_t i = 0; i < block.rows.size(); ++i) {
        const Eigen::Index row = 3 * static_cast<Eigen::Index>(i), column = 3 * static_cast<Eigen::Index>(k);
        add(travel, block.rows[i], block.values.block<3, 1>(row, column + 2));
        if (impl->in_half_plane()) add(turn, block.rows[i], L * block.values.block<3, 1>(row, column + 1));
      }
    }
  });
  if (impl->in_half_plane()) return;
  std::get<SurfaceContact>(impl->contact)
      .turn_slope(impl->friction,
                  [&](const ContactUnknown &row, const Vector3<double> &slope) { add(turn, row, slope); });
}

const Friction &ContactOperator::friction() const
{
  return impl->friction;
}

const SlaveNode &ContactOperator::constants(int a) const
{
  return std::visit([&](const auto &contact) -> const SlaveNode & { return contact.constants(a); },
                    impl->contact);
}

double ContactOperator::slave_size() const
{
  return std::visit([](const auto &contact) { return contact.slave_size(); }, impl->contact);
}

double ContactOperator::facet_size() const
{
  return std::visit([](const auto &contact) { return contact.facet_size(); }, impl->contact);
}

bool ContactOperator::is_wall() const
{
  return !impl->on_crease.empty();
}

const std::vector<bool> &ContactOperator::on_crease() const
{
  return impl->on_crease;
}

const std::vector<bool> &ContactOperator::touching() const
{
  return impl->touching;
}

std::vector<bool> ContactOperator::touching_without(const std::vector<int> &failed) const
{
  std::vector<bool> facets = impl->touching;
  for (int f : failed) facets[f] = false;
  if (!impl->in_half_plane())
    return connected_to_crease(std::get<SurfaceContact>(impl->contact).reference().slave_surface,
                               impl->on_crease, facets);
  std::fill(std::find(facets.begin(), facets.end(), false), facets.end(), false);
  return facets;
}

void ContactOperator::touch(std::vector<bool> facets)
{
  if (facets == impl->touching) return;
  impl->touching = std::move(facets);
  if (impl->in_half_plane()) {
    const CurveGeometry &old = std::get<CurveContact>(impl->contact).reference();
    impl->curve.facets_in_contact =
        static_cast<int>(std::count(impl->touching.begin(), impl->touching.end(), true));
    impl->contact = CurveContact(CurveGeometry(old.slave, old.master, impl->curve));
  } else {
    const SurfaceGeometry &old = std::get<SurfaceContact>(impl->contact).reference();
    impl->solid.left_out = impl->touching;
    impl->solid.left_out.flip();
    impl->contact = SurfaceContact(SurfaceGeometry(old.slave, old.master, impl->solid));
  }
}

void ContactOperator::roll(const ContactState<double> &state)
{
  if (impl->in_half_plane()) {
    const CurveGeometry &geometry = std::get<CurveContact>(impl->contact).reference();
    const LineChain whole(geometry.slave.facets, impl->curve.order + 1,
                          static_cast<int>(geometry.slave.X.size()));
    const int count = rolling_facets(whole, positions(geometry.slave, state.slave), geometry.master_chain,
                                     positions(geometry.master, state.master));
    std::vector<bool> facets(impl->touching.size(), false);
    std::fill_n(facets.begin(), count, true);
    touch(std::move(facets));
  } else {
    RollingFacets rolling = std::get<SurfaceContact>(impl->contact).rolling_facets(state, impl->on_crease);
    impl->solid.neighbourhood = std::move(rolling.neighbourhood);
    impl->touching.clear(); // rebuilt for the neighbourhoods too
    touch(std::move(rolling.touch));
  }
}

} // namespace tribogel
