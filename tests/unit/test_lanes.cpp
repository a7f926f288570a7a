/// Lanes: their functions to the accuracy of those for one number, on both sides of every case within one
/// vector; the bulk law by lanes against the law point by point, with the bounds of that against matrix
/// functions in test_viscoelastic.cpp; no point depends on its neighbours.
#include "material_samples.hpp"

#include "tribogel/element/mean_dilatation.hpp"
#include "tribogel/kinematics/axisymmetric.hpp"
#include "tribogel/material/points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

using namespace tribogel;

namespace
{

const double infinity = std::numeric_limits<double>::infinity();

/// f at all of `x`, with any neighbours in the vector, must be `exact` to a few units in the last place.
template <class Function, class Exact>
void expect_function(const char *name, const std::vector<double> &x, const Function &f, const Exact &exact,
                     double tolerance)
{
  for (std::size_t first = 0; first < x.size(); ++first)
    for (std::size_t stride : {0, 1, 5}) {
      Lanes in;
      for (int k = 0; k < Lanes::count; ++k) in.v[k] = x[(first + k * stride) % x.size()];
      const Lanes out = f(in);
      for (int k = 0; k < Lanes::count; ++k) {
        const auto right = static_cast<double>(exact(static_cast<long double>(in.v[k])));
        EXPECT_NEAR(out.v[k], right, tolerance * std::abs(right)) << name << " of " << in.v[k];
      }
    }
}

TEST(Lanes, functions_keep_relative_accuracy_whatever_their_neighbours)
{
  const std::vector<double> numbers{1e-120, 1e-20, 1e-9,  1e-4, 0.03,  0.2,   0.4999999, 0.5000001, 0.8,
                                    3.0,    41.0,  -1e-9, -0.3, -0.49, -0.51, -4.0,      -37.0};
  std::vector<double> positive;
  for (const double x : numbers) positive.push_back(std::abs(x));
  positive.push_back(1 + 1e-9);
  using L = long double;
  const auto exp_minus_tangent_of = [](L x) {
    L exact = 0, term = x;
    if (std::abs(x) > 1) return std::exp(x) - 1 - x;
    for (int k = 2; k < 80; ++k) exact += term *= x / k;
    return exact;
  };
  const auto sinhc_of = [](L x) { return std::sinh(x) / x; };
  const auto x_coth_of = [](L x) { return x / std::tanh(x); };
  expect_function(
      "abs", numbers, [](Lanes x) { return abs(x); }, [](L x) { return std::abs(x); }, 0);
  expect_function(
      "sqrt", positive, [](Lanes x) { return sqrt(x); }, [](L x) { return std::sqrt(x); }, 3e-16);
  expect_function(
      "exp", numbers, [](Lanes x) { return exp(x); }, [](L x) { return std::exp(x); }, 5e-16);
  expect_function(
      "log", positive, [](Lanes x) { return log(x); }, [](L x) { return std::log(x); }, 5e-16);
  expect_function(
      "expm1", numbers, [](Lanes x) { return expm1(x); }, [](L x) { return std::expm1(x); }, 8e-16);
  expect_function(
      "tanh", numbers, [](Lanes x) { return tanh(x); }, [](L x) { return std::tanh(x); }, 8e-16);
  expect_function(
      "sinhc", numbers, [](Lanes x) { return sinhc(x); }, sinhc_of, 8e-16);
  expect_function(
      "x coth", numbers, [](Lanes x) { return x_coth(x); }, x_coth_of, 1e-15);
  expect_function(
      "exp_minus_tangent", numbers, [](Lanes x) { return exp_minus_tangent(x); }, exp_minus_tangent_of,
      2e-15);
  EXPECT_TRUE(all(x_coth(Lanes(0)) == Lanes(1)) && all(expm1(Lanes(0)) == Lanes(0)));
}

TEST(Lanes, conditions_are_asked_of_each_and_of_all)
{
  Lanes x = 1;
  x.v[Lanes::count - 1] = -1;
  EXPECT_TRUE(any(x < 0));
  EXPECT_FALSE(all(x < 0));
  EXPECT_FALSE(any(x > 1));
  EXPECT_TRUE(all(x <= 1));
  EXPECT_TRUE(all(where(x < 0, -x, x) == 1));
  EXPECT_TRUE(all(choose(
                      x < 0, [&] { return -x; }, [&] { return x; }) == 1));
  x.v[0] = infinity;
  EXPECT_FALSE(all(isfinite(x)));
  x.v[0] = std::nan("");
  EXPECT_FALSE(all(isfinite(x)) || all(x == x));
}

/// Points at which a law is evaluated together, with their histories.
struct Row {
  std::vector<Matrix3<double>> F;
  std::vector<double> history, after;
  std::vector<Response<double>> response;

