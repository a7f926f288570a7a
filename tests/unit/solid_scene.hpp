/// Two rectangular surfaces for tests of the contact in space: the slave above, its normal down, on a master
/// that faces up.
#pragma once

#include "contact/kernels.hpp"
#include "tribogel/contact/surface/operator.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <functional>
#include <random>

namespace tribogel
{

/// nx x ny facets on [-size/2, size/2]^2, mapped by `shape`; `up`: the normal points to +z.
inline QuadReference quad_grid(int nx, int ny, double size_x, double size_y, int order, bool up,
                               const std::function<Vector3<double>(double, double)> &shape)
{
  QuadReference surface;
  const int columns = nx * order + 1, rows = ny * order + 1;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      surface.X.push_back(shape(size_x * (static_cast<double>(i) / (columns - 1) - 0.5),
                                size_y * (static_cast<double>(j) / (rows - 1) - 0.5)));
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      std::array<int, 9> facet;
      facet.fill(-1);
      for (int b = 0; b <= order; ++b)
        for (int a = 0; a <= order; ++a) {
          const int node = (j * order + b) * columns + i * order + a;
          facet[static_cast<std::size_t>(up ? b * (order + 1) + a : a * (order + 1) + b)] = node;
        }
      surface.facets.push_back(facet);
    }
  return surface;
}

struct SolidScene {
  SurfaceGeometry geometry;
  ContactState<double> state;

  SolidScene(QuadReference slave, QuadReference master, int order, bool exact_cells = true)
      : SolidScene(std::move(slave), std::move(master),
                   SurfaceParameters{.order = order, .softer_modulus = 0.7, .exact_cells = exact_cells})
  {
  }
  SolidScene(QuadReference slave, QuadReference master, const SurfaceParameters &parameters)
      : geometry(std::move(slave), std::move(master), parameters)
  {
    state.slave.u.assign(geometry.slave.X.size(), Vector3<double>::Zero());
    state.slave.rate = state.multiplier = state.slave.u;
    state.master.u.assign(geometry.master.X.size(), Vector3<double>::Zero());
    state.master.rate = state.master.u;
  }

  int slaves() const { return static_cast<int>(geometry.slave.X.size()); }
  int masters() const { return static_cast<int>(geometry.master.X.size()); }

  /// Residual by unknown: u of the slave's nodes, u of the master's, multipliers.
  template <class Law> Eigen::VectorXd residual(const Law &law, const SurfaceContact::Pairs &pairs) const
  {
    SurfaceContact contact(geometry);
    const MortarReport report = contact.update(state, pairs, false);
    Eigen::VectorXd F = Eigen::VectorXd::Zero(6 * slaves() + 3 * masters());
    if (report.status != MortarStatus::ok) return F.setConstant(std::numeric_limits<double>::quiet_NaN());
    for (int a = 0; a < slaves(); ++a) {
      NodeBlock block;
      contact.node(a, law, block);
      for (int k = 0; k < block.slave_rows; ++k)
        F.segment<3>(3 * block.slave_nodes[k]) += block.residual.segment<3>(3 * k);
      for (std::size_t k = 0; k < block.master_nodes.size(); ++k)
        F.segment<3>(3 * (slaves() + block.master_nodes[k])) +=
            block.residual.segment<3>(3 * (block.slave_rows + k));
      F.segment<3>(3 * (slaves() + masters() + a)) += block.residual.tail<3>();
    }
    return F;
  }

  Eigen::Index row_of(const ContactUnknown &unknown) const
  {
    const int offset[3] = {0, slaves(), slaves() + masters()};
    return 3 * (offset[unknown.kind] + unknown.node);
  }
};

