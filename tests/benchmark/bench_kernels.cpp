// Kernels against the machine: a material point, residual and tangent of a cell, mortar integrals of a pair
// of facets, each with a plain count of its arithmetic; and what this core does at best in cache and from
// memory.
#include "tribogel/contact/surface/mortar_kernel.hpp"
#include "tribogel/element/mean_dilatation.hpp"
#include "tribogel/kinematics/axisymmetric.hpp"
#include "tribogel/kinematics/solid.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

using namespace tribogel;

namespace
{

/// The paper's gel, and its spring alone.
Viscoelastic<double> gel(bool viscoelastic)
{
  Viscoelastic<double> material{{{0.75, 0.45, 0.18}, {1.3, 2, 5}, 200}, {}};
  if (viscoelastic) material.branches.push_back({{{0.25, 0.45, 0.18}, {1.3, 2, 5}, 200}, 4.5, 200});
  return material;
}

void set_rate(benchmark::State &state, const char *what, double each)
{
  state.counters[what] = benchmark::Counter(each, benchmark::Counter::kIsIterationInvariantRate);
}

/// The attainable peak: a dense product that stays in the first cache, two operations a multiplication.
void peak(benchmark::State &state)
{
  constexpr int n = 48;
  using Square = Eigen::Matrix<double, n, n>;
  Square A = Square::Random(), B = Square::Random(), C = Square::Zero();
  for (auto _ : state) {
    C.noalias() += A * B;
    benchmark::DoNotOptimize(C.data());
    benchmark::ClobberMemory();
  }
  set_rate(state, "flop/s", 2.0 * n * n * n);
}
BENCHMARK(peak);

/// STREAM's triad, a = b + s c: 24 bytes an entry (without the write's own read).
void triad(benchmark::State &state)
{
  constexpr std::size_t n = 8 << 20;
  std::vector<double> a(n, 0), b(n, 1), c(n, 2);
  for (auto _ : state) {
    for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + 3.0 * c[i];
    benchmark::DoNotOptimize(a.data());
    benchmark::ClobberMemory();
  }
  set_rate(state, "B/s", 24.0 * n);
}
BENCHMARK(triad);

/// A row of points that are not alike.
template <class Scalar> void material_points(benchmark::State &state, bool viscoelastic, bool with_tangent)
{
  constexpr int count = 64;
  const auto material = gel(viscoelastic).cast<Scalar>();
  const int stride = material.history_size();
  std::vector<double> history(static_cast<std::size_t>(count * stride)), after = history;
  for (int q = 0; stride > 0 && q < count; ++q) gel(viscoelastic).initial_history(&history[q * stride]);
  std::vector<Matrix3<double>> F(count);
  std::vector<Response<double>> response(count);
  for (int q = 0; q < count; ++q) {
    F[q] << 1.08, 0.05, 0.2, -0.03, 1.06, 0.1, 0.02, -0.04, 0.9;
    F[q](0, 1) += 0.002 * q;
    F[q](2, 2) -= 0.001 * q;
  }
  for (auto _ : state) {
    F[0](0, 0) += 1e-9;
    benchmark::DoNotOptimize(evaluate_points(material, count, F.data(), history.data(), {0.5, 1},
                                             after.data(), with_tangent, response.data()));
    benchmark::ClobberMemory();
  }
  set_rate(state, "points/s", count);
}

/// A cell of about 1 mm away from the axis, deformed at random.
template <class Kinematics, int order> struct Sample {
  using Element = MeanDilatation<Kinematics, order>;
  typename Element::CellType cell;
  typename Element::template Vector<double> U;

  Sample()
  {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> part(-0.02, 0.02);
    std::array<typename Element::CellType::Position, Element::nodes> X;
    for (int a = 0; a < Element::nodes; ++a)
      for (int j = 0, rest = a; j < Kinematics::dim; ++j, rest /= order + 1)
        X[a][j] = 5 + static_cast<double>(rest % (order + 1)) / order + part(random);
    cell.set(X);
    for (auto &u : U) u = part(random);
  }
};

/// What the loops over nodes and inputs of the tangent do (the widest ones: sums over pairs of nodes of
/// inputs that belong to unknowns i <= j, the low-rank part of the dilatation, the second derivative by the
/// inputs); the material's point is not in it.
template <class Element, class Kinematics> double tangent_operations()
{
  const double n = Element::nodes, u = Element::unknowns, m = Element::modes;
  const auto inputs = static_cast<double>(Kinematics::inputs.size());
  double pairs = 0; // of input and unknown j >= its own
  for (const auto &input : Kinematics::inputs) pairs += u - input.unknown;
  const double second = 2 * (inputs + 1) * (36 + 6 * (inputs + 1) + 27 + 9 * (inputs + 1));
  return 2 * pairs * n * n + 2 * inputs * pairs * n + 4 * m * inputs * n + second +
         4 * m * (n * u) * (n * u) / Element::points;
}

template <class Kinematics, int order, bool tangent>
void cell(benchmark::State &state, Kinematics kinematics, bool viscoelastic)
{
  using Element = MeanDilatation<Kinematics, order>;
  Sample<Kinematics, order> sample;
  const auto material = gel(viscoelastic).cast<Lanes>();
  const int stride = material.history_size();
  std::vector<double> history(static_cast<std::size_t>(Element::points * stride));
  for (int q = 0; stride > 0 && q < Element::points; ++q)
    gel(viscoelastic).initial_history(&history[q * stride]);
  typename Element::template Evaluation<double> evaluation;
  typename Element::Matrix K;
  for (auto _ : state) {
    sample.U[0] += 1e-9;
    if (evaluation.set(kinematics, sample.cell, material, sample.U, history.data(), {0.5, 0}, nullptr,
                       tangent) != PointStatus::ok)
      state.SkipWithError("the sample is turned inside out");
    if constexpr (tangent) {
      Element::tangent(kinematics, sample.cell, evaluation, K);
      benchmark::DoNotOptimize(K.data());
    } else
      benchmark::DoNotOptimize(Element::forces(kinematics, sample.cell, evaluation));
  }
  set_rate(state, "points/s", Element::points);
  if (!tangent) return;
  set_rate(state, "flop/s", Element::points * tangent_operations<Element, Kinematics>());
  set_rate(state, "B/s", sizeof(K) + sizeof(sample.cell)); // written, and read of what never changes
}

template <int order> void register_cells()
{
  for (const bool viscoelastic : {false, true}) {
    const std::string end =
        std::string(viscoelastic ? "viscoelastic" : "hyperelastic") + "/order:" + std::to_string(order);
    const auto add = [&]<class Kinematics>(const char *name, const Kinematics &k) {
      benchmark::RegisterBenchmark((std::string(name) + "/residual/" + end).c_str(),
                                   cell<Kinematics, order, false>, k, viscoelastic);
      benchmark::RegisterBenchmark((std::string(name) + "/tangent/" + end).c_str(),
                                   cell<Kinematics, order, true>, k, viscoelastic);
    };
    add("axisymmetric", AxisymmetricTorsion{10});
    add("solid", Solid{});
  }
}

/// A slave facet of 1 mm on one that is turned by 20 degrees below it: an octagon's worth of triangles.
template <int order> void facet_pair(benchmark::State &state, bool with_derivatives)
{
  QuadPair<order> pair;
  const double c = std::cos(0.35), s = std::sin(0.35);
  for (int a = 0; a < tensor_nodes<2, order>; ++a) {
    const double x = static_cast<double>(a % (order + 1)) / order - 0.5,
                 y = static_cast<double>(a / (order + 1)) / order - 0.5;
    pair.x[a] = {y, x, 0.02 * x * x}; // seen from below
    pair.n[a] = Vector3<double>(0.01 * y, 0.02 * x, -1).normalized();
    pair.y[a] = {c * x - s * y, s * x + c * y, 0.01 * y * y};
  }
  const auto measure = quad_measure<order>(pair.x);
  for (auto _ : state) benchmark::DoNotOptimize(quad_pair_mortar<order>(measure, pair, with_derivatives));
  set_rate(state, "pairs/s", 1);
}
} // namespace

int main(int argc, char **argv)
{
  for (const bool viscoelastic : {false, true})
    for (const bool with_tangent : {false, true}) {
      const std::string end = std::string(viscoelastic ? "viscoelastic" : "hyperelastic") +
                              (with_tangent ? "_tangent" : "_stress");
      benchmark::RegisterBenchmark(("material/one_by_one/" + end).c_str(), material_points<double>,
                                   viscoelastic, with_tangent);
      benchmark::RegisterBenchmark(("material/lanes/" + end).c_str(), material_points<Lanes>, viscoelastic,
                                   with_tangent);
    }
  register_cells<1>();
  register_cells<2>();
  for (const bool derivatives : {false, true}) {
    const std::string what = std::string("facet_pair/") + (derivatives ? "derivatives" : "values");
    benchmark::RegisterBenchmark((what + "/order:1").c_str(), facet_pair<1>, derivatives);
    benchmark::RegisterBenchmark((what + "/order:2").c_str(), facet_pair<2>, derivatives);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
