/// Jacobian of one slave node's rows: the derivatives of the facets' mortar integrals and of the nodal normals, known
/// each with respect to its own few nodes, carried by the chain rule to gap, velocity, forces and conditions.
#pragma once

#include "tribogel/contact/axisymmetric_node.hpp"

namespace tribogel
{

/// Slave nodes whose positions the rows of node a depend on, a first: those of its facets, and of the facets beside
/// them, through the nodal normals.
inline std::vector<int> slave_neighbourhood(const ContactGeometry &geometry, int a)
{
  const LineChain &chain = geometry.slave_chain;
  std::vector<int> nodes{a};
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
  NodeDerivative(const ContactGeometry &contact_geometry, const ContactState<double> &state,
                 const NodeContact<double> &contact, const std::vector<PlanePoint<double>> &master_positions,
                 const std::vector<NormalWithDerivative> &normal_derivatives,
                 const std::vector<FacetMortar<double>> &facet_integrals, int slave, std::vector<int> columns_of_slaves)
      : geometry(contact_geometry), now(state), node(contact), y(master_positions), dn(normal_derivatives),
        facets(facet_integrals), a(slave), slaves(std::move(columns_of_slaves)),
        master_column(3 * static_cast<int>(slaves.size())),
        unknowns(master_column + 3 * static_cast<int>(node.masters.size()))
  {
  }

  /// `condition` is d (D C) / d (multiplier, gap, velocity, normal).
  void assemble(const Eigen::Matrix<double, 3, 10> &condition, Eigen::MatrixXd &J) const
  {
    const double D = geometry.nodes[a].D, L = geometry.twist_length;
    const Vector3<double> &lambda = now.multiplier[a];
    const Vector3<double> force = conjugate_force<double>(lambda, node.x.r, L);
    const Vector3<double> unit(1, node.x.r / L, 1); // d force / d lambda
    const int masters = static_cast<int>(node.masters.size());
    const Eigen::MatrixXd dM = mortar_row();
    J.setZero(6 + 3 * masters, unknowns + 3);
    J(1, 0) = -D * lambda[1] / L;
    J.block<3, 3>(0, unknowns).diagonal() = -D * unit;
    for (int k = 0; k < masters; ++k) {
      J.block(3 + 3 * k, 0, 3, unknowns) = force * dM.row(k);
      J(4 + 3 * k, 0) += node.M[k] * lambda[1] / L;
      J.block<3, 3>(3 + 3 * k, unknowns).diagonal() = node.M[k] * unit;
    }
    J.bottomLeftCorner(3, unknowns) = condition.rightCols<7>() * point(dM);
    J.bottomRightCorner<3, 3>() = condition.leftCols<3>();
  }

private:
  using PointDerivative = Eigen::Matrix<double, 7, Eigen::Dynamic>;

  const ContactGeometry &geometry;
  const ContactState<double> &now;
  const NodeContact<double> &node;
  const std::vector<PlanePoint<double>> &y;
  const std::vector<NormalWithDerivative> &dn;
  const std::vector<FacetMortar<double>> &facets;
  int a;
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
            row[column_of(normal.stencil, q)] += d[6 + 2 * b] * normal.n.r.d[q] + d[7 + 2 * b] * normal.n.z.d[q];
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
    const double D = geometry.nodes[a].D;
    const Vector3<double> lever(1, node.x.r / geometry.twist_length, 1);
    PointDerivative d = PointDerivative::Zero(7, unknowns);
    PlanePoint<double> arm{-node.x.r, -node.x.z}; // gap = n . arm
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
    d(0, 0) -= node.n.r;
    d(0, 2) -= node.n.z;
    for (int i = 0; i < 3; ++i) d(1 + i, i) += lever[i] * now.shift;
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
