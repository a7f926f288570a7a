/// The contact operator of two bodies in space: slave surface (lower face of the top body) on master surface
/// (upper face of the bottom body), each in the frame of its plate. Everything is evaluated in the slave's
/// frame, which turns with the top plate about its axis (THEORY, section 3.7):
///
///     x = X + u + travel e_z,    y = R (X + u) - Q_s^T c,    R = Q_s^T Q_m,    Q the plates' rotations, c
///     the axis
///
/// With D = D_a and M_m = M_am, constant lambda in this frame where nothing changes (next to a crease x,
/// du/dt and D are those of two nodes, THEORY, section 3.6):
///
///     gap = n . (sum_m M_m y_m / D - x)
///     v   = (Omega_s - Omega_m) e_z x x - Omega_m e_z x Q_s^T c + du/dt + travel rate - sum_m M_m R du_m/dt
///     / D residual rows (internal minus external force):  slave -D lambda,  master +M_m R^T lambda,
///     condition D C
///
/// Both frames' velocities are taken at the slave's point: a common rotation is exactly no sliding, however
/// far the plates turn.
///
/// Each holds both surfaces whole, so any process can evaluate any of the slave nodes. The Jacobian comes
/// facet by facet, as blocks that add up.
#pragma once

#include "tribogel/contact/node/condition_slope.hpp"
#include "tribogel/contact/node/state.hpp"
#include "tribogel/contact/surface/area.hpp"
#include "tribogel/contact/surface/element_mortar.hpp"
#include "tribogel/contact/surface/geometry.hpp"
#include "tribogel/contact/surface/mortar_kernel.hpp"
#include "tribogel/contact/surface/normals.hpp"
#include "tribogel/contact/surface/rolling.hpp"
#include "tribogel/contact/surface/search.hpp"

#include <limits>
#include <span>

namespace tribogel
{

class SurfaceContact
{
public:
  using Pairs = std::vector<std::pair<int, int>>;

  SurfaceContact() = default;
  explicit SurfaceContact(SurfaceGeometry reference) : geometry(std::move(reference)) {}

  const SurfaceGeometry &reference() const { return geometry; }

  /// Sorted pairs of facets for `update`; they remain sufficient while the surfaces slide by less than margin
  /// [mm].
  Pairs candidate_pairs(const ContactState<double> &state, double margin) const
  {
    const Placed at = place(state);
    std::vector<Vector3<double>> n;
    for (int a = 0; a < geometry.slave_surface.node_count(); ++a)
      n.push_back(quad_normal(geometry.slave_surface, a, at.x, false).n);
    return tribogel::candidate_pairs(geometry.slave_surface, at.x, n, geometry.master_surface, at.y, margin);
  }

  /// Facets of a wall that may touch (surface/rolling.hpp); `on_crease` marks the slave's nodes there.
  RollingFacets rolling_facets(const ContactState<double> &state, const std::vector<bool> &on_crease) const
  {
    const Placed at = place(state);
    return tribogel::rolling_facets(geometry.slave_surface, at.x, on_crease, geometry.master_surface, at.y);
  }

  /// Evaluate the mortar integrals that the slave nodes first <= a < last need (all by default).
  MortarReport update(const ContactState<double> &state, const Pairs &pairs, bool derivatives, int first = 0,
                      int last = -1);

  /// Residual of slave node a. Without a multiplier the row is lambda = 0.
  void node(int a, const Friction &law, NodeBlock &block) const;

  /// d residual / d (u, lambda), with d rate / d u = shift, of the nodes given to update(derivatives = true),
  /// in blocks for `emit`.
  template <class Emit> void jacobian(const Friction &law, const Emit &emit) const;

  /// Rows and columns of the blocks that `jacobian` can emit as long as `pairs` are sufficient.
  template <class Emit> void pattern(const Pairs &pairs, int first, int last, const Emit &emit) const;

  /// d residual / d angle of the slave's plate, whose rate changes by shift times as much: `add` gets rows
  /// and parts that add up (surface/turn_slope.hpp).
  template <class Add> void turn_slope(const Friction &law, const Add &add) const;

  NodeResult result(int a, const Friction &law) const;

  /// Force along z and torque about the slave's axis on the slave's node a [N, N mm].
  std::pair<double, double> resultant(int a) const
  {
    if (!geometry.nodes[a].carries) return {0, 0};
    const Vector3<double> force = geometry.nodes[a].weight() * now.multiplier[a];
    return {force[2], mean(a, placed.x).cross(force)[2]};
  }

