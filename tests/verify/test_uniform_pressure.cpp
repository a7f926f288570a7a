/// Torque of uniform pressure: equal discs on lubricated plates press evenly whatever nu is, and in
/// steady rotation v = omega r exactly, so with the current radius R
///
///     T/(N R) = sum_m b_m (omega R)^m 2/(m+3),    mu = sum_m b_m v^m
///
/// (2 pi int mu r^2 dr over R times pi R^2). The undeformed radius is chosen so that R is the paper's 10 mm,
/// and the laws are cases 1 to 3 of its Table 2. The program sums D_a r_a mu(omega r_a) over the nodes, the
/// integral of the nodal interpolant of r mu: order 1 is exact for m = 0 and second order for m = 1, 2; order
/// 2 is exact for m = 0, 1. With exponents below 1 the interpolant of r^(m+1) errs at the axis too; with a
/// pressure exponent
///
///     T = 2 pi p^a sum_m b_m omega^m R^(m+3)/(m+3),
///
/// p being per current area: per reference area it is 3 % more here, of which the torque would show 1 - a.
/// The gels' twist changes p in second order only: (shear stress)^2/(G p), below 1e-7 here.
#include "tribogel/friction/laws.hpp"
#include "uniform_compression.hpp"

namespace tribogel::test
{

namespace
{

constexpr double R = 10;
const std::vector<double> rates{0.01, 0.1, 1};
const std::vector<double> exponents{0, 1, 2};
const std::vector<std::vector<double>> cases{{0, 2e-4, 0}, {2.6e-4, 0, 1e-5}, {2.2e-4, 3.26e-5, 0}};
const double table[3][3] = {
    {1.00e-5, 1.00e-4, 1.00e-3}, {1.734e-4, 1.773e-4, 5.733e-4}, {1.483e-4, 1.630e-4, 3.097e-4}};

double closed_form(const std::vector<double> &b, double omega)
{
  double sum = 0;
  for (std::size_t m = 0; m < b.size(); ++m)
    sum += b[m] * std::pow(omega * R, exponents[m]) * 2 / (exponents[m] + 3);
  return sum;
}

/// T/(N R) at the end of a phase at each rate, N taken as pi R^2 p^a.
std::vector<double> measured(const Friction &law, double a, int order, int elements)
{
  const SolverOptions options(fixed_steps(1.25, 1e-11));
  const double compression = 0.03;
  const UniaxialState state = uniaxial_state(hyperelastic_gel().equilibrium, 1 - compression);
  Scene scene = lubricated_discs(R / state.lateral, 4.4, 4, order);
  scene.mesh.elements_radial = elements;
  scene.friction = law;
  const double approach = compression * (scene.top.height + scene.bottom.height);
  scene.schedule = schedule_from_rates({2.5, 10, 17.5, 25}, std::vector<double>(4, approach),
                                       {0, rates[0], rates[1], rates[2]});
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  const double N = state.pressure * std::numbers::pi * R * R;
  std::vector<double> ratios;
  for (std::size_t k = 1; k < recorder.phases.size(); ++k) {
    const Measurement &m = recorder.phases[k].measurement;
    EXPECT_NEAR(m.normal_force / N, 1, 1e-7);
    EXPECT_NEAR(m.contact_radius / R, 1, 1e-7);
    const double load = N * std::pow(state.pressure, a - 1); // pi R^2 p^a
    ratios.push_back(m.torque / (load * R));
  }
  return ratios;
}

std::vector<double> measured(const std::vector<double> &b, int order, int elements)
{
  return measured(PolynomialFriction<double>{b, exponents}, 1, order, elements);
}

} // namespace

TEST(uniform_pressure, ClosedFormGivesTheTable)
{
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(closed_form(cases[k], rates[i]) / table[k][i], 1, 3e-4); // its four digits
}

TEST(uniform_pressure, Order1IsSecondOrderInTheMeshWidth)
{
  for (int k = 0; k < 3; ++k) {
    std::vector<double> error[3];
    const int elements[3] = {4, 8, 16};
    for (int level = 0; level < 3; ++level) {
      const auto ratios = measured(cases[k], 1, elements[level]);
      ASSERT_EQ(ratios.size(), rates.size());
      for (int i = 0; i < 3; ++i) {
        const double sliding = closed_form(cases[k], rates[i]) - cases[k][0] * 2 / 3; // m = 0 is exact
        error[level].push_back((ratios[i] - closed_form(cases[k], rates[i])) / sliding);
      }
    }
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(std::log2(error[1][i] / error[2][i]), 2, 0.1);
      EXPECT_LE(std::abs(error[2][i]), 0.01);
    }
  }
}

TEST(uniform_pressure, CoulombIsExactAtOrder1)
{
  for (const double ratio : measured({3.1e-4, 0, 0}, 1, 3)) {
    EXPECT_NEAR(ratio / (3.1e-4 * 2 / 3), 1, 1e-7);
  }
}

TEST(uniform_pressure, Order2IsExactForCoulombAndLinearLaws)
{
  for (const int k : {0, 2}) {
    const auto ratios = measured(cases[k], 2, 3);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(ratios[i] / closed_form(cases[k], rates[i]), 1, 1e-7);
    }
  }
}

