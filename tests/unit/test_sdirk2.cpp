/// SDIRK2 at a material point: order, damping, energy, symmetry.
#include "evolution_law.hpp"

#include "tribogel/math/sdirk2.hpp"

#include <algorithm>

using namespace tribogel;
using samples::wandering;

namespace
{

struct Point {
  const Viscoelastic<double> &material;
  std::vector<double> history;
  Response<double> last{};
  double dissipated = 0, least_dissipation = 1; ///< the latter of a stage

  explicit Point(const Viscoelastic<double> &law) : material(law), history(law.history_size())
  {
    law.initial_history(history.data());
  }

  void step(const Matrix3<double> &middle, const Matrix3<double> &end, double h)
  {
    auto between = history, next = history;
    const double length = sdirk2::gamma * h;
    const auto first =
        material.evaluate(middle, {history.data()}, {length, sdirk2::reach}, between.data(), false);
    last = material.evaluate(end, {between.data()}, {length}, next.data(), false);
    ASSERT_EQ(first.status, PointStatus::ok);
    ASSERT_EQ(last.status, PointStatus::ok);
    dissipated += sdirk2::reach * first.dissipated + last.dissipated;
    least_dissipation = std::min({least_dissipation, first.dissipated, last.dissipated});
    history = next;
  }
};

/// The paper's gel would hide the error in shear behind its bulk modulus.
Viscoelastic<double> soft()
{
  auto material = samples::paper();
  material.equilibrium.bulk_modulus = 4.1;
  material.branches[0].spring.bulk_modulus = 2.3;
  return material;
}

/// The branches alone, their viscosities scaled.
Viscoelastic<double> branches_of(Viscoelastic<double> material, double scale)
{
  material.equilibrium = {{}, {}, 0};
  for (auto &branch : material.branches) {
    branch.deviatoric_viscosity *= scale;
    branch.volumetric_viscosity *= scale;
  }
  return material;
}

struct Path {
  Point point;
  double work = 0; ///< of the stresses, by the trapezoidal rule on F
};

/// From the virgin state in steps that are by `uneven` shorter and longer by turns.
Path follow(const Viscoelastic<double> &material, double end, int steps, double uneven)
{
  Path path{Point(material)};
  Matrix3<double> F = wandering(0), P = Matrix3<double>::Zero();
  double t = 0;
  for (int i = 0; i < steps; ++i) {
    const double h = end / steps * (i % 2 == 0 ? 1 - uneven : 1 + uneven);
    const Matrix3<double> next = wandering(t + h);
    path.point.step(wandering(t + sdirk2::gamma * h), next, h);
    t += h;
    const Matrix3<double> P_next = from_mandel(path.point.last.tau) * next.inverse().transpose();
    path.work += (0.5 * (P + P_next)).cwiseProduct(next - F).sum();
    F = next;
    P = P_next;
  }
  return path;
}

} // namespace

TEST(Sdirk2, coefficients_are_of_second_order_and_stiffly_accurate)
{
  using sdirk2::error_constant, sdirk2::rate_lag, sdirk2::reach;
  constexpr double gamma = sdirk2::gamma;
  EXPECT_NEAR(1 - 4 * gamma + 2 * gamma * gamma, 0, 1e-15);
  EXPECT_NEAR(reach * gamma + gamma, 1, 1e-15);          // the weights 1 - gamma, gamma
  EXPECT_NEAR((1 - gamma) * gamma + gamma, 0.5, 1e-15);  // sum b c
  EXPECT_NEAR(rate_lag, std::numbers::sqrt2 / 4, 1e-15); // of U = t^2/2 over a step from 0 to 1
  EXPECT_NEAR((0.5 - reach * gamma * gamma / 2) / gamma, 1 + rate_lag, 1e-15);
  const double z = -1e-3, R = (1 + (1 - 2 * gamma) * z) / ((1 - gamma * z) * (1 - gamma * z));
  EXPECT_NEAR((R - std::exp(z)) / (z * z * z), error_constant, 1e-2 * error_constant);
}

TEST(Sdirk2, converges_to_the_evolution_law_at_second_order_also_with_uneven_steps)
{
  const double end = 3.1;
  for (const auto &material :
       {branches_of(soft(), 1), branches_of(samples::odd(), 1), branches_of(soft(), 0.01)}) {
    const Mandel<double> exact =
        samples::stress_at(material, wandering(end), samples::integrate_flow(material, wandering, end));
    for (double uneven : {0.0, 0.5}) {
      std::vector<double> error;
      for (int steps : {100, 200, 400, 800})
        error.push_back((follow(material, end, steps, uneven).point.last.tau - exact).norm() / exact.norm());
      for (std::size_t i = 1; i < error.size(); ++i)
        EXPECT_NEAR(std::log2(error[i - 1] / error[i]), 2, 0.1) << "error " << error[i];
      EXPECT_LT(error.back(), 1e-4);
    }
  }
}