  SurfacePlace slave_place(int a) const
  {
    Vector3<double> at = geometry.slave.X[a] + now.slave.u[a];
    at[2] += now.slave.travel;
    return place_about_axis(geometry.slave.X[a], at);
  }
  SurfacePlace master_place(int b) const
  {
    Vector3<double> at = geometry.master.X[b] + now.master.u[b];
    at[2] += now.master.travel;
    return place_about_axis(geometry.master.X[b], at);
  }

  // What both models' operators tell of the slave: a node's constants, the surface's size and that of a
  // facet.
  const SlaveNode &constants(int a) const { return geometry.nodes[a]; }
  double slave_size() const { return geometry.slave_area; } ///< [mm^2]
  double facet_size() const
  {
    return std::sqrt(geometry.slave_area / static_cast<double>(geometry.slave.facets.size()));
  }

private:
  struct Placed {
    std::vector<Vector3<double>> x, y;
    Matrix3<double> R;     ///< from the master's frame to the slave's
    Vector3<double> shift; ///< - Q_s^T c
  };
  struct PairPart {
    int master;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> M, dM; ///< as QuadPairMortar
  };
  /// Row a of the mortar matrix and what follows from it.
  struct NodeContact {
    std::vector<int> masters;
    std::vector<double> M; ///< [mm^2]
    double gap = 0;        ///< [mm]
    Vector3<double> arm;   ///< from x to the projected point [mm]
    Vector3<double> velocity;
    QuadArea area; ///< only if the law needs it
    double area_ratio = 1;
  };

  SurfaceGeometry geometry;
  ContactState<double> now;
  Placed placed;
  int first_node = 0, last_node = 0;
  std::vector<QuadNormal> normal;
  std::vector<std::vector<PairPart>> facets; ///< of each slave facet, those that were asked for

  /// The angle moved is the smaller one, which has no jump at the half turn.
  static SurfacePlace place_about_axis(const Vector3<double> &X, const Vector3<double> &x)
  {
    const double Theta = std::atan2(X[1], X[0]);
    const double moved = std::atan2(X[0] * x[1] - X[1] * x[0], X[0] * x[0] + X[1] * x[1]);
    return {{std::hypot(X[0], X[1]), Theta, X[2]}, {std::hypot(x[0], x[1]), Theta + moved, x[2]}};
  }

  static Matrix3<double> turned(double angle)
  {
    Matrix3<double> Q = Matrix3<double>::Identity();
    Q(0, 0) = Q(1, 1) = std::cos(angle);
    Q(1, 0) = std::sin(angle);
    Q(0, 1) = -Q(1, 0);
    return Q;
  }

  Placed place(const ContactState<double> &state) const
  {
    Placed at;
    at.R = turned(state.master.rotation - state.slave.rotation);
    at.shift = turned(-state.slave.rotation) * Vector3<double>(-state.slave_axis[0], -state.slave_axis[1], 0);
    for (std::size_t a = 0; a < geometry.slave.X.size(); ++a) {
      at.x.push_back(geometry.slave.X[a] + state.slave.u[a]);
      at.x.back()[2] += state.slave.travel;
    }
    for (std::size_t b = 0; b < geometry.master.X.size(); ++b) {
      at.y.push_back(at.R * (geometry.master.X[b] + state.master.u[b]) + at.shift);
      at.y.back()[2] += state.master.travel;
    }
    return at;
  }

  /// Whether slave facet f belongs to a node of this range.
  bool is_wanted(int f, int first, int last) const
  {
    if (!geometry.slave_surface.takes_part(f)) return false;
    for (int b = 0; b < geometry.slave_surface.facet_nodes(); ++b) {
      const int a = geometry.slave_surface.facets[f][b];
      if (a >= first && a < last) return true;
    }
    return false;
  }