TEST(uniform_pressure, Order2QuadraticLaw)
{
  double error[2];
  const int elements[2] = {4, 8};
  for (int level = 0; level < 2; ++level)
    error[level] = measured(cases[1], 2, elements[level])[2] / closed_form(cases[1], rates[2]) - 1;
  EXPECT_GE(std::log2(error[0] / error[1]), 2.8);
  EXPECT_LE(std::abs(error[1]), 1e-3);
}

/// Relative errors at the fastest rate on three meshes, and their order between the last two.
void expect_convergence(const PolynomialFriction<double> &law, int order, double rate, double largest)
{
  double exact = 0;
  for (std::size_t i = 0; i < law.exponents.size(); ++i)
    exact += law.coefficients[i] * std::pow(rates[2] * R, law.exponents[i]) * 2 / (law.exponents[i] + 3);
  std::vector<double> error;
  for (const int elements : {4, 8, 16})
    error.push_back(measured(law, law.pressure_exponent, order, elements)[2] / exact - 1);
  EXPECT_GE(std::log2(std::abs(error[1] / error[2])), rate) << error[0] << ' ' << error[1] << ' ' << error[2];
  EXPECT_LE(std::abs(error[2]), largest);
}

TEST(uniform_pressure, ExponentsBelowOne)
{
  const PolynomialFriction<double> square_root{{2.6e-4}, {0.5}}, tenth{{2.6e-4}, {0.1}},
      mixture{{1e-4, 2e-4, 3e-5, 1e-6}, {0, 0.5, 1, 2}};
  for (const auto &law : {square_root, tenth, mixture}) {
    expect_convergence(law, 1, 1.8, 3e-3);
    expect_convergence(law, 2, 2.8, 1e-4);
  }
}

TEST(uniform_pressure, PressureExponents)
{
  for (const double a : {0.0, 0.5}) { // p is 0.12 MPa: a tenth of the coefficients gives tractions like above
    expect_convergence({{2.6e-5}, {0.5}, a}, 2, 2.8, 1e-4); // Kagata's form
    for (const double ratio : measured(PolynomialFriction<double>{{3.1e-5}, {0}, a}, a, 1, 3)) {
      EXPECT_NEAR(ratio / (3.1e-5 * 2 / 3), 1, 1e-7);
    }
  }
}

/// The other laws, through the whole program: T/(N R) = 2/(R^3 p) int tau(omega r, p) r^2 dr by midpoint sums
/// of formulas written here; speeds go up to 10 mm/s. The rest is the mesh's.
TEST(uniform_pressure, EveryLaw)
{
  struct Case {
    const char *name;
    LawValues values;
    std::function<double(double v, double p)> tau;
  };
  const std::vector<Case> laws{
      {"coulomb", {{2.6e-4}}, [](double, double p) { return 2.6e-4 * p; }},
      {"power",
       {{2.6e-4}, {0.6}, {0.3}, {1}, {1e-5}},
       [](double v, double p) { return 2.6e-4 * std::pow(v + 0.3, 0.6) * p; }},
      {"plateau",
       {{1e-4}, {0.7}, {0.5}},
       [](double v, double p) { return 1e-4 * (1 + std::sqrt(v / 0.7)) * p; }},
      {"exponential_decay",
       {{1e-4}, {3e-4}, {2}},
       [](double v, double p) { return (3e-4 - 2e-4 * std::exp(-v / 2)) * p; }},
      {"stribeck",
       {{2e-4}, {1e-4}, {2}, {2}, {1e-4}},
       [](double v, double p) { return (1e-4 + 1e-4 * std::exp(-v * v / 4) + 1e-4 * v) * p; }},
      {"adsorption_viscous",
       {{1e-5}, {3}, {4e-6}, {1e-5}},
       [](double v, double) { return 2e-5 * (v / 3) / (1 + v * v / 9) + 4e-6 * v; }},
      {"asinh",
       {{1e-4}, {0.4}, {1}, {1e-5}},
       [](double v, double p) { return 1e-4 * std::asinh(v / 0.8) * p; }},
      {"bounded",
       {{2e-4}, {1e-5}, {3e-5}, {1e-5}},
       [](double, double p) { return std::min(2e-4 * p + 1e-5, 3e-5); }},
      {"table", {{0, 2, 5, 20}, {1e-4, 2e-4, 3.5e-4, 1.1e-3}, {0}}, [](double v, double p) {
         return (1e-4 + 5e-5 * v) * p;
       }}}; // four points of a line
  constexpr int rings = 4000;
  const double p = uniaxial_state(hyperelastic_gel().equilibrium, 0.97).pressure;
  std::size_t found = 0;
  for (const KnownLaw &known : known_laws())
    for (const Case &law : laws) {
      if (law.name != std::string(known.declaration->name)) continue;
      ++found;
      const auto ratios = measured(known.make(law.values), 1, 2, 8);
      for (std::size_t i = 0; i < rates.size(); ++i) {
        double sum = 0;
        for (int k = 0; k < rings; ++k) {
          const double r = R * (k + 0.5) / rings;
          sum += law.tau(rates[i] * r, p) * r * r * R / rings;
        }
        EXPECT_NEAR(ratios[i] / (2 * sum / (R * R * R * p)), 1, 3e-4) << law.name << " at " << rates[i];
      }
    }
  EXPECT_EQ(found, laws.size());
}

} // namespace tribogel::test