  template <class Law> PointStatus evaluate(const Law &law, StepWeights step)
  {
    after.assign(history.size(), 0);
    response.assign(F.size(), {});
    return evaluate_points(law, static_cast<int>(F.size()), F.data(), history.data(), step, after.data(),
                           true, response.data());
  }
};

/// All sample deformations after each other with both histories, from number `first` on.
Row row_of(const Viscoelastic<double> &material, std::size_t first, std::size_t count)
{
  const auto deformations = samples::deformations();
  const auto histories = samples::histories(material);
  Row row;
  for (std::size_t k = first; k < first + count; ++k) {
    const auto &history = histories[k % 2];
    row.F.push_back(deformations[k % deformations.size()].F);
    row.history.insert(row.history.end(), history.begin(), history.end());
  }
  return row;
}

const std::vector<Viscoelastic<double>> materials = {samples::paper(), samples::odd(),
                                                     samples::hyperelastic(), samples::quadratic()};

TEST(Lanes, the_law_is_that_of_single_points)
{
  const std::size_t count = 2 * samples::deformations().size() + 1;
  for (const auto &material : materials)
    for (const StepWeights step : {StepWeights{0.0}, {0.37}, {41.0}, {infinity}, {0.37, 2.4}}) {
      Row lanes = row_of(material, 0, count), single = lanes;
      ASSERT_EQ(lanes.evaluate(material.cast<Lanes>(), step), PointStatus::ok);
      ASSERT_EQ(single.evaluate(material, step), PointStatus::ok);
      const auto stride = static_cast<std::size_t>(material.history_size());
      for (std::size_t q = 0; q < count; ++q) {
        const Response<double> &a = lanes.response[q], &b = single.response[q];
        const double scale = b.tau.norm() + 2 * material.equilibrium.bulk_modulus;
        EXPECT_LT((a.tau - b.tau).norm(), 1e-14 * scale) << q;
        EXPECT_LT((a.tangent - b.tangent).norm(), 2e-14 * (b.tangent.norm() + scale)) << q;
        EXPECT_NEAR(a.energy, b.energy, 1e-14 * scale) << q;
        EXPECT_NEAR(a.dissipated, b.dissipated, 1e-14 * scale) << q;
        for (std::size_t k = q * stride; k < (q + 1) * stride; ++k)
          EXPECT_NEAR(lanes.after[k], single.after[k], 5e-14 * (1 + std::abs(single.after[k]))) << q;
      }
    }
}

/// The bits of a point's answer are the same alone, in any lane and beside any others: results do not depend
/// on how cells and points follow each other.
TEST(Lanes, no_point_depends_on_its_neighbours)
{
  for (const auto &material : materials) {
    const auto lanes = material.cast<Lanes>();
    const std::size_t count = 2 * samples::deformations().size(),
                      stride = static_cast<std::size_t>(material.history_size());
    Row together = row_of(material, 0, count);
    ASSERT_EQ(together.evaluate(lanes, {0.37}), PointStatus::ok);
    for (std::size_t q = 0; q < count; ++q)
      for (const std::size_t width : {1, 3}) {
        const std::size_t before = q < width ? 0 : width - 1;
        Row some = row_of(material, q - before, width);
        ASSERT_EQ(some.evaluate(lanes, {0.37}), PointStatus::ok);
        const Response<double> &a = together.response[q], &b = some.response[before];
        EXPECT_TRUE(a.tau == b.tau && a.tangent == b.tangent && a.energy == b.energy &&
                    a.dissipated == b.dissipated)
            << q;
        const double *const whole = together.after.data() + q * stride; // a spring has no history
        EXPECT_TRUE(std::equal(whole, whole + stride, some.after.data() + before * stride)) << q;
      }
  }
}

TEST(Lanes, one_point_that_is_no_state_is_reported_for_the_row)
{
  const double nan = std::nan("");
  for (std::size_t bad = 0; bad < 9; ++bad) {
    Row row = row_of(samples::paper(), 0, 9);
    const Matrix3<double> good = row.F[bad];
    for (const double factor : {-1.0, 0.0, nan, infinity}) {
      row.F[bad] = factor * good;
      EXPECT_EQ(row.evaluate(samples::paper().cast<Lanes>(), {0.37}), PointStatus::inverted) << bad;
    }
    row.F[bad] = good;
    EXPECT_EQ(row.evaluate(samples::paper().cast<Lanes>(), {0.37}), PointStatus::ok);
    row.history[6 * bad] = nan;
    EXPECT_EQ(row.evaluate(samples::paper().cast<Lanes>(), {0.37}), PointStatus::local_newton_failed) << bad;
  }
}

// As in test_maxwell.cpp: the quadratic law's mean stress falls below J = 1/2, and a flow may have no root.
TEST(Lanes, a_local_problem_without_a_root_is_reported_for_the_row)
{
  const auto material = samples::quadratic();
  int refused = 0;
  for (const double step : {1.0, 3.0, 10.0, 30.0, 100.0}) {
    Row row = row_of(material, 0, 3);
    ASSERT_EQ(row.evaluate(material.cast<Lanes>(), {step}), PointStatus::ok);
    row.F[1] = std::exp(-3.0) * Matrix3<double>::Identity();
    const PointStatus right =
        material.evaluate(row.F[1], {&row.history[row.history.size() / 3]}, {step}, nullptr, false).status;
    EXPECT_EQ(row.evaluate(material.cast<Lanes>(), {step}), right) << step;
    refused += right == PointStatus::local_newton_failed;
  }
  EXPECT_GT(refused, 0);
}

TEST(Lanes, a_cell_is_that_of_single_points)
{
  using Element = MeanDilatation<AxisymmetricTorsion, 2>;
  const AxisymmetricTorsion kinematics{10};
  const auto material = samples::paper();
  Element::CellType cell;
  std::array<Element::CellType::Position, Element::nodes> X;
  Element::Vector<double> U;
  for (int a = 0; a < Element::nodes; ++a) {
    X[a] = {5 + 0.5 * (a % 3) + 0.02 * a,
            0.5 * (a / 3) - 0.01 * a}; // NOLINT(bugprone-integer-division): a row
    for (int i = 0; i < 3; ++i) U[3 * a + i] = 0.07 * std::sin(1.0 + 3 * a + i);
  }
  ASSERT_TRUE(cell.set(X));
  std::vector<double> history, after(6 * Element::points), after_single = after;
  for (int q = 0; q < Element::points; ++q) {
    const auto one = samples::history(material, 41 + q);
    history.insert(history.end(), one.begin(), one.end());
  }
  Element::Evaluation<double> lanes, single;
  ASSERT_EQ(
      lanes.set(kinematics, cell, material.cast<Lanes>(), U, history.data(), {0.37}, after.data(), true),
      PointStatus::ok);
  ASSERT_EQ(single.set(kinematics, cell, material, U, history.data(), {0.37}, after_single.data(), true),
            PointStatus::ok);
  const auto R = Element::forces(kinematics, cell, lanes),
             R_single = Element::forces(kinematics, cell, single);
  EXPECT_LT((R - R_single).norm(), 1e-13 * R_single.norm());
  Element::Matrix K, K_single;
  Element::tangent(kinematics, cell, lanes, K);
  Element::tangent(kinematics, cell, single, K_single);
  EXPECT_LT((K - K_single).norm(), 1e-13 * K_single.norm());
  for (std::size_t k = 0; k < after.size(); ++k) EXPECT_NEAR(after[k], after_single[k], 1e-13);
}

} // namespace
