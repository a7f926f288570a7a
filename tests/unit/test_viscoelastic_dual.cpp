#include "material_samples.hpp"
#include "matrix_reference.hpp"

#include "tribogel/material/viscoelastic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
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

/// Every number the law depends on, in one list: F, history, parameters.
template <class T, class Visit>
void visit_inputs(Matrix3<T> &F, std::vector<T> &history, Viscoelastic<T> &material, Visit visit)
{
  for (int i = 0; i < 9; ++i) visit(F(i));
  for (T &x : history) visit(x);
  const auto spring = [&](Ogden<T> &o) {
    for (T &x : o.moduli) visit(x);
    for (T &x : o.exponents) visit(x);
    visit(o.bulk_modulus);
  };
  spring(material.equilibrium);
  for (auto &b : material.branches) {
    spring(b.spring);
    visit(b.deviatoric_viscosity);
    visit(b.volumetric_viscosity);
  }
}

template <class T>
Eigen::Matrix<T, Eigen::Dynamic, 1> outputs(const Response<T> &r, const std::vector<T> &history)
{
  Eigen::Matrix<T, Eigen::Dynamic, 1> out(8 + history.size());
  out << r.tau, r.energy, r.dissipated,
      Eigen::Map<const Eigen::Matrix<T, Eigen::Dynamic, 1>>(history.data(), history.size());
  return out;
}

using DirectionalInput = std::function<double(int)>; // the direction's component for input i

Eigen::VectorXd dual_derivative(const Viscoelastic<double> &material, const Matrix3<double> &F,
                                const std::vector<double> &history, double step,
                                const DirectionalInput &direction)
{
  using D = Dual<1>;
  auto law = material.cast<D>();
  Matrix3<D> G = F.cast<D>();
  std::vector<D> old(history.begin(), history.end()), updated(history.size());
  int i = 0;
  visit_inputs(G, old, law, [&](D &x) { x.d[0] = direction(i++); });
  const auto response = law.evaluate(G, {old.data()}, {step}, updated.data(), false);
  EXPECT_EQ(response.status, PointStatus::ok);
  const Step plain = take(material, F, history, step, false);
  const auto out = outputs(response, updated);
  const auto values = outputs(plain.response, plain.history);
  EXPECT_LE(difference(value(out), values),
            1e-13 * values.norm() + 1e-15 * material.equilibrium.bulk_modulus);
  return derivative(out, 0);
}

Eigen::VectorXd complex_step_derivative(const Viscoelastic<double> &material, const Matrix3<double> &F,
                                        const std::vector<double> &history, double step,
                                        const DirectionalInput &direction)
{
  using reference::Complex;
  auto law = reference::law(material);
  reference::Matrix G = lift(F);
  std::vector<Complex> old(history.begin(), history.end());
  int i = 0;
  const auto perturb = [&](Complex &x) { x += Complex(0, reference::tiny * direction(i++)); };
  for (int k = 0; k < 9; ++k) perturb(G(k));
  for (Complex &x : old) perturb(x);
  const auto spring = [&](reference::Spring &o) {
    for (Complex &x : o.moduli) perturb(x);
    for (Complex &x : o.exponents) perturb(x);
    perturb(o.bulk_modulus);
  };
  spring(law.equilibrium);
  for (auto &b : law.branches) {
    spring(b.spring);
    perturb(b.deviatoric_viscosity);
    perturb(b.volumetric_viscosity);
  }
  std::vector<reference::Matrix> levels;
  for (std::size_t m = 0; m < material.branches.size(); ++m) {
    levels.push_back(reference::Matrix::Zero());
    for (int k = 0; k < 6;
         ++k) // unit_strain has both off-diagonal entries 1, a Mandel component both 1/sqrt(2)
      levels.back() += old[6 * m + k] / std::sqrt(k < 3 ? 1.0L : 2.0L) * reference::unit_strain(k);
  }
  const auto state = law.evaluate(G, levels, step);
  Eigen::VectorXd out(8 + history.size());
  out.head<6>() = to_mandel<double>(reference::derivative(state.tau));
  out[6] = reference::derivative(state.energy);
  out[7] = reference::derivative(state.dissipated);
  for (std::size_t m = 0; m < levels.size(); ++m)
    out.segment<6>(8 + 6 * m) = to_mandel<double>(reference::derivative(state.history[m]));
  return out;
}

