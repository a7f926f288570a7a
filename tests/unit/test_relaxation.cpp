#include "evolution_law.hpp"

#include <cmath>
#include <vector>

using namespace tribogel;
using samples::integrate_flow;
using samples::stress_at;
using samples::wandering;
using Deformation = Matrix3<double> (*)(double);

namespace
{

struct Path {
  Response<double> last;
  std::vector<double> history;
  double work = 0, dissipated = 0, least_dissipation = 1;
};

/// Equal steps from the virgin state; the work of the stresses by the trapezoidal rule on F.
Path follow(const Viscoelastic<double> &material, Deformation deformation, double end, int steps)
{
  Path path;
  path.history.resize(material.history_size());
  material.initial_history(path.history.data());
  auto updated = path.history;
  Matrix3<double> F = deformation(0), P = Matrix3<double>::Zero();
  for (int i = 1; i <= steps; ++i) {
    const Matrix3<double> next = deformation(end * i / steps);
    path.last = material.evaluate(next, {path.history.data()}, {end / steps}, updated.data(), false);
    EXPECT_EQ(path.last.status, PointStatus::ok);
    path.history.swap(updated);
    const Matrix3<double> P_next = from_mandel(path.last.tau) * next.inverse().transpose();
    path.work += (0.5 * (P + P_next)).cwiseProduct(next - F).sum();
    path.dissipated += path.last.dissipated;
    path.least_dissipation = std::min(path.least_dissipation, path.last.dissipated);
    F = next;
    P = P_next;
  }
  return path;
}

// Richardson's extrapolation shows that the limit is the solution and not merely some limit.
TEST(Relaxation, converges_to_the_evolution_law_at_first_order)
{
  auto soft = samples::paper(); // the paper's gel would hide the error in shear behind its bulk modulus
  soft.equilibrium.bulk_modulus = 4.1;
  soft.branches[0].spring.bulk_modulus = 2.3;
  for (const auto &material : {soft, samples::odd()}) {
    const double end = 3.1;
    const Mandel<double> exact =
        stress_at(material, wandering(end), integrate_flow(material, wandering, end));
    std::vector<double> error;
    std::vector<Mandel<double>> tau;
    for (int steps : {100, 200, 400, 800, 1600}) {
      tau.push_back(follow(material, wandering, end, steps).last.tau);
      error.push_back((tau.back() - exact).norm() / exact.norm());
    }
    for (std::size_t i = 1; i < error.size(); ++i) {
      const double order = std::log2(error[i - 1] / error[i]);
      EXPECT_GT(order, 0.95) << "error " << error[i];
      EXPECT_LT(order, 1.1) << "error " << error[i];
    }
    std::vector<Mandel<double>> table = tau;
    for (int level = 1; level < 5; ++level)
      for (std::size_t i = 4; i >= static_cast<std::size_t>(level); --i)
        table[i] += (table[i] - table[i - 1]) / (std::pow(2, level) - 1);
    RecordProperty("error_1600_steps", std::to_string(error.back()));
    EXPECT_LT((table[4] - exact).norm() / exact.norm(), 1e-8);
  }
}

/// Stress of a strain that is held from t = 0 on, divided by the strain: G(t) or K(t).
std::vector<double> relaxation(const Viscoelastic<double> &material, const Matrix3<double> &F, double step,
                               int steps, int component, double strain)
{
  std::vector<double> history(material.history_size()), moduli;
  material.initial_history(history.data());
  auto updated = history;
  for (int i = 0; i < steps; ++i) {
    const auto r = material.evaluate(F, {history.data()}, {step}, updated.data(), false);
    moduli.push_back(from_mandel(r.tau)(component, 0) / strain);
    history.swap(updated);
  }
  return moduli;
}

// The backward Euler recursion to the accuracy of the linearisation, and through it G(t) and K(t).
TEST(Relaxation, small_strains_relax_with_the_linear_moduli)
{
  const double strain = 1e-5, end = 2.6;
  for (const auto &material : {samples::paper(), samples::odd()}) {
    Matrix3<double> shear = Matrix3<double>::Identity(),
                    swelling = Matrix3<double>::Identity() * std::cbrt(1 + strain);
    shear(0, 1) = strain;
    std::vector<double> shear_error, bulk_error;
    for (int steps : {200, 400, 800}) {
      const double step = end / steps;
      const auto G = relaxation(material, shear, step, steps, 1, strain);
      const auto K = relaxation(material, swelling, step, steps, 0, strain);
      double exact_G = material.equilibrium.shear_modulus(), exact_K = material.equilibrium.bulk_modulus;
      for (int i = 0; i < steps; ++i) {
        double G_euler = material.equilibrium.shear_modulus(), K_euler = material.equilibrium.bulk_modulus;
        for (const auto &b : material.branches) {
          const double Gv = b.spring.shear_modulus(), Kv = b.spring.bulk_modulus;
          G_euler += Gv * std::pow(1 + step * Gv / b.deviatoric_viscosity, -(i + 1));
          K_euler += Kv * std::pow(1 + step * Kv / b.volumetric_viscosity, -(i + 1));
        }
        ASSERT_NEAR(G[i] / G_euler, 1, 5 * strain);
        ASSERT_NEAR(K[i] / K_euler, 1, 5 * strain);
      }
      for (const auto &b : material.branches) {
        exact_G +=
            b.spring.shear_modulus() * std::exp(-end * b.spring.shear_modulus() / b.deviatoric_viscosity);
        exact_K += b.spring.bulk_modulus * std::exp(-end * b.spring.bulk_modulus / b.volumetric_viscosity);
      }
      shear_error.push_back(std::abs(G.back() / exact_G - 1));
      bulk_error.push_back(std::abs(K.back() / exact_K - 1));
    }
    for (const auto &error : {shear_error, bulk_error})
      for (int i : {1, 2}) EXPECT_NEAR(std::log2(error[i - 1] / error[i]), 1, 0.05);
  }
}

// Positive dissipation alone would not do: the balance ties it to stress and stored energy.
TEST(Relaxation, work_in_a_closed_cycle_is_stored_plus_dissipated)
{
  for (const auto &material : {samples::paper(), samples::odd()}) {
    std::vector<double> residual;
    for (int steps : {200, 400, 800, 1600}) {
      const Path path = follow(material, wandering, 4, steps);
      EXPECT_GT(path.least_dissipation, 0);
      residual.push_back(std::abs(path.work - path.last.energy - path.dissipated) / path.dissipated);
    }
    for (std::size_t i = 1; i < residual.size(); ++i)
      EXPECT_GT(std::log2(residual[i - 1] / residual[i]), 0.9) << "residual " << residual[i];
    EXPECT_LT(residual.back(), 0.02);
  }
}

TEST(Relaxation, a_hyperelastic_cycle_returns_all_work)
{
  const Path path = follow(samples::hyperelastic(), wandering, 4, 4000);
  EXPECT_EQ(path.dissipated, 0);
  EXPECT_NEAR(path.last.energy, 0, 1e-13);
  EXPECT_NEAR(path.work, 0, 1e-5);
}

} // namespace