  template <int order>
  void integrate(int f, std::span<const std::pair<int, int>> pairs, bool derivatives, MortarReport &report,
                 double &overhang);
  NodeContact contact_of(int a, bool with_area, bool derivatives) const;
  ContactPoint<double> point_of(int a, const NodeContact &contact) const
  {
    return {now.multiplier[a], normal[a].n, contact.gap, contact.velocity, contact.area_ratio};
  }
  /// What node a's multiplier acts on: the node itself, and the crease node tied to it.
  std::vector<std::pair<int, double>> shares(int a) const
  {
    const SlaveNode &node = geometry.nodes[a];
    if (node.tied < 0) return {{a, node.D}};
    return {{a, node.D}, {node.tied, node.tied_D}};
  }
  Vector3<double> mean(int a, const std::vector<Vector3<double>> &field) const
  {
    Vector3<double> sum = Vector3<double>::Zero();
    for (const auto &[b, D] : shares(a)) sum += D / geometry.nodes[a].weight() * field[b];
    return sum;
  }
  ContactScale scale_of(int a) const
  {
    return {geometry.nodes[a].c_N, geometry.nodes[a].c_N / now.stick_rate};
  }
  using Slope = Eigen::Matrix<double, 3, 11>; ///< of the condition, as condition_slope gives it
  template <class Emit>
  void emit_node(int a, const NodeContact &contact, const Slope &slope, const Emit &emit) const;
  template <class Emit> void emit_facet(int f, const std::vector<Slope> &slope, const Emit &emit) const;
  struct FacetUnknowns;
  FacetUnknowns unknowns_of(int f, int first, int last, const std::vector<int> &master_facets) const;
};

inline MortarReport SurfaceContact::update(const ContactState<double> &state, const Pairs &pairs,
                                           bool derivatives, int first, int last)
{
  const QuadSurface &surface = geometry.slave_surface;
  now = state;
  placed = place(state);
  first_node = first;
  last_node = last < 0 ? surface.node_count() : last;
  normal.clear();
  for (int a = 0; a < surface.node_count(); ++a)
    normal.push_back(quad_normal(surface, a, placed.x, derivatives));
  facets.assign(static_cast<std::size_t>(surface.facet_count()), {});
  MortarReport report;
  for (int f = 0; f < surface.facet_count(); ++f) {
    if (!is_wanted(f, first_node, last_node)) continue;
    const auto run = std::equal_range(pairs.begin(), pairs.end(), std::pair(f, 0),
                                      [](const auto &l, const auto &r) { return l.first < r.first; });
    const std::span<const std::pair<int, int>> own(run.first, run.second);
    double overhang = 0;
    if (surface.order == 1)
      integrate<1>(f, own, derivatives, report, overhang);
    else
      integrate<2>(f, own, derivatives, report, overhang);
    const int counts_at = surface.facets[f][0];
    if (counts_at >= first_node && counts_at < last_node) report.overhang += overhang;
  }
  return report;
}

template <int order>
void SurfaceContact::integrate(int f, std::span<const std::pair<int, int>> pairs, bool derivatives,
                               MortarReport &report, double &overhang)
{
  constexpr double coverage_tolerance = 1e-8; // of the square's area 4
  const auto &measure = std::get<std::vector<QuadMeasure<order>>>(geometry.measures)[f];
  QuadPair<order> pair;
  pair.x = geometry.slave_surface.on_facet<order>(f, placed.x);
  for (std::size_t b = 0; b < pair.n.size(); ++b) pair.n[b] = normal[geometry.slave_surface.facets[f][b]].n;
  MortarStatus status = MortarStatus::ok;
  double covered = 0;
  const auto keep = [&](int master, QuadPairMortar<order> &&part) {
    if (status == MortarStatus::ok) status = part.status;
    if (part.covered == 0) return;
    covered += part.covered;
    overhang += part.overhang;
    facets[f].push_back({master, part.M, std::move(part.dM)});
  };
  if (!geometry.neighbourhood.empty()) pair.neighbourhood = geometry.neighbourhood[f];
  std::vector<QuadPair<order>> all;
  for (const auto &[slave, master] : pairs) {
    pair.y = geometry.master_surface.on_facet<order>(master, placed.y);
    pair.beyond = geometry.beyond[master];
    if (geometry.exact_cells)
      keep(master, quad_pair_mortar<order>(measure, pair, derivatives));
    else
      all.push_back(pair);
  }
  if (!geometry.exact_cells) {
    auto parts = quad_element_mortar<order>(measure, all, derivatives);
    for (std::size_t k = 0; k < pairs.size(); ++k) keep(pairs[k].second, std::move(parts[k]));
  }
  if (status == MortarStatus::ok && !(std::abs(covered - 4) <= 4 * coverage_tolerance))
    status = MortarStatus::uncovered;
  if (status != MortarStatus::ok) report.add_failure(status, f);
}

inline SurfaceContact::NodeContact SurfaceContact::contact_of(int a, bool with_area, bool derivatives) const
{
  const SlaveNode &own = geometry.nodes[a];
  NodeContact contact;
  if (with_area) {
    contact.area = nodal_area(geometry.slave_surface, a, own.tied, placed.x, derivatives);
    contact.area_ratio = contact.area.value / own.weight();
  }
  for (const auto &[f, local] : geometry.slave_surface.neighbours[a])
    for (const PairPart &part : facets[f])
      for (int b = 0; b < geometry.master_surface.facet_nodes(); ++b) {
        const int m = geometry.master_surface.facets[part.master][b];
        const auto known = std::find(contact.masters.begin(), contact.masters.end(), m);
        const auto k = static_cast<std::size_t>(known - contact.masters.begin());
        if (known == contact.masters.end()) contact.masters.push_back(m), contact.M.push_back(0);
        contact.M[k] += part.M(local, b);
      }
  const double D = own.weight(), spin = now.slave.rotation_rate - now.master.rotation_rate;
  const Vector3<double> x = mean(a, placed.x);
  contact.arm = -x;
  contact.velocity = mean(a, now.slave.rate);
  contact.velocity +=
      Vector3<double>(-spin * x[1], spin * x[0], now.slave.travel_rate - now.master.travel_rate);
  contact.velocity += now.master.rotation_rate * Vector3<double>(-placed.shift[1], placed.shift[0], 0);
  Vector3<double> master_rate = Vector3<double>::Zero();
  for (std::size_t k = 0; k < contact.masters.size(); ++k) {
    contact.arm += contact.M[k] / D * placed.y[contact.masters[k]];
    master_rate += contact.M[k] / D * now.master.rate[contact.masters[k]];
  }
  contact.velocity -= placed.R * master_rate;
  contact.gap = normal[a].n.dot(contact.arm);
  return contact;
}

inline void SurfaceContact::node(int a, const Friction &law, NodeBlock &block) const
{
  const auto &constants = geometry.nodes[a];
  const Vector3<double> &lambda = now.multiplier[a];
  block.slave_nodes = {a};
  block.slave_rows = 1;
  block.master_nodes.clear();
  block.status = ContactStatus::open;
  if (!constants.carries) {
    block.residual.setZero(6);
    block.residual.tail<3>() = constants.extent * lambda;
    return;
  }
  const NodeContact contact = contact_of(a, !law.linear_in_pressure(), false);
  const auto condition =
      contact_condition<double>(point_of(a, contact), scale_of(a), now.friction_at(a, law));
  const Vector3<double> on_master = placed.R.transpose() * lambda;
  const auto on = shares(a);
  const auto slaves = static_cast<Eigen::Index>(on.size()),
             masters = static_cast<Eigen::Index>(contact.masters.size());
  if (slaves == 2) block.slave_nodes.push_back(on[1].first);
  block.slave_rows = static_cast<int>(slaves);
  block.master_nodes = contact.masters;
  block.status = condition.status;
  block.residual.resize(3 * (slaves + masters + 1));
  for (Eigen::Index k = 0; k < slaves; ++k) block.residual.segment<3>(3 * k) = -on[k].second * lambda;
  for (Eigen::Index k = 0; k < masters; ++k)
    block.residual.segment<3>(3 * (slaves + k)) = contact.M[k] * on_master;
  block.residual.tail<3>() = constants.weight() * condition.residual;
}

inline NodeResult SurfaceContact::result(int a, const Friction &law) const
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto &constants = geometry.nodes[a];
  const Vector3<double> none = Vector3<double>::Constant(nan);
  if (!constants.carries)
    return {false, ContactStatus::open, constants.weight(), nan, nan, nan, none, none, none, none};
  const NodeContact contact = contact_of(a, true, false);
  const Vector3<double> &lambda = now.multiplier[a], &n = normal[a].n;
  const double area = contact.area.value;
  const Vector3<double> cauchy = constants.weight() / area * lambda;
  const auto condition =
      contact_condition<double>(point_of(a, contact), scale_of(a), now.friction_at(a, law));
  const Matrix3<double> own = turned(-std::atan2(placed.x[a][1], placed.x[a][0])); // to (r, theta, z)
  return {true,         condition.status, constants.weight(),
          area,         contact.gap,      -cauchy.dot(n),
          own * lambda, own * cauchy,     own * (contact.velocity - contact.velocity.dot(n) * n),
          own * n};
}

} // namespace tribogel

#include "tribogel/contact/surface/jacobian.hpp"
