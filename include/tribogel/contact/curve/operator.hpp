/// The contact operator of two coaxial bodies of revolution: slave curve (lower face of the top body) on
/// master curve (upper face of the bottom body), with twist. It holds both curves whole, so any process can
/// evaluate any of the slave nodes:
///
///     CurveContact contact({slave, master, parameters});
///     const auto pairs = contact.candidate_pairs(state, margin);
///     const auto report = contact.update(state, pairs, true, first, last);
///     for (int a = first; a < last; ++a) contact.node(a, law, block);    // add block.residual,
///     block.jacobian
///
/// What the rows mean: curve/node.hpp. The derivation: THEORY, section 3.
#pragma once

#include "tribogel/contact/curve/area.hpp"
#include "tribogel/contact/curve/jacobian.hpp"
#include "tribogel/contact/curve/search.hpp"
#include "tribogel/contact/node/condition_slope.hpp"

namespace tribogel
{

class CurveContact
{
public:
  CurveContact() = default;
  explicit CurveContact(CurveGeometry reference) : geometry(std::move(reference)) {}

  const CurveGeometry &reference() const { return geometry; }

  /// Sorted pairs of facets for `update`; they remain sufficient while the surfaces slide by less than margin
  /// [mm].
  std::vector<std::pair<int, int>> candidate_pairs(const ContactState<double> &state, double margin) const
  {
    const auto at = positions(geometry.slave, state.slave);
    return tribogel::candidate_pairs(geometry.slave_chain, at, normals(at), geometry.master_chain,
                                     positions(geometry.master, state.master), margin);
  }

  /// Evaluate the mortar integrals that the slave nodes first <= a < last need (all by default).
  MortarReport update(const ContactState<double> &state, FacetPairs pairs, bool derivatives, int first = 0,
                      int last = -1);

  /// The nodes that block.slave_nodes and block.master_nodes of node a can contain as long as `pairs` are
  /// sufficient.
  NodeBlock pattern(int a, FacetPairs pairs) const
  {
    NodeBlock block{.slave_nodes = {a},
                    .master_nodes = {},
                    .slave_rows = 1,
                    .residual = {},
                    .jacobian = {},
                    .status = {}};
    if (!geometry.nodes[a].carries) return block;
    block.slave_nodes = slave_neighbourhood(geometry, a);
    block.slave_rows = geometry.nodes[a].tied >= 0 ? 2 : 1;
    const LineChain &slave = geometry.slave_chain, &master = geometry.master_chain;
    for (int k = 0; k < slave.neighbours[a].count; ++k)
      for (const auto &[f, m] : pairs_of(pairs, slave.neighbours[a].of[k].facet))
        for (int b = 0; b < master.facet_nodes; ++b) index_in(block.master_nodes, master.facets[m][b]);
    return block;
  }

  /// Residual and, if `update` was asked for derivatives, Jacobian of slave node a. Without a multiplier the
  /// row is lambda = 0.
  void node(int a, const Friction &law, NodeBlock &block) const;

  /// d residual / d (u, lambda), with d rate / d u = shift, of the nodes given to update(derivatives = true),
  /// in blocks that add up for `emit`.
  template <class Emit> void jacobian(const Friction &law, const Emit &emit) const
  {
    NodeBlock block;
    for (int a = first_node; a < last_node; ++a) {
      node(a, law, block);
      ContactBlock all = unknowns_of(a, block);
      all.values = block.jacobian;
      emit(all);
    }
  }

  /// Rows and columns of the blocks that `jacobian` can emit as long as `pairs` are sufficient.
  template <class Emit> void pattern(FacetPairs pairs, int first, int last, const Emit &emit) const
  {
    for (int a = first; a < last; ++a) emit(unknowns_of(a, pattern(a, pairs)));
  }

  NodeResult result(int a, const Friction &law) const;

  /// Force along z and torque about it on the slave: (sum D lambda_z, sum r D lambda_theta) of node a [N, N
  /// mm]. The torque that opposes a rotation of the slave is the negative of the second.
  std::pair<double, double> resultant(int a) const
  {
    const Vector3<double> force = geometry.nodes[a].weight() * now.multiplier[a];
    if (!geometry.nodes[a].carries) return {0, 0};
    return {force[2], x[a].r * force[1]};
  }

  SurfacePlace slave_place(int a) const
  {
    const PlanePoint<double> &X = geometry.slave.X[a];
    return {{X.r, 0, X.z}, {x[a].r, now.slave.u[a][1] / geometry.twist_length, x[a].z}};
  }
  SurfacePlace master_place(int b) const
  {
    const PlanePoint<double> &X = geometry.master.X[b];
    return {{X.r, 0, X.z}, {y[b].r, now.master.u[b][1] / geometry.twist_length, y[b].z}};
  }

