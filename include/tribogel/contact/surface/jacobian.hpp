/// The Jacobian of SurfaceContact (its last part): blocks that add up, and where they can lie.
#pragma once

#include "tribogel/contact/surface/operator.hpp"

namespace tribogel
{

template <class Emit> void SurfaceContact::jacobian(const Friction &law, const Emit &emit) const
{
  std::vector<Slope> slope(normal.size());
  for (int a = first_node; a < last_node; ++a) {
    if (!geometry.nodes[a].carries) {
      emit(ContactBlock{{{ContactUnknown::multiplier, a}},
                        {{ContactUnknown::multiplier, a}},
                        geometry.nodes[a].extent * Matrix3<double>::Identity()});
      continue;
    }
    const NodeContact contact = contact_of(a, !law.linear_in_pressure(), true);
    slope[a] = geometry.nodes[a].weight() *
               condition_slope<11>(point_of(a, contact), scale_of(a), now.friction_at(a, law));
    emit_node(a, contact, slope[a], emit);
  }
  for (std::size_t f = 0; f < facets.size(); ++f)
    if (!facets[f].empty()) emit_facet(static_cast<int>(f), slope, emit);
}

/// What depends on the node's own unknowns, normal and multiplier, and on the masters with the mortar
/// integrals fixed.
template <class Emit>
void SurfaceContact::emit_node(int a, const NodeContact &contact, const Slope &slope, const Emit &emit) const
{
  using Kind = ContactUnknown;
  const double weight = geometry.nodes[a].weight(), spin = now.slave.rotation_rate - now.master.rotation_rate;
  const Vector3<double> by_gap = slope.col(3);
  const Matrix3<double> by_velocity = slope.middleCols<3>(4), by_normal = slope.middleCols<3>(7);
  const auto on = shares(a);
  for (const auto &[b, D] : on)
    emit(ContactBlock{{{Kind::slave, b}}, {{Kind::multiplier, a}}, -D * Matrix3<double>::Identity()});

  const auto masters = static_cast<Eigen::Index>(contact.masters.size());
  ContactBlock forces, conditions;
  forces.columns = {{Kind::multiplier, a}};
  conditions.rows = {{Kind::multiplier, a}};
  forces.values.resize(3 * masters, 3);
  for (Eigen::Index k = 0; k < masters; ++k) {
    forces.rows.push_back({Kind::master, contact.masters[k]});
    forces.values.middleRows<3>(3 * k) = contact.M[k] * placed.R.transpose();
  }
  emit(forces);

  conditions.columns = {{Kind::multiplier, a}};
  for (const auto &[b, D] : on) conditions.columns.push_back({Kind::slave, b});
  for (const auto &[b, d] : contact.area.d) conditions.columns.push_back({Kind::slave, b});
  for (const auto &[b, d] : normal[a].d) conditions.columns.push_back({Kind::slave, b});
  for (int m : contact.masters) conditions.columns.push_back({Kind::master, m});
  conditions.values.resize(3, 3 * static_cast<Eigen::Index>(conditions.columns.size()));
  Matrix3<double> own = now.shift * Matrix3<double>::Identity();
  own(0, 1) -= spin;
  own(1, 0) += spin;
  conditions.values.leftCols<3>() = slope.leftCols<3>();
  Eigen::Index column = 3;
  for (const auto &[b, D] : on) {
    conditions.values.middleCols<3>(column) =
        D / weight * (by_velocity * own - by_gap * normal[a].n.transpose());
    column += 3;
  }
  for (const auto &[b, d] : contact.area.d) {
    conditions.values.middleCols<3>(column) = slope.col(10) * d.transpose() / weight;
    column += 3;
  }
  const Matrix3<double> through_normal = by_normal + by_gap * contact.arm.transpose();
  for (const auto &[b, d] : normal[a].d) {
    conditions.values.middleCols<3>(column) = through_normal * d;
    column += 3;
  }
  const Matrix3<double> through_master =
      (by_gap * normal[a].n.transpose() - now.shift * by_velocity) * placed.R / weight;
  for (Eigen::Index k = 0; k < masters; ++k)
    conditions.values.middleCols<3>(column + 3 * k) = contact.M[k] * through_master;
  emit(conditions);
}

/// What the mortar integrals of a slave facet connect.
struct SurfaceContact::FacetUnknowns {
  std::vector<ContactUnknown>
      around; ///< slave nodes on which they depend: its own, then those of its normals
  std::vector<ContactUnknown> multipliers; ///< of its own nodes that are asked for
  std::vector<int> own;                    ///< local numbers of these nodes
  std::vector<ContactUnknown> masters;     ///< nodes of the master facets
  std::vector<std::vector<int>> place;     ///< of each master facet's nodes among `masters`

  /// Rows of all that depends on the slave's nodes.
  std::vector<ContactUnknown> rows() const
  {
    std::vector<ContactUnknown> all = masters;
    all.insert(all.end(), multipliers.begin(), multipliers.end());
    return all;
  }

