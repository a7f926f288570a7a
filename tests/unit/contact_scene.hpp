/// Two meridian curves with chosen or random meshes and states, and the whole residual of their contact in
/// any arithmetic.
#pragma once

#include "contact/kernels.hpp"
#include "tribogel/contact/curve/operator.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <functional>
#include <random>

namespace tribogel::testing
{

using Law = PolynomialFriction<double>;

/// A curve through the points at(s) with s = breaks[0], breaks[1], ...: one facet between two breaks, midside
/// nodes in between.
inline SurfaceReference curve(int order, const std::vector<double> &breaks,
                              const std::function<PlanePoint<double>(double)> &at)
{
  SurfaceReference surface;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const int first = static_cast<int>(i) * order;
    surface.X.push_back(at(breaks[i]));
    if (order == 2) surface.X.push_back(at(0.5 * (breaks[i] + breaks[i + 1])));
    surface.facets.push_back({first, first + order, order == 2 ? first + 1 : -1});
  }
  surface.X.push_back(at(breaks.back()));
  return surface;
}

/// `count` intervals of [from, to], their inner limits displaced by up to a fraction `disorder` of half an
/// interval.
inline std::vector<double> breaks(int count, double from, double to, double disorder = 0, unsigned seed = 1)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> displacement(-0.5 * disorder, 0.5 * disorder);
  std::vector<double> s;
  for (int i = 0; i <= count; ++i) {
    const double offset = i > 0 && i < count ? displacement(random) : 0;
    s.push_back(i == count ? to : from + (to - from) * (i + offset) / count);
  }
  return s;
}

inline SurfaceReference flat(int order, const std::vector<double> &radii, double Z)
{
  return curve(order, radii, [Z](double R) { return PlanePoint<double>{R, Z}; });
}

struct ContactScene {
  CurveGeometry geometry;
  ContactState<double> state;

  ContactScene(const SurfaceReference &slave, const SurfaceReference &master,
               const CurveParameters &parameters)
      : geometry(slave, master, parameters)
  {
    const auto rest = [](SurfaceState<double> &surface, std::size_t nodes) {
      surface.u.assign(nodes, Vector3<double>::Zero());
      surface.rate = surface.u;
    };
    rest(state.slave, slave.X.size());
    rest(state.master, master.X.size());
    state.multiplier.assign(slave.X.size(), Vector3<double>::Zero());
  }

  int slave_nodes() const { return static_cast<int>(geometry.slave.X.size()); }
  int master_nodes() const { return static_cast<int>(geometry.master.X.size()); }
  int unknowns() const { return 6 * slave_nodes() + 3 * master_nodes(); } // slave u, master u, multipliers

  /// Displacements up to `amplitude`, rates up to `rate`, both without radial part on the axis; multipliers
  /// around `pressure` with tangential parts up to `shear`.
  void disturb(double amplitude, double rate, double pressure, double shear, unsigned seed)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    const auto surface = [&](const SurfaceReference &reference, SurfaceState<double> &now) {
      for (std::size_t a = 0; a < now.u.size(); ++a)
        for (int i = 0; i < 3; ++i) {
          const bool held = i == 0 && reference.X[a].r == 0;
          now.u[a][i] = held ? 0 : amplitude * number(random);
          now.rate[a][i] = held ? 0 : rate * number(random);
        }
    };
    surface(geometry.slave, state.slave);
    surface(geometry.master, state.master);
    for (auto &lambda : state.multiplier)
      lambda = {shear * number(random), shear * number(random), pressure * (1 + 0.3 * number(random))};
  }
};

/// A state whose unknowns move in a given direction (rates by `shift` times it).
inline ContactState<Dual<1>> moving(const ContactScene &scene, const Eigen::VectorXd &direction)
{
  const ContactState<double> &from = scene.state;
  ContactState<Dual<1>> to;
  int next = 0;
  const auto move = [&](const Vector3<double> &x, double factor, int first) {
    Vector3<Dual<1>> y;
    for (int i = 0; i < 3; ++i) {
      y[i] = x[i];
      y[i].d[0] = factor * direction[first + i];
    }
    return y;
  };
  const auto surface = [&](const SurfaceState<double> &a, SurfaceState<Dual<1>> &b) {
    for (std::size_t k = 0; k < a.u.size(); ++k, next += 3) {
      b.u.push_back(move(a.u[k], 1, next));
      b.rate.push_back(move(a.rate[k], from.shift, next));
    }
    b.travel = a.travel, b.travel_rate = a.travel_rate, b.rotation_rate = a.rotation_rate;
  };
  surface(from.slave, to.slave);
  surface(from.master, to.master);
  for (const auto &lambda : from.multiplier) to.multiplier.push_back(move(lambda, 1, next)), next += 3;
  to.shift = from.shift;
  to.stick_rate = from.stick_rate;
  return to;
}

