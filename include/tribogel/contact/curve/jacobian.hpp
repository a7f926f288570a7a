/// Jacobian of one slave node's rows: the derivatives of the facets' mortar integrals and of the nodal
/// normals, known each with respect to its own few nodes, carried by the chain rule to gap, velocity, forces
/// and conditions.
#pragma once

#include "tribogel/contact/curve/node.hpp"

namespace tribogel
{

/// Slave nodes whose positions the rows of node a depend on, a first, then the crease node tied to it: those
/// of its facets, and of the facets beside them, through the nodal normals.
inline std::vector<int> slave_neighbourhood(const CurveGeometry &geometry, int a)
{
  const LineChain &chain = geometry.slave_chain;
  std::vector<int> nodes{a};
  if (geometry.nodes[a].tied >= 0) nodes.push_back(geometry.nodes[a].tied);
  for (int k = 0; k < chain.neighbours[a].count; ++k)
    for (int b = 0; b < chain.facet_nodes; ++b) {
      const int node = chain.facets[chain.neighbours[a].of[k].facet][b];
      const NormalStencil stencil = normal_stencil(chain, node, geometry.nodes[node].on_axis);
      index_in(nodes, node);
      for (int q = 0; q < stencil.count; ++q) index_in(nodes, stencil.node[q]);
    }
  return nodes;
}

/// What the derivative needs; the columns are those of NodeBlock.
class NodeDerivative
{
public:
  NodeDerivative(const CurveGeometry &contact_geometry, const ContactState<double> &state,
                 const NodeContact<double> &contact, const std::vector<PlanePoint<double>> &master_positions,
                 const std::vector<NormalWithDerivative> &normal_derivatives,
                 const std::vector<FacetMortar<double>> &facet_integrals, int slave,
                 std::vector<int> columns_of_slaves)
      : geometry(contact_geometry), now(state), node(contact), y(master_positions), dn(normal_derivatives),
        facets(facet_integrals), a(slave), is_tied(geometry.nodes[slave].tied >= 0),
        slaves(std::move(columns_of_slaves)), master_column(3 * static_cast<int>(slaves.size())),
        unknowns(master_column + 3 * static_cast<int>(node.masters.size()))
  {
  }

  /// `condition` is d (D C) / d (multiplier, gap, velocity, normal).
  void assemble(const Eigen::Matrix<double, 3, 10> &condition, Eigen::MatrixXd &J) const
  {
    const double L = geometry.twist_length, D[2] = {geometry.nodes[a].D, geometry.nodes[a].tied_D};
    const Vector3<double> &lambda = now.multiplier[a];
    const Vector3<double> force = conjugate_force<double>(lambda, node.x.r, L);
    const Vector3<double> unit(1, node.x.r / L, 1); // d force / d lambda
    const int masters = static_cast<int>(node.masters.size()), slave_rows = is_tied ? 2 : 1;
    const Eigen::MatrixXd dM = mortar_row();
    J.setZero(3 * (slave_rows + masters + 1), unknowns + 3);
    for (int k = 0; k < slave_rows; ++k) {
      J(3 * k + 1, 0) = -D[k] * lambda[1] / L;
      J.block<3, 3>(3 * k, unknowns).diagonal() = -D[k] * unit;
    }
    for (int k = 0; k < masters; ++k) {
      const int row = 3 * (slave_rows + k);
      J.block(row, 0, 3, unknowns) = force * dM.row(k);
      J(row + 1, 0) += node.M[k] * lambda[1] / L;
      J.block<3, 3>(row, unknowns).diagonal() = node.M[k] * unit;
    }
    J.bottomLeftCorner(3, unknowns) = condition.rightCols<7>() * point(dM);
    J.bottomRightCorner<3, 3>() = condition.leftCols<3>();
  }

private:
  using PointDerivative = Eigen::Matrix<double, 7, Eigen::Dynamic>;

  const CurveGeometry &geometry;
  const ContactState<double> &now;
  const NodeContact<double> &node;
  const std::vector<PlanePoint<double>> &y;
  const std::vector<NormalWithDerivative> &dn;
  const std::vector<FacetMortar<double>> &facets;
  int a;
  bool is_tied;
  std::vector<int> slaves;
  int master_column, unknowns;