  // What both models' operators tell of the slave: a node's constants, the curve's size and that of a facet.
  const CurveGeometry::Node &constants(int a) const { return geometry.nodes[a]; }
  double slave_size() const { return geometry.slave_length; } ///< [mm]
  double facet_size() const
  {
    return geometry.slave_length / static_cast<double>(geometry.slave.facets.size());
  }

private:
  /// Rows and columns of a node's block in the order of NodeBlock::jacobian.
  static ContactBlock unknowns_of(int a, const NodeBlock &block)
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

  CurveGeometry geometry;
  int first_node = 0, last_node = 0;
  ContactState<double> now;
  bool with_derivatives = false;
  std::vector<PlanePoint<double>> x, y, n;
  std::vector<NormalWithDerivative> dn;
  std::vector<FacetMortar<double>> facets;

  std::vector<PlanePoint<double>> normals(const std::vector<PlanePoint<double>> &at) const
  {
    std::vector<PlanePoint<double>> normal;
    for (int a = 0; a < geometry.slave_chain.node_count(); ++a)
      normal.push_back(nodal_normal<double>(geometry.slave_chain, a, geometry.nodes[a].on_axis,
                                            [&](int b) { return at[b]; }));
    return normal;
  }
  NodeContact<double> contact_of(int a, const Friction &law) const
  {
    NodeContact<double> node;
    node.x = x[a];
    node.n = n[a];
    add_mortar_row(geometry.slave_chain, a, facets, node);
    add_kinematics(geometry, a, now, y, node);
    if (!law.linear_in_pressure()) {
      const auto &constants = geometry.nodes[a];
      node.area_ratio = nodal_area(geometry.slave_chain, a, constants.tied, x) / constants.weight();
    }
    return node;
  }
  bool is_folded(int f) const;
  template <int inputs>
  Eigen::Matrix<double, 3, inputs> slope_at(int a, const NodeContact<double> &contact,
                                            const Friction &law) const;
  void add_area_slope(int a, const Vector3<double> &condition, NodeBlock &block) const;
  void without_multiplier(int a, NodeBlock &block) const;
};

inline MortarReport CurveContact::update(const ContactState<double> &state, FacetPairs pairs,
                                         bool derivatives, int first, int last)
{
  const LineChain &chain = geometry.slave_chain;
  if (last < 0) last = chain.node_count();
  now = state;
  first_node = first;
  last_node = last;
  with_derivatives = derivatives;
  x = positions(geometry.slave, state.slave);
  y = positions(geometry.master, state.master);
  n = normals(x);
  dn.assign(derivatives ? chain.node_count() : 0, {});
  facets.assign(chain.facet_count(), {});

  std::vector<bool> wanted(chain.facet_count());
  for (int a = first; a < last; ++a)
    for (int k = 0; k < chain.neighbours[a].count; ++k) wanted[chain.neighbours[a].of[k].facet] = true;

  MortarReport report;
  for (int f = 0; f < chain.facet_count(); ++f) {
    if (!wanted[f]) continue;
    const FacetPairs candidates = pairs_of(pairs, f);
    if (derivatives) {
      for (int b = 0; b < chain.facet_nodes; ++b) {
        const int node = chain.facets[f][b];
        if (dn[node].n.z == 0)
          dn[node] = nodal_normal_derivative(chain, node, geometry.nodes[node].on_axis, x);
      }
      facets[f] = facet_mortar_derivative(geometry, f, candidates, x, n, y);
    } else
      facets[f] = facet_mortar<double>(geometry, f, candidates, x, n, y);
    if (facets[f].status == MortarStatus::ok && is_folded(f)) facets[f].status = MortarStatus::folded;
    if (facets[f].status != MortarStatus::ok) report.add_failure(facets[f].status, f);
    const int outer = chain.facets[f][1];
    if (outer >= first && outer < last) report.overhang += facets[f].overhang;
  }
  return report;
}

inline void CurveContact::node(int a, const Friction &any, NodeBlock &block) const
{
  if (!geometry.nodes[a].carries) return without_multiplier(a, block);
  const Friction law = now.friction_at(a, any);
  const NodeContact<double> contact = contact_of(a, law);
  const Vector3<double> &lambda = now.multiplier[a];
  const auto values = node_residual<double>(geometry, a, contact, lambda, now.stick_rate, law);
  block.slave_nodes = slave_neighbourhood(geometry, a);
  block.master_nodes = contact.masters;
  block.status = values.status;
  const auto &constants = geometry.nodes[a];
  block.slave_rows = constants.tied >= 0 ? 2 : 1;
  const int masters = static_cast<int>(contact.masters.size()), first_master = 3 * block.slave_rows;
  block.residual.resize(first_master + 3 * masters + 3);
  block.residual.head<3>() = values.slave;
  if (constants.tied >= 0) block.residual.segment<3>(3) = values.tied;
  for (int k = 0; k < masters; ++k) block.residual.segment<3>(first_master + 3 * k) = values.master[k];
  block.residual.tail<3>() = values.condition;
  if (!with_derivatives) return;

  const NodeDerivative derivative(geometry, now, contact, y, dn, facets, a, block.slave_nodes);
  if (law.linear_in_pressure()) return derivative.assemble(slope_at<10>(a, contact, law), block.jacobian);
  const Eigen::Matrix<double, 3, 11> slope = slope_at<11>(a, contact, law);
  derivative.assemble(slope.template leftCols<10>(), block.jacobian);
  add_area_slope(a, slope.col(10), block);
}

/// d (D C) / d (multiplier 0..2, gap 3, velocity 4..6, normal 7..9, area ratio 10).
template <int inputs>
Eigen::Matrix<double, 3, inputs> CurveContact::slope_at(int a, const NodeContact<double> &contact,
                                                        const Friction &law) const
{
  const auto &constants = geometry.nodes[a];
  const ContactPoint<double> point{
      now.multiplier[a], {contact.n.r, 0, contact.n.z}, contact.gap, contact.velocity, contact.area_ratio};
  return constants.weight() * condition_slope<inputs>(point, {constants.c_N, constants.c_N / now.stick_rate},
                                                      law, constants.on_axis);
}

/// Through the area ratio the conditions depend on the positions of the facets' nodes.
inline void CurveContact::add_area_slope(int a, const Vector3<double> &condition, NodeBlock &block) const
{
  const LineChain &chain = geometry.slave_chain;
  const int tied = geometry.nodes[a].tied;
  const double weight = geometry.nodes[a].weight();
  const auto slope = chain.facet_nodes == 2 ? nodal_area_derivative<2>(chain, a, tied, x, block.slave_nodes)
                                            : nodal_area_derivative<3>(chain, a, tied, x, block.slave_nodes);
  for (std::size_t b = 0; b < slope.size(); ++b) {
    const Eigen::Index column = 3 * static_cast<Eigen::Index>(b);
    block.jacobian.bottomRows<3>().col(column) += slope[b].r / weight * condition;
    block.jacobian.bottomRows<3>().col(column + 2) += slope[b].z / weight * condition;
  }
}

inline void CurveContact::without_multiplier(int a, NodeBlock &block) const
{
  const double scale = geometry.nodes[a].extent;
  block.slave_nodes = {a};
  block.slave_rows = 1;
  block.master_nodes.clear();
  block.status = ContactStatus::open;
  block.residual.setZero(6);
  block.residual.tail<3>() = scale * now.multiplier[a];
  if (!with_derivatives) return;
  block.jacobian.setZero(6, 6);
  block.jacobian.bottomRightCorner<3, 3>().diagonal().setConstant(scale);
}

/// At one of its ends the facet and the next one (on the axis: its mirror image) enclose less than a right
/// angle.
inline bool CurveContact::is_folded(int f) const
{
  const auto ends = [&]<int nodes>() {
    const auto points = geometry.slave_chain.on_facet<nodes>(f, x);
    bool folded = false;
    for (int end = 0; end < 2; ++end) {
      const PlanePoint<double> own = normal_of(interpolate(facet_shape<nodes>(2.0 * end - 1).dN, points));
      folded |= !(dot(own, n[geometry.slave_chain.facets[f][end]]) > std::numbers::sqrt2 / 2);
    }
    return folded;
  };
  return geometry.slave_chain.facet_nodes == 2 ? ends.operator()<2>() : ends.operator()<3>();
}

inline NodeResult CurveContact::result(int a, const Friction &any) const
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const Friction law = now.friction_at(a, any);
  const auto &constants = geometry.nodes[a];
  const Vector3<double> none = Vector3<double>::Constant(nan);
  if (!constants.carries)
    return {false, ContactStatus::open, constants.weight(), nan, nan, nan, none, none, none, none};
  const NodeContact<double> node = contact_of(a, law);
  const Vector3<double> &lambda = now.multiplier[a], normal(node.n.r, 0, node.n.z);
  const double area = nodal_area(geometry.slave_chain, a, constants.tied, x);
  const Vector3<double> cauchy = constants.weight() / area * lambda;
  const ContactStatus status = node_residual<double>(geometry, a, node, lambda, now.stick_rate, law).status;
  return {true,   status,   constants.weight(),
          area,   node.gap, -cauchy.dot(normal),
          lambda, cauchy,   node.velocity - node.velocity.dot(normal) * normal,
          normal};
}

} // namespace tribogel