/// Displaced, sliding and loaded nodes, and plates in motion; positive loads press a slave whose normal
/// points down.
inline void make_general(SolidScene &scene, double load, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  ContactState<double> &state = scene.state;
  const auto vary = [&](std::vector<Vector3<double>> &field, double by) {
    for (auto &v : field)
      for (int i = 0; i < 3; ++i) v[i] += by * unit(random);
  };
  vary(state.slave.u, 0.01);
  vary(state.master.u, 0.01);
  vary(state.slave.rate, 0.3);
  vary(state.master.rate, 0.2);
  vary(state.multiplier, 0.2);
  for (auto &lambda : state.multiplier) lambda[2] += load;
  state.slave.rotation = 0.4;
  state.master.rotation = 0.1;
  state.slave.rotation_rate = 0.5;
  state.master.rotation_rate = -0.2;
  state.slave.travel = -0.01;
  state.slave.travel_rate = -0.03;
  state.slave_axis = {0.07, -0.05};
  state.shift = 1.7;
  state.stick_rate = 2.3;
}

/// Largest difference of the operator's Jacobian from central differences of its residual, over the largest
/// entry. Every `stride`th column is compared.
template <class Law> double jacobian_error(const SolidScene &scene, const Law &law, Eigen::Index stride)
{
  SurfaceContact contact(scene.geometry);
  const auto pairs = contact.candidate_pairs(scene.state, 0.1);
  if (contact.update(scene.state, pairs, true).status != MortarStatus::ok) return 1;
  const Eigen::Index size = 6 * scene.slaves() + 3 * scene.masters();
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(size, size);
  contact.jacobian(law, [&](const ContactBlock &block) {
    for (std::size_t i = 0; i < block.rows.size(); ++i)
      for (std::size_t j = 0; j < block.columns.size(); ++j)
        J.block<3, 3>(scene.row_of(block.rows[i]), scene.row_of(block.columns[j])) +=
            block.values.block<3, 3>(3 * static_cast<Eigen::Index>(i), 3 * static_cast<Eigen::Index>(j));
  });
  const double h = 1e-5;
  double worst = 0;
  for (Eigen::Index column = 0; column < size; column += stride) {
    const auto perturbed = [&](double by) {
      SolidScene moved = scene;
      const Eigen::Index node = column / 3, i = column % 3;
      if (node < scene.slaves()) {
        moved.state.slave.u[node][i] += by;
        moved.state.slave.rate[node][i] += by * scene.state.shift;
      } else if (node < scene.slaves() + scene.masters()) {
        moved.state.master.u[node - scene.slaves()][i] += by;
        moved.state.master.rate[node - scene.slaves()][i] += by * scene.state.shift;
      } else
        moved.state.multiplier[node - scene.slaves() - scene.masters()][i] += by;
      return moved.residual(law, pairs);
    };
    const Eigen::VectorXd slope =
        (8 * (perturbed(h) - perturbed(-h)) - (perturbed(2 * h) - perturbed(-2 * h))) / (12 * h);
    worst = std::max(worst, (slope - J.col(column)).lpNorm<Eigen::Infinity>());
  }
  return worst / J.lpNorm<Eigen::Infinity>();
}

/// Curved, distorted, non-matching surfaces in a general state, with the nodal status that `load` suggests.
inline SolidScene general_solid_scene(int order, double load, unsigned seed, bool exact_cells = true)
{
  const auto bump = [](double x, double y) { return 0.03 * x * x - 0.02 * x * y + 0.01 * y; };
  SolidScene scene(
      quad_grid(2, 2, 2, 1.6, order, false,
                [&](double x, double y) {
                  return Vector3<double>(x + 0.05 * y * y, y + 0.04 * x * y, bump(x, y) + 0.02 * x);
                }),
      quad_grid(3, 4, 3.4, 3, order, true,
                [&](double x, double y) {
                  return Vector3<double>(x - 0.1 * y, y + 0.03 * x * x, bump(x, y) - 0.01 * y * y);
                }),
      order, exact_cells);
  make_general(scene, load, seed);
  return scene;
}

} // namespace tribogel