// R(z) = (1 + (1 - 2 gamma) z)/(1 - gamma z)^2 a step, to the accuracy of the linearisation.
TEST(Sdirk2, small_strains_relax_with_the_linear_moduli)
{
  const double strain = 1e-5, h = 0.3;
  for (const auto &material : {samples::paper(), samples::odd()}) {
    Matrix3<double> shear = Matrix3<double>::Identity();
    shear(0, 1) = strain;
    Point point(material);
    for (int n = 1; n <= 8; ++n) {
      point.step(shear, shear, h);
      double G = material.equilibrium.shear_modulus();
      for (const auto &b : material.branches) {
        const double Gv = b.spring.shear_modulus(), z = -h * Gv / b.deviatoric_viscosity;
        G += Gv * std::pow((1 + (1 - 2 * sdirk2::gamma) * z) / std::pow(1 - sdirk2::gamma * z, 2), n);
      }
      EXPECT_NEAR(from_mandel(point.last.tau)(1, 0) / strain / G, 1, 5 * strain);
    }
  }
}

// What relaxes in a time far below the step is gone after it, whatever the strain: |R(z)| ~ 4.83/|z|.
TEST(Sdirk2, is_l_stable_for_relaxation_times_seven_decades_below_the_step)
{
  for (const auto &full : {soft(), samples::odd(), samples::paper()}) {
    const auto material = branches_of(full, 1);
    for (int seed : {71, 72, 73}) {
      const Matrix3<double> F = Matrix3<double>::Identity() + 0.5 * samples::noise(seed);
      if (F.determinant() < 0.2) continue;
      Point point(material);
      const double before = samples::stress_at(material, F, point.history).norm();
      double longest = 0;
      for (const auto &b : material.branches) {
        longest = std::max(longest, b.deviatoric_viscosity / b.spring.shear_modulus());
        longest = std::max(longest, b.volumetric_viscosity / b.spring.bulk_modulus);
      }
      point.step(F, F, 1e7 * longest);
      EXPECT_LT(point.last.tau.norm(), 1e-5 * before);
      const double once = point.last.tau.norm();
      point.step(F, F, 1e7 * longest);
      EXPECT_LT(point.last.tau.norm(), 1e-5 * once + 1e-12 * before);
    }
  }
}

// The stress is then the viscosity's, 1e-7 of the spring's. The rate at a stage's end is of first order where
// the strain follows the motion, THEORY (4.6), so is this stress; it stays bounded by it.
TEST(Sdirk2, a_stiff_branch_follows_the_motion)
{
  const auto material = branches_of(soft(), 1e-7);
  const double end = 3.1;
  const Mandel<double> limit = follow(material, end, 20000, 0).point.last.tau;
  double before = 0;
  for (int steps : {50, 100, 200, 400}) {
    const double error = (follow(material, end, steps, 0.3).point.last.tau - limit).norm() / limit.norm();
    EXPECT_LT(error, 2.5 / steps);
    if (steps > 100) {
      EXPECT_GT(before / error, 1.7);
    }
    before = error;
  }
}

TEST(Sdirk2, work_in_a_closed_cycle_is_stored_plus_dissipated_to_second_order)
{
  for (const auto &material : {samples::paper(), samples::odd()}) {
    std::vector<double> residual;
    for (int steps : {200, 400, 800, 1600}) {
      const Path path = follow(material, 4, steps, 0);
      EXPECT_GE(path.point.least_dissipation, 0);
      residual.push_back(std::abs(path.work - path.point.last.energy - path.point.dissipated) /
                         path.point.dissipated);
    }
    for (std::size_t i = 1; i < residual.size(); ++i)
      EXPECT_GT(std::log2(residual[i - 1] / residual[i]), 1.8) << "residual " << residual[i];
    EXPECT_LT(residual.back(), 1e-3);
  }
}

/// Tangent of the second stage and the derivative of what the first leaves, where nothing is coaxial.
TEST(Sdirk2, tangents_are_symmetric_and_the_carried_history_has_its_derivative)
{
  using D = Dual<9>;
  const auto material = samples::odd();
  const double length = sdirk2::gamma * 0.4;
  std::vector<double> start(material.history_size()), between = start, next = start;
  material.initial_history(start.data());
  const Matrix3<double> middle = wandering(0.3), end = wandering(0.7);
  ASSERT_EQ(material.evaluate(middle, {start.data()}, {length, sdirk2::reach}, between.data(), false).status,
            PointStatus::ok);
  const auto response = material.evaluate(end, {between.data()}, {length}, next.data(), true);
  EXPECT_LT((response.tangent - response.tangent.transpose()).norm(), 1e-13 * response.tangent.norm());

  std::vector<D> dual_start(start.begin(), start.end()), dual_between(start.size());
  Matrix3<D> F;
  for (int i = 0; i < 9; ++i) F(i / 3, i % 3) = D::seed(middle(i / 3, i % 3), i);
  material.cast<D>().evaluate(F, {dual_start.data()}, {length, sdirk2::reach}, dual_between.data(), false);
  for (int i = 0; i < 9; ++i) {
    constexpr double small = 1e-5;
    std::vector<double> up = between, down = between;
    for (double sign : {1.0, -1.0}) {
      Matrix3<double> G = middle;
      G(i / 3, i % 3) += sign * small;
      material.evaluate(G, {start.data()}, {length, sdirk2::reach}, (sign > 0 ? up : down).data(), false);
    }
    for (std::size_t k = 0; k < between.size(); ++k)
      EXPECT_NEAR(dual_between[k].d[i], (up[k] - down[k]) / (2 * small), 1e-8);
  }
}
