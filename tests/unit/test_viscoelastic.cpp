#include "material_samples.hpp"
#include "matrix_reference.hpp"

#include "tribogel/material/viscoelastic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace tribogel;
using reference::lift;
using reference::lift_history;
using samples::histories;
using samples::initial;
using samples::Step;
using samples::take;

namespace
{

const double infinity = std::numeric_limits<double>::infinity();

const std::vector<Viscoelastic<double>> materials = {samples::paper(), samples::odd(),
                                                     samples::hyperelastic(), samples::quadratic()};

template <class A, class B> double difference(const A &a, const B &b)
{
  return (a - b).norm();
}

TEST(Viscoelastic, stress_energy_and_history_are_those_of_matrix_functions)
{
  for (const auto &material : materials)
    for (const auto &history : histories(material))
      for (const auto &[name, F] : samples::deformations())
        for (double step : {0.0, 0.37, 41.0}) {
          const Step got = take(material, F, history, step);
          const auto exact = reference::law(material).evaluate(lift(F), lift_history(history), step);
          const Matrix3<double> tau = exact.tau.real().cast<double>();
          const double K = 2 * material.equilibrium.bulk_modulus;
          EXPECT_LT(difference(from_mandel(got.response.tau), tau), 1e-14 * (tau.norm() + K)) << name;
          EXPECT_NEAR(got.response.energy, static_cast<double>(exact.energy.real()), 1e-14 * (K + tau.norm()))
              << name;
          EXPECT_NEAR(got.response.dissipated, static_cast<double>(exact.dissipated.real()),
                      1e-14 * (K + tau.norm()))
              << name;
          for (std::size_t m = 0; m < material.branches.size(); ++m) {
            const Matrix3<double> X = exact.history[m].real().cast<double>();
            EXPECT_LT(difference(to_mandel(X), Eigen::Map<const Mandel<double>>(&got.history[6 * m])),
                      5e-14 * X.norm())
                << name;
          }
        }
}

Mandel4<double> complex_step_tangent(const Viscoelastic<double> &material, const Matrix3<double> &F,
                                     const std::vector<double> &history, double step)
{
  const auto law = reference::law(material);
  const auto levels = lift_history(history);
  Mandel4<double> tangent;
  for (int k = 0; k < 6; ++k) {
    const Matrix3<double> d = from_mandel<double>(Mandel<double>::Unit(k));
    const reference::Matrix G =
        (reference::Matrix::Identity() + reference::Complex(0, reference::tiny) * lift(d)) * lift(F);
    const auto state = law.evaluate(G, levels, step);
    const Matrix3<double> tau = state.tau.real().cast<double>(), rate = reference::derivative(state.tau);
    tangent.col(k) = to_mandel<double>(rate - d * tau - tau * d);
  }
  return tangent;
}

// The moderate bulk moduli keep the shear components from hiding behind the volumetric ones.
TEST(Viscoelastic, tangent_is_the_complex_step_derivative_also_where_stretches_coincide)
{
  double worst = 0;
  for (const auto &material : materials)
    for (const auto &history : histories(material))
      for (const auto &[name, F] : samples::deformations())
        for (double step : {0.37, 41.0}) {
          const Mandel4<double> got = take(material, F, history, step).response.tangent;
          const Mandel4<double> exact = complex_step_tangent(material, F, history, step);
          const double error = difference(got, exact) / exact.norm();
          EXPECT_LT(error, 1e-13) << name << " step " << step;
          worst = std::max(worst, error);
          EXPECT_LT(difference(got, got.transpose()), 1e-15 * got.norm()) << name;
        }
  RecordProperty("worst_relative_error", std::to_string(worst * 1e15) + "e-15");
}

TEST(Viscoelastic, stress_and_tangent_are_continuous_at_coalescing_stretches)
{
  const Matrix3<double> uniaxial = samples::stretched(1.3, 1.3, 0.7, 5);
  for (const auto &material : materials)
    for (const auto &history : histories(material))
      for (const Matrix3<double> &F : {Matrix3<double>::Identity().eval(), uniaxial}) {
        const Step base = take(material, F, history, 0.37);
        const double scale = base.response.tangent.norm() + base.response.tau.norm();
        for (double delta : {1e-16, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4})
          for (int seed = 51; seed < 54; ++seed) {
            const Step near = take(material, F + delta * samples::noise(seed), history, 0.37);
            EXPECT_LT(difference(near.response.tau, base.response.tau), scale * (6 * delta + 2e-15)) << delta;
            EXPECT_LT(difference(near.response.tangent, base.response.tangent), scale * (30 * delta + 1e-14))
                << delta;
          }
      }
}

TEST(Viscoelastic, a_superposed_rotation_turns_the_stress_and_changes_nothing_else)
{
  for (const auto &material : materials)
    for (const auto &history : histories(material))
      for (const auto &[name, F] : samples::deformations()) {
        const Matrix3<double> Q = samples::rotation(61);
        const Step base = take(material, F, history, 0.37), turned = take(material, Q * F, history, 0.37);
        const Mandel4<double> R = mandel_rotation(Q);
        const double K = 2 * material.equilibrium.bulk_modulus, scale = K + base.response.tau.norm();
        EXPECT_LT(difference(turned.response.tau, R * base.response.tau), 1e-14 * scale) << name;
        EXPECT_LT(difference(turned.response.tangent, R * base.response.tangent * R.transpose()),
                  5e-14 * base.response.tangent.norm())
            << name;
        EXPECT_NEAR(turned.response.energy, base.response.energy, 1e-14 * scale) << name;
        EXPECT_NEAR(turned.response.dissipated, base.response.dissipated, 1e-14 * scale) << name;
        for (std::size_t i = 0; i < history.size(); ++i)
          EXPECT_NEAR(turned.history[i], base.history[i], 5e-14 * (1 + std::abs(base.history[i]))) << name;
      }
}

TEST(Viscoelastic, the_relaxed_state_is_that_of_the_equilibrium_spring)
{
  for (const auto &material : {samples::paper(), samples::odd()})
    for (const auto &[name, F] : samples::deformations()) {
      const auto history = samples::history(material, 62);
      const Step relaxed = take(material, F, history, infinity);
      const Step spring = take({material.equilibrium, {}}, F, {}, 0.5);
      EXPECT_EQ(relaxed.response.tau, spring.response.tau) << name;
      EXPECT_EQ(relaxed.response.tangent, spring.response.tangent) << name;
      EXPECT_EQ(relaxed.response.energy, spring.response.energy) << name;
      EXPECT_EQ(relaxed.response.dissipated, 0) << name;
      const Step late = take(material, F, history, 1e13);
      EXPECT_LT(difference(late.response.tau, relaxed.response.tau), 1e-10) << name;
    }
}

TEST(Viscoelastic, small_strain_moduli_are_those_of_all_springs_at_once_and_of_equilibrium_in_the_end)
{
  for (const auto &material : materials)
    for (double step : {0.0, infinity}) {
      double G = material.equilibrium.shear_modulus(), K = material.equilibrium.bulk_modulus;
      if (step == 0)
        for (const auto &branch : material.branches) {
          G += branch.spring.shear_modulus();
          K += branch.spring.bulk_modulus;
        }
      Mandel4<double> expected = 2 * G * Mandel4<double>::Identity();
      expected.topLeftCorner<3, 3>().array() += K - 2 * G / 3;
      const Mandel4<double> got =
          take(material, Matrix3<double>::Identity(), initial(material), step).response.tangent;
      EXPECT_LT(difference(got, expected), 2e-15 * expected.norm());
    }
}

TEST(Viscoelastic, a_state_without_stress_stays_there)
{
  for (const auto &material : materials) {
    const Step s = take(material, Matrix3<double>::Identity(), initial(material), 0.8);
    EXPECT_EQ(s.response.tau.norm() + s.response.energy + s.response.dissipated, 0);
    EXPECT_EQ(s.history, initial(material));
  }
}

TEST(Viscoelastic, a_point_that_cannot_be_evaluated_says_so)
{
  const auto material = samples::odd();
  std::vector<double> history = initial(material), updated(12);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto status = [&](const Matrix3<double> &F) {
    return material.evaluate(F, {history.data()}, {0.4}, updated.data(), true).status;
  };
  Matrix3<double> F = Matrix3<double>::Identity();
  F(2, 2) = -0.4;
  EXPECT_EQ(status(F), PointStatus::inverted);
  F(2, 2) = 0;
  EXPECT_EQ(status(F), PointStatus::inverted);
  for (double x : {nan, infinity, -infinity, 1e200})
    for (int i = 0; i < 9; ++i) {
      F = samples::stretched(1.2, 0.9, 1.1, 63);
      F(i) = x;
      EXPECT_NE(status(F), PointStatus::ok) << x;
    }
  F = samples::stretched(1.2, 0.9, 1.1, 63);
  for (double x : {nan, infinity, -0.6}) {
    history = initial(material);
    history[1] = x;
    EXPECT_EQ(status(F), PointStatus::local_newton_failed) << x;
  }
}

} // namespace