TEST(Viscoelastic, dual_numbers_carry_exact_derivatives_with_respect_to_every_input)
{
  for (const auto &material : materials)
    for (const auto &history : histories(material))
      for (const auto &[name, F] : samples::deformations())
        for (double step : {0.0, 0.37, 41.0}) {
          const DirectionalInput direction = [](int i) { return std::cos(1.7 * i + 0.3); };
          const Eigen::VectorXd got = dual_derivative(material, F, history, step, direction);
          const Eigen::VectorXd exact = complex_step_derivative(material, F, history, step, direction);
          EXPECT_LT(difference(got.head<8>(), exact.head<8>()), 1e-12 * exact.head<8>().norm()) << name;
          if (material.history_size() == 0) continue;
          const auto size = material.history_size();
          EXPECT_LT(difference(got.tail(size), exact.tail(size)), 1e-12 * exact.tail(size).norm()) << name;
        }
}

TEST(Viscoelastic, single_dual_derivatives_agree_with_differences)
{
  const auto material = samples::odd();
  const auto history = samples::history(material, 43);
  const Matrix3<double> F = samples::stretched(1.2, 0.85, 1.05, 44);
  int inputs = 0;
  {
    auto copy = material;
    auto G = F;
    auto old = history;
    visit_inputs(G, old, copy, [&](double &) { ++inputs; });
  }
  ASSERT_EQ(inputs, 9 + 12 + 5 + 9 + 5);
  for (int k = 0; k < inputs; ++k) {
    const auto at = [&](double shift) {
      auto copy = material;
      auto G = F;
      auto old = history;
      int i = 0;
      visit_inputs(G, old, copy, [&](double &x) { x += i++ == k ? shift : 0; });
      const Step s = take(copy, G, old, 0.37, false);
      return outputs(s.response, s.history);
    };
    const double h = 1e-5;
    const Eigen::VectorXd central = (at(h) - at(-h)) / (2 * h);
    const Eigen::VectorXd got =
        dual_derivative(material, F, history, 0.37, [k](int i) { return i == k ? 1 : 0; });
    EXPECT_LT(difference(got, central), 2e-8 * (1 + central.norm())) << "input " << k;
  }
}

TEST(Viscoelastic, dual_derivatives_of_the_relaxed_state_are_those_of_the_equilibrium_spring)
{
  using D = Dual<1>;
  const auto material = samples::odd();
  const auto history = samples::history(material, 45);
  Matrix3<D> F = samples::stretched(1.2, 0.85, 1.05, 46).cast<D>();
  for (int i = 0; i < 9; ++i) F(i).d[0] = 0.3 * i - 1.1;
  std::vector<D> old(history.begin(), history.end()), updated(12);
  const auto full = material.cast<D>().evaluate(F, {old.data()}, {infinity}, updated.data(), false);
  const auto spring =
      Viscoelastic<double>{material.equilibrium, {}}.cast<D>().evaluate(F, {}, {infinity}, nullptr, false);
  EXPECT_EQ(value(full.tau), value(spring.tau));
  EXPECT_EQ(derivative(full.tau, 0), derivative(spring.tau, 0));
  const Matrix3<D> inverse = F.inverse(), Xexact = inverse * inverse.transpose();
  for (int m = 0; m < 2; ++m) {
    const Mandel<D> X = Eigen::Map<const Mandel<D>>(&updated[6 * m]);
    EXPECT_LT(difference(value(X), value(to_mandel(Xexact))), 1e-15);
    EXPECT_LT(difference(derivative(X, 0), derivative(to_mandel(Xexact), 0)), 1e-14);
  }
}

} // namespace