  static int place_among(std::vector<ContactUnknown> &list, ContactUnknown entry)
  {
    const auto known = std::find(list.begin(), list.end(), entry);
    const auto at = static_cast<int>(known - list.begin());
    if (known == list.end()) list.push_back(entry);
    return at;
  }
};

inline SurfaceContact::FacetUnknowns SurfaceContact::unknowns_of(int f, int first, int last,
                                                                 const std::vector<int> &master_facets) const
{
  using Kind = ContactUnknown;
  const QuadSurface &surface = geometry.slave_surface, &other = geometry.master_surface;
  const int nodes = surface.facet_nodes();
  FacetUnknowns all;
  for (int b = 0; b < nodes; ++b) {
    const int a = surface.facets[f][b];
    FacetUnknowns::place_among(all.around, {Kind::slave, a});
    if (a < first || a >= last || !geometry.nodes[a].carries) continue;
    all.own.push_back(b);
    all.multipliers.push_back({Kind::multiplier, a});
  }
  for (int b = 0; b < nodes; ++b)
    for (const auto &at : surface.neighbours[surface.facets[f][b]])
      for (int c = 0; c < nodes; ++c)
        FacetUnknowns::place_among(all.around, {Kind::slave, surface.facets[at.facet][c]});
  for (int facet : master_facets) {
    all.place.emplace_back();
    for (int m = 0; m < nodes; ++m)
      all.place.back().push_back(
          FacetUnknowns::place_among(all.masters, {Kind::master, other.facets[facet][m]}));
  }
  return all;
}

/// What depends on the mortar integrals of slave facet f. With the derivative of M of each pair contracted
/// with lambda (forces on the masters) and with the slopes of the conditions, all pairs' dependence on the
/// slave's positions and normals is one block; that on the master's is one a pair.
template <class Emit>
void SurfaceContact::emit_facet(int f, const std::vector<Slope> &slope, const Emit &emit) const
{
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const QuadSurface &surface = geometry.slave_surface;
  const int nodes = surface.facet_nodes();
  std::vector<int> master_facets;
  for (const PairPart &part : facets[f]) master_facets.push_back(part.master);
  const FacetUnknowns is = unknowns_of(f, first_node, last_node, master_facets);
  const auto masters = static_cast<Eigen::Index>(is.masters.size()),
             own = static_cast<Eigen::Index>(is.own.size());
  Matrix by_own = Matrix::Zero(3 * (masters + own), 6 * nodes); // by the facet's positions and normals
  for (std::size_t k = 0; k < facets[f].size(); ++k) {
    const PairPart &part = facets[f][k];
    const std::vector<int> &place = is.place[k];
    ContactBlock block; // by the master's positions
    Matrix combine = Matrix::Zero(3 * (nodes + own), nodes * nodes);
    for (int m = 0; m < nodes; ++m) {
      const ContactUnknown &master = is.masters[place[m]];
      block.rows.push_back(master);
      block.columns.push_back(master);
      const Vector3<double> rate = placed.R * now.master.rate[master.node];
      for (Eigen::Index i = 0; i < own; ++i) {
        const int a = is.multipliers[i].node;
        const Eigen::Index entry = is.own[i] * nodes + m;
        combine.block<3, 1>(3 * m, entry) = placed.R.transpose() * now.multiplier[a];
        combine.block<3, 1>(3 * (nodes + i), entry) =
            (normal[a].n.dot(placed.y[master.node]) * slope[a].col(3) - slope[a].middleCols<3>(4) * rate) /
            geometry.nodes[a].weight();
      }
    }
    block.rows.insert(block.rows.end(), is.multipliers.begin(), is.multipliers.end());
    const Matrix raw = combine * part.dM; // by slave positions, normals, master positions
    for (int m = 0; m < nodes; ++m) by_own.middleRows<3>(3 * place[m]) += raw.block(3 * m, 0, 3, 6 * nodes);
    by_own.bottomRows(3 * own) += raw.block(3 * nodes, 0, 3 * own, 6 * nodes);
    block.values.resize(raw.rows(), 3 * nodes);
    for (int m = 0; m < nodes; ++m)
      block.values.middleCols<3>(3 * m) = raw.middleCols<3>(3 * (2 * nodes + m)) * placed.R;
    emit(block);
  }

  ContactBlock block;
  block.rows = is.rows();
  block.columns = is.around;
  Matrix normals =
      Matrix::Zero(3 * nodes, 3 * static_cast<Eigen::Index>(is.around.size())); // by the positions
  for (int b = 0; b < nodes; ++b)
    for (const auto &[c, d] : normal[surface.facets[f][b]].d) {
      const auto column =
          std::find(is.around.begin(), is.around.end(), ContactUnknown{ContactUnknown::slave, c});
      normals.block<3, 3>(3 * b, 3 * (column - is.around.begin())) += d;
    }
  block.values.noalias() = by_own.rightCols(3 * nodes) * normals;
  block.values.leftCols(3 * nodes) +=
      by_own.leftCols(3 * nodes); // `around` begins with the facet's own nodes
  emit(block);
}

template <class Emit>
void SurfaceContact::pattern(const Pairs &pairs, int first, int last, const Emit &emit) const
{
  using Kind = ContactUnknown;
  for (int a = first; a < last; ++a) {
    emit(ContactBlock{{{Kind::multiplier, a}}, {{Kind::multiplier, a}}, {}});
    if (!geometry.nodes[a].carries) continue;
    for (const auto &[b, D] : shares(a)) emit(ContactBlock{{{Kind::slave, b}}, {{Kind::multiplier, a}}, {}});
  }
  for (auto pair = pairs.begin(); pair != pairs.end();) {
    const int f = pair->first;
    std::vector<int> master_facets;
    for (; pair != pairs.end() && pair->first == f; ++pair) master_facets.push_back(pair->second);
    if (!is_wanted(f, first, last)) continue;
    const FacetUnknowns is = unknowns_of(f, first, last, master_facets);
    emit(ContactBlock{is.rows(), is.around, {}});
    if (!is.multipliers.empty()) {
      emit(ContactBlock{is.masters, is.multipliers, {}});
      emit(ContactBlock{is.multipliers, is.masters, {}});
    }
    for (const std::vector<int> &place : is.place) {
      ContactBlock masters;
      for (int m : place) masters.rows.push_back(is.masters[m]);
      masters.columns = masters.rows;
      emit(masters);
    }
  }
}

} // namespace tribogel