/// The whole residual by the generic functions, without the operator class and its chain rule.
template <class T>
Eigen::Matrix<T, Eigen::Dynamic, 1> whole_residual(const ContactScene &scene, const ContactState<T> &state,
                                                   const std::vector<std::pair<int, int>> &pairs,
                                                   const Law &law)
{
  const CurveGeometry &geometry = scene.geometry;
  const LineChain &chain = geometry.slave_chain;
  const auto x = positions(geometry.slave, state.slave), y = positions(geometry.master, state.master);
  std::vector<PlanePoint<T>> n;
  for (int a = 0; a < chain.node_count(); ++a)
    n.push_back(nodal_normal<T>(chain, a, geometry.nodes[a].on_axis, [&](int b) { return x[b]; }));
  std::vector<FacetMortar<T>> facets;
  for (int f = 0; f < chain.facet_count(); ++f) {
    std::vector<std::pair<int, int>> run;
    for (const auto &pair : pairs)
      if (pair.first == f) run.push_back(pair);
    facets.push_back(facet_mortar<T>(geometry, f, run, x, n, y));
  }
  const int slaves = scene.slave_nodes(), masters = scene.master_nodes();
  Eigen::Matrix<T, Eigen::Dynamic, 1> residual(scene.unknowns());
  residual.setZero();
  for (int a = 0; a < slaves; ++a) {
    const int multiplier = 3 * (slaves + masters + a);
    if (!geometry.nodes[a].carries) {
      residual.template segment<3>(multiplier) = T(geometry.nodes[a].extent) * state.multiplier[a];
      continue;
    }
    NodeContact<T> node;
    node.x = x[a], node.n = n[a];
    add_mortar_row(chain, a, facets, node);
    add_kinematics(geometry, a, state, y, node);
    if (!law.linear_in_pressure())
      node.area_ratio = nodal_area<T>(chain, a, geometry.nodes[a].tied, x) / geometry.nodes[a].weight();
    const auto rows = node_residual<T>(geometry, a, node, state.multiplier[a], state.stick_rate, law);
    residual.template segment<3>(3 * a) += rows.slave;
    if (geometry.nodes[a].tied >= 0) residual.template segment<3>(3 * geometry.nodes[a].tied) += rows.tied;
    residual.template segment<3>(multiplier) = rows.condition;
    for (std::size_t k = 0; k < node.masters.size(); ++k)
      residual.template segment<3>(3 * (slaves + node.masters[k])) += rows.master[k];
  }
  return residual;
}

struct Assembled {
  MortarReport report;
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
  std::vector<ContactStatus> status;
};

inline std::vector<std::pair<int, int>> pairs_of_scene(const ContactScene &scene)
{
  return CurveContact(scene.geometry).candidate_pairs(scene.state, 0);
}

/// Residual and Jacobian by the operator, node by node, as a solver would assemble them.
inline Assembled assemble(const ContactScene &scene, const std::vector<std::pair<int, int>> &pairs,
                          const Law &law, bool derivatives)
{
  CurveContact contact(scene.geometry);
  const int slaves = scene.slave_nodes(), masters = scene.master_nodes(), n = scene.unknowns();
  Assembled out{contact.update(scene.state, pairs, derivatives), Eigen::VectorXd::Zero(n), {}, {}};
  if (derivatives) out.jacobian.setZero(n, n);
  NodeBlock block;
  for (int a = 0; a < slaves; ++a) {
    contact.node(a, law, block);
    std::vector<int> columns, rows;
    const auto add = [](std::vector<int> &list, int first) {
      for (int i = 0; i < 3; ++i) list.push_back(first + i);
    };
    for (int b : block.slave_nodes) add(columns, 3 * b);
    for (int m : block.master_nodes) add(columns, 3 * (slaves + m));
    add(columns, 3 * (slaves + masters + a));
    for (int k = 0; k < block.slave_rows; ++k) add(rows, 3 * block.slave_nodes[k]);
    for (int m : block.master_nodes) add(rows, 3 * (slaves + m));
    add(rows, 3 * (slaves + masters + a));
    out.residual(rows) += block.residual;
    if (derivatives) out.jacobian(rows, columns) += block.jacobian;
    out.status.push_back(block.status);
  }
  return out;
}

} // namespace tribogel::testing
