#include "material_samples.hpp"

#include "tribogel/material/maxwell.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace tribogel;

namespace
{

using D = Dual<3>;

const double infinity = std::numeric_limits<double>::infinity();

std::vector<MaxwellBranch<double>> branches()
{
  auto list = samples::odd().branches;
  list.push_back(samples::paper().branches[0]);
  list.push_back({{{-3e-4, 2e-5}, {-9.0, 13.0}, 0.7}, 4.5e5, 2e-3}); // strongly nonlinear, unlike viscosities
  return list;
}

std::vector<Vector3<double>> trials()
{
  std::vector<Vector3<double>> list{{0, 0, 0},           {0.3, 0.3, -0.6},       {0.2, 0.2, 0.2},
                                    {1e-9, 2e-9, -4e-9}, {1.1, -1.2, 0.4},       {2.5, -1.5, -0.3},
                                    {-2.2, -1.9, 1.3},   {0.1, 0.1 + 1e-9, -0.3}};
  for (int seed = 0; seed < 20; ++seed) list.push_back(1.3 * samples::noise(seed).col(1));
  return list;
}

// Relative to what round-off of the trial strain and of step times stress leaves.
TEST(Maxwell, solves_the_flow_rule_for_steps_of_any_size)
{
  for (const auto &branch : branches())
    for (const Vector3<double> &trial : trials())
      for (double step : {0.0, 1e-9, 1e-5, 1e-2, 0.3, 7.0, 1e3, 1e6, 1e9, 1e12}) {
        const auto out = branch.advance(trial, step);
        ASSERT_EQ(out.status, PointStatus::ok) << trial.transpose() << " step " << step;
        const Vector3<double> dev = out.deviatoric.tau, flow = dev / (2 * branch.deviatoric_viscosity);
        const double volumetric_flow = out.volumetric.mean / (3 * branch.volumetric_viscosity);
        const Vector3<double> residual = (out.strain + step * flow - trial).array() + step * volumetric_flow;
        EXPECT_LE(residual.norm(), 2e-14 * (trial.norm() + step * (flow.norm() + std::abs(volumetric_flow))))
            << trial.transpose() << " step " << step;
        const double dissipated = step * (dev.squaredNorm() / (2 * branch.deviatoric_viscosity) +
                                          3 * out.volumetric.mean * volumetric_flow);
        EXPECT_NEAR(out.dissipated, dissipated, 1e-14 * dissipated);
        EXPECT_GE(out.dissipated, 0);
        EXPECT_GE(out.energy, 0);
      }
}

// Its mean stress falls below J = 1/2: there the flow may have no root, or one that no flow from J = 1 comes
// to.
TEST(Maxwell, the_quadratic_volumetric_law_solves_the_flow_rule_or_says_that_it_cannot)
{
  const auto branch = samples::quadratic().branches[0];
  const double K = branch.spring.bulk_modulus;
  for (double theta : {-0.69, -0.4, -1e-9, 0.0, 1e-9, 0.3, 2.0})
    for (double step : {0.0, 1e-5, 0.3, 7.0, 1e3, 1e9}) {
      const auto out = branch.advance(Vector3<double>::Constant(theta / 3), step);
      ASSERT_EQ(out.status, PointStatus::ok) << theta << " step " << step;
      const double rate = step / branch.volumetric_viscosity, J = std::exp(out.strain.sum()),
                   mean = K * J * (J - 1);
      EXPECT_NEAR(out.strain.sum() + rate * mean, theta, 3e-15 * (1 + rate * K) * (1 + std::abs(theta)))
          << step;
      EXPECT_NEAR(out.volumetric.mean, mean, 3e-15 * K * J * (1 + J)) << step;
    }
  EXPECT_EQ(branch.advance(Vector3<double>::Constant(-0.5), 1e-3).status, PointStatus::ok);
  EXPECT_EQ(branch.advance(Vector3<double>::Constant(-0.9), 7e2 / K).status, PointStatus::ok); // flows off
  int refused = 0;
  for (double step : {1.0, 3.0, 10.0, 30.0, 100.0})
    refused += branch.advance(Vector3<double>::Constant(-3), step).status == PointStatus::local_newton_failed;
  EXPECT_GT(refused, 0);
}

TEST(Maxwell, stress_has_relative_accuracy_when_almost_all_of_it_has_relaxed)
{
  const auto branch = samples::paper().branches[0];
  for (const Vector3<double> &trial : trials())
    for (double step : {1e9, 1e12, 1e15}) { // the trial strain flows off completely: step V^-1 tau = trial
      const auto out = branch.advance(trial, step);
      const double theta = trial.sum();
      const Vector3<double> e = trial.array() - theta / 3;
      EXPECT_LE((out.deviatoric.tau * step / (2 * branch.deviatoric_viscosity) - e).norm(),
                1e-8 * e.norm() + 1e-15 * trial.norm());
      EXPECT_NEAR(out.volumetric.mean * step / branch.volumetric_viscosity, theta, 1e-8 * std::abs(theta));
    }
}

TEST(Maxwell, infinite_step_is_the_limit_of_long_ones_and_leaves_no_stress)
{
  for (const auto &branch : branches())
    for (const Vector3<double> &trial : trials()) {
      const auto out = branch.advance(trial, infinity);
      EXPECT_EQ(out.status, PointStatus::ok);
      EXPECT_EQ(out.strain.norm() + out.deviatoric.tau.norm() + std::abs(out.volumetric.mean), 0);
      EXPECT_EQ(out.deviatoric.stiffness.norm() + out.deviatoric.secant.norm() + out.volumetric.bulk, 0);
      EXPECT_EQ(out.energy + out.dissipated, 0);
      const auto almost = branch.advance(trial, 1e100);
      EXPECT_LE(almost.strain.norm() + almost.deviatoric.tau.norm() + almost.deviatoric.secant.norm(), 1e-80);
    }
}

TEST(Maxwell, zero_step_is_the_spring)
{
  for (const auto &branch : branches())
    for (const Vector3<double> &trial : trials()) {
      const auto out = branch.advance(trial, 0);
      EXPECT_LE((out.strain - trial).norm(), 1e-15 * trial.norm());
      EXPECT_EQ(out.dissipated, 0);
      EXPECT_EQ(out.strain_ratio, Vector3<double>::Ones());
    }
}

TEST(Maxwell, stiffness_and_secants_are_those_of_the_trial_strain)
{
  for (const auto &branch : branches())
    for (const Vector3<double> &trial : trials())
      for (double step : {0.0, 1e-3, 0.4, 30.0, 1e6}) {
        Vector3<D> x;
        for (int a = 0; a < 3; ++a) x[a] = D::seed(trial[a], a);
        const auto out = branch.cast<D>().advance(x, step);
        const auto plain = branch.advance(trial, step);
        ASSERT_EQ(out.status, PointStatus::ok);
        const Vector3<double> &S = plain.deviatoric.stiffness, &tau = plain.deviatoric.tau;
        EXPECT_LE((value(out.deviatoric.tau) - tau).norm(), 1e-14 * tau.norm());
        const double scale = S.norm() + plain.volumetric.bulk;
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b) {
            const double PDP = (a == b ? S[a] : 0) - (S[a] + S[b]) / 3 + S.sum() / 9;
            EXPECT_NEAR(out.deviatoric.tau[a].d[b], PDP, 1e-13 * scale);
            EXPECT_NEAR(out.volumetric.mean.d[b], plain.volumetric.bulk, 1e-13 * scale);
          }
        for (int k = 0; k < 3; ++k) {
          const int a = pair_index[k][0], b = pair_index[k][1];
          const double gap = trial[a] - trial[b];
          EXPECT_NEAR(plain.deviatoric.secant[k] * gap, tau[a] - tau[b], 4e-14 * (scale * trial.norm()));
          EXPECT_NEAR(plain.strain_ratio[k] * gap, plain.strain[a] - plain.strain[b], 4e-14 * trial.norm());
          const double derivative = // where the strains coincide the divided difference is this one
              (out.deviatoric.tau[a] - out.deviatoric.tau[b]).d[a] -
              (out.deviatoric.tau[a] - out.deviatoric.tau[b]).d[b];
          if (gap == 0) {
            EXPECT_NEAR(plain.deviatoric.secant[k], derivative / 2, 1e-13 * scale);
          }
        }
      }
}

TEST(Maxwell, a_state_that_is_no_state_is_reported)
{
  const auto branch = samples::paper().branches[0];
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double step : {0.4, infinity}) {
    EXPECT_EQ(branch.advance({0.1, nan, 0.2}, step).status, PointStatus::local_newton_failed);
    EXPECT_EQ(branch.advance({0.1, -infinity, 0.2}, step).status, PointStatus::local_newton_failed);
  }
  EXPECT_EQ(branch.advance({0.1, 0.3, 0.2}, nan).status, PointStatus::local_newton_failed);
}

// Newton's method comes down an exponential by 1/alpha a step: from exp(40 * 6) that is too many.
TEST(Maxwell, a_local_problem_that_is_not_solved_is_reported)
{
  const MaxwellBranch<double> branch{{{0.3}, {40}, 10}, 0.7, 3.1};
  const Vector3<double> trial(6, -2.9, -3.1);
  EXPECT_EQ(branch.advance(trial, 1e-3).status, PointStatus::local_newton_failed);
  EXPECT_EQ(branch.advance(trial / 10, 1e-3).status, PointStatus::ok);
}

} // namespace