  static int place(const std::vector<int> &list, int entry)
  {
    return static_cast<int>(std::find(list.begin(), list.end(), entry) - list.begin());
  }
  /// Column of coordinate q % 2 (r, z) of the q / 2-th node that a normal depends on.
  int column_of(const NormalStencil &stencil, int q) const
  {
    return 3 * place(slaves, stencil.node[q / 2]) + 2 * (q % 2);
  }

  /// d M_am / d u, one row for each master.
  Eigen::MatrixXd mortar_row() const
  {
    const LineChain &chain = geometry.slave_chain;
    Eigen::MatrixXd dM = Eigen::MatrixXd::Zero(node.masters.size(), unknowns);
    for (int k = 0; k < chain.neighbours[a].count; ++k) {
      const auto [f, local] = chain.neighbours[a].of[k];
      const FacetMortar<double> &facet = facets[f];
      for (std::size_t j = 0; j < facet.masters.size(); ++j) {
        const auto d = facet.derivative.row(3 * j + local);
        auto row = dM.row(place(node.masters, facet.masters[j]));
        for (int b = 0; b < chain.facet_nodes; ++b) {
          const int slave = chain.facets[f][b], column = 3 * place(slaves, slave);
          row[column] += d[2 * b];
          row[column + 2] += d[2 * b + 1];
          const NormalWithDerivative &normal = dn[slave];
          for (int q = 0; q < 2 * normal.stencil.count; ++q)
            row[column_of(normal.stencil, q)] +=
                d[6 + 2 * b] * normal.n.r.d[q] + d[7 + 2 * b] * normal.n.z.d[q];
        }
        for (std::size_t l = 0; l < facet.masters.size(); ++l) {
          const int column = master_column + 3 * place(node.masters, facet.masters[l]);
          row[column] += d[12 + 2 * l];
          row[column + 2] += d[13 + 2 * l];
        }
      }
    }
    return dM;
  }

  /// d (gap, v_r, v_theta, v_z, n_r, n_theta, n_z) / d u.
  PointDerivative point(const Eigen::MatrixXd &dM) const
  {
    const auto &constants = geometry.nodes[a];
    const double D = constants.weight(), own[2] = {constants.D / D, constants.tied_D / D};
    const Vector3<double> lever(1, node.x.r / geometry.twist_length, 1);
    PointDerivative d = PointDerivative::Zero(7, unknowns);
    PlanePoint<double> arm; // gap = n . arm
    for (int k = 0; k < (is_tied ? 2 : 1); ++k) {
      const PlanePoint<double> x = position(geometry.slave, now.slave, slaves[k]);
      arm += PlanePoint<double>{-own[k] * x.r, -own[k] * x.z};
      d(0, 3 * k) -= own[k] * node.n.r;
      d(0, 3 * k + 2) -= own[k] * node.n.z;
      for (int i = 0; i < 3; ++i) d(1 + i, 3 * k + i) += own[k] * lever[i] * now.shift;
    }
    for (std::size_t k = 0; k < node.masters.size(); ++k) {
      const int m = node.masters[k], column = master_column + 3 * static_cast<int>(k);
      const double share = node.M[k] / D;
      arm += PlanePoint<double>{share * y[m].r, share * y[m].z};
      d.row(0) += dot(node.n, y[m]) / D * dM.row(k);
      d(0, column) += share * node.n.r;
      d(0, column + 2) += share * node.n.z;
      for (int i = 0; i < 3; ++i) {
        d.row(1 + i) -= lever[i] * now.master.rate[m][i] / D * dM.row(k);
        d(1 + i, column + i) -= lever[i] * share * now.shift;
      }
    }
    d(2, 0) += node.spin;
    const NormalWithDerivative &normal = dn[a];
    for (int q = 0; q < 2 * normal.stencil.count; ++q) {
      const int column = column_of(normal.stencil, q);
      d(0, column) += normal.n.r.d[q] * arm.r + normal.n.z.d[q] * arm.z;
      d(4, column) += normal.n.r.d[q];
      d(6, column) += normal.n.z.d[q];
    }
    return d;
  }
};

} // namespace tribogel
