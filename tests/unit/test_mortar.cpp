/// Mortar integrals of facet pairs, averaged normals, candidate search.
#include "contact_scene.hpp"

#include <gtest/gtest.h>

namespace tribogel
{
namespace
{

using testing::breaks;
using testing::ContactScene;
using testing::curve;
using testing::flat;

/// All facets of a scene, with their integrals.
struct Mortar {
  std::vector<PlanePoint<double>> x, y, n;
  std::vector<std::pair<int, int>> pairs;
  std::vector<FacetMortar<double>> facets;

  explicit Mortar(const ContactScene &scene)
      : x(positions(scene.geometry.slave, scene.state.slave)),
        y(positions(scene.geometry.master, scene.state.master))
  {
    const CurveGeometry &geometry = scene.geometry;
    for (int a = 0; a < scene.slave_nodes(); ++a)
      n.push_back(nodal_normal<double>(geometry.slave_chain, a, geometry.nodes[a].on_axis,
                                       [&](int b) { return x[b]; }));
    pairs = candidate_pairs(geometry.slave_chain, x, n, geometry.master_chain, y, 0);
    for (int f = 0; f < geometry.slave_chain.facet_count(); ++f)
      facets.push_back(facet_mortar<double>(geometry, f, pairs_of(pairs, f), x, n, y));
  }
};

ContactScene wavy(int order, double slave_radius, double master_radius, unsigned seed)
{
  const auto wave = [](double Z, double amplitude, double frequency) {
    return [=](double R) { return PlanePoint<double>{R, Z + amplitude * std::cos(frequency * R)}; };
  };
  ContactScene scene(curve(order, breaks(7, 0, slave_radius, 0.6, seed), wave(0.02, 0.15, 0.5)),
                     curve(order, breaks(9, 0, master_radius, 0.6, seed + 10), wave(0, 0.2, 0.45)),
                     {.order = order});
  scene.disturb(0.05, 0.3, 0.9, 0.2, seed + 20);
  return scene;
}

/// Largest |sum_m M_am - D_a| over the facets' own D, relative to the facet.
double partition_error(const ContactScene &scene, const Mortar &mortar)
{
  double worst = 0;
  std::visit(
      [&](const auto &measures) {
        for (std::size_t f = 0; f < measures.size(); ++f) {
          double area = 0;
          for (double D : measures[f].basis.D) area += D;
          for (std::size_t a = 0; a < measures[f].R.size(); ++a) {
            double sum = 0;
            for (const auto &M : mortar.facets[f].M) sum += M[a];
            worst = std::max(worst, std::abs(sum - measures[f].basis.D[a]) / area);
          }
        }
      },
      scene.geometry.measures);
  return worst;
}

TEST(LineMortar, CellsAddUpToTheSlaveFacetOnRandomCurvedSurfaces)
{
  for (int order : {1, 2})
    for (double master_radius : {12.5, 10.0, 9.6})
      for (unsigned seed = 1; seed <= 20; ++seed) {
        const ContactScene scene = wavy(order, 10, master_radius, seed);
        const Mortar mortar(scene);
        for (const auto &facet : mortar.facets) EXPECT_EQ(facet.status, MortarStatus::ok);
        EXPECT_LT(partition_error(scene, mortar), 2e-14);
      }
}

TEST(LineMortar, MatchingMeshesCoupleNodeToNode)
{
  for (int order : {1, 2}) {
    const auto radii = breaks(5, 0, 7.3, 0.5, 3);
    const ContactScene scene(flat(order, radii, 0.3), flat(order, radii, 0), {.order = order});
    const Mortar mortar(scene);
    for (int f = 0; f < 5; ++f) {
      const auto &nodes = scene.geometry.slave.facets[f];
      for (std::size_t k = 0; k < mortar.facets[f].masters.size(); ++k)
        for (int a = 0; a <= order; ++a) {
          const bool same = mortar.facets[f].masters[k] == nodes[a];
          const double D =
              std::visit([&](const auto &m) { return m[f].basis.D[a]; }, scene.geometry.measures);
          EXPECT_NEAR(mortar.facets[f].M[k][a], same ? D : 0, 3e-13);
        }
    }
    for (const auto &facet : mortar.facets) EXPECT_EQ(facet.overhang, 0);
  }
}

/// On flat surfaces psi_a is integrated against every polynomial that the master's shape functions can
/// represent, exactly: sum_m M_am q(y_m) = int psi_a q w, the right side by an independent fine rule.
TEST(LineMortar, IsExactOnFlatNonMatchingSurfaces)
{
  static const auto rule = gauss_rule<9>();
  for (int order : {1, 2}) {
    const ContactScene scene(flat(order, breaks(6, 0, 10, 0.7, 3), 0.1),
                             flat(order, breaks(9, 0, 12.5, 0.7, 4), 0), {.order = order});
    const Mortar mortar(scene);
    const auto q = [&](double r) { return order == 1 ? 0.7 - 0.31 * r : 0.7 - 0.31 * r + 0.23 * r * r; };
    std::visit(
        [&](const auto &measures) {
          for (std::size_t f = 0; f < measures.size(); ++f)
            for (std::size_t a = 0; a < measures[f].R.size(); ++a) {
              double mortar_sum = 0, exact = 0;
              for (std::size_t k = 0; k < mortar.facets[f].masters.size(); ++k)
                mortar_sum += mortar.facets[f].M[k][a] * q(mortar.y[mortar.facets[f].masters[k]].r);
              for (int g = 0; g < 9; ++g) {
                const double xi = rule.point[g];
                const auto shape = [&] {
                  if constexpr (std::tuple_size_v<std::decay_t<decltype(measures[f].R)>> == 2)
                    return facet_shape<2>(xi);
                  else
                    return facet_shape<3>(xi);
                }();
                const auto X = mortar.x[scene.geometry.slave.facets[f][0]].r,
                           Y = mortar.x[scene.geometry.slave.facets[f][1]].r;
                exact += rule.weight[g] * measures[f].basis(shape.N)[a] * q(X + 0.5 * (xi + 1) * (Y - X)) *
                         measures[f].weight(shape.N, xi);
              }
              EXPECT_NEAR(mortar_sum, exact, 1e-11) << f << " " << a;
            }
        },
        scene.geometry.measures);
  }
}

/// The same with a curved reference facet, whose weight is of degree four, that has become flat.
TEST(LineMortar, IsExactForACurvedReferenceWeight)
{
  static const auto rule = gauss_rule<9>();
  const auto measure = facet_measure<3>({{{1.3, 0}, {2.1, 0.2}, {1.62, 0.27}}});
  const FacetPoints<3, double> x{{{1.3, 0}, {2.1, 0}, {1.7, 0}}}, n{{{0, -1}, {0, -1}, {0, -1}}};
  const auto q = [](double r) { return 0.7 - 0.31 * r + 0.23 * r * r; };
  std::array<double, 3> mortar_sum{}, exact{};
  const double ends[] = {0.9, 1.5, 1.85, 2.6};
  for (int m = 0; m < 3; ++m) {
    const FacetPoints<3, double> y{
        {{ends[m], -0.1}, {ends[m + 1], -0.1}, {0.5 * (ends[m] + ends[m + 1]), -0.1}}};
    const auto cell = line_pair_mortar<3, double>(measure, {x, n, y});
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) mortar_sum[a] += cell.M[a][b] * q(y[b].r);
  }
  for (int g = 0; g < 9; ++g) {
    const auto N = facet_shape<3>(rule.point[g]).N;
    for (int a = 0; a < 3; ++a)
      exact[a] += rule.weight[g] * measure.basis(N)[a] * q(1.7 + 0.4 * rule.point[g]) *
                  measure.weight(N, rule.point[g]);
  }
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(mortar_sum[a], exact[a], 1e-13);
}

TEST(LineMortar, ReportsTheOverhangAndKeepsItsBalance)
{
  for (int order : {1, 2}) {
    const ContactScene disc(flat(order, breaks(6, 0, 10, 0.7, 3), 0.1),
                            flat(order, breaks(9, 0, 9.1, 0.7, 4), 0), {.order = order});
    const ContactScene ring(flat(order, breaks(6, 3, 10, 0.7, 3), 0.1),
                            flat(order, breaks(9, 3.4, 9.1, 0.7, 4), 0), {.order = order});
    for (const auto &[scene, expected] : {std::pair(disc, 0.9), std::pair(ring, 1.3)}) {
      const Mortar mortar(scene);
      double overhang = 0;
      for (const auto &facet : mortar.facets) {
        EXPECT_EQ(facet.status, MortarStatus::ok);
        overhang += facet.overhang;
      }
      EXPECT_NEAR(overhang, expected, 1e-13);
      EXPECT_LT(partition_error(scene, mortar), 2e-14);
    }
  }
}

/// A master node on the normal line of a slave's end, up to round-off, as where both stick: the root may come
/// out just beyond the facet, the more so the shorter the facet.
TEST(LineMortar, EndsThatCoincideUpToRoundOffAreNoFold)
{
  for (int k = 1; k < 2000; ++k) {
    const double length = 3e-5 * k, tilt = 7e-4 * k;
    const FacetPoints<2, double> x{{{12.3 - length, 0.1 * length}, {12.3, 0}}},
        n{{{0.01, -1}, {std::sin(tilt), -1}}};
    const FacetMeasure<2> measure = facet_measure<2>(x);
    const double depth = 1e-6 * k * length;
    const PlanePoint<double> shared{x[1].r + depth * n[1].r, x[1].z + depth * n[1].z};
    const PlanePoint<double> inner{shared.r - 2 * length, shared.z}, outer{shared.r + length, shared.z};
    const auto before = line_pair_mortar<2, double>(measure, {x, n, {{inner, shared}}});
    const auto behind = line_pair_mortar<2, double>(measure, {x, n, {{shared, outer}}});
    EXPECT_EQ(before.status, MortarStatus::ok);
    EXPECT_EQ(behind.status, MortarStatus::ok);
    EXPECT_NEAR(before.covered + behind.covered, 2, 1e-12);
  }
}

TEST(LineMortar, CoincidentEndsLeaveNothingUndefined)
{
  // the same facet, and neighbours that only share an end: empty cells, no NaN
  const auto measure = facet_measure<2>({{{1.3, 0}, {2.1, 0}}});
  const FacetPoints<2, double> x{{{1.3, 0}, {2.1, 0}}}, n{{{0, -1}, {0, -1}}};
  const auto outside = line_pair_mortar<2, double>(measure, {x, n, {{{2.1, 0}, {2.9, 0}}}});
  EXPECT_EQ(outside.status, MortarStatus::ok);
  EXPECT_EQ(outside.covered, 0);
  for (const auto &row : outside.M)
    for (double M : row) EXPECT_EQ(M, 0);
  LinePair<2, Dual<12>> same;
  for (int a = 0; a < 2; ++a) {
    same.x[a] = {Dual<12>::seed(x[a].r, 2 * a), Dual<12>::seed(x[a].z, 2 * a + 1)};
    same.n[a] = {Dual<12>::seed(0, 4 + 2 * a), Dual<12>::seed(-1, 5 + 2 * a)};
    same.y[a] = {Dual<12>::seed(x[a].r, 8 + 2 * a), Dual<12>::seed(x[a].z, 9 + 2 * a)};
  }
  const auto full = line_pair_mortar<2>(measure, same);
  EXPECT_EQ(full.covered, 2);
  for (const auto &row : full.M)
    for (const auto &M : row) EXPECT_TRUE(isfinite(M));
}

template <int nodes>
void expect_kernel_derivative(const FacetMeasure<nodes> &measure, LinePair<nodes, double> pair)
{
  using D = Dual<6 * nodes>;
  const auto dual = line_pair_mortar<nodes>(measure, axisymmetric_mortar::seeded<nodes>(pair));
  ASSERT_EQ(dual.status, MortarStatus::ok);
  const auto plain = line_pair_mortar<nodes, double>(measure, pair);
  double *coordinates[3] = {&pair.x[0].r, &pair.n[0].r, &pair.y[0].r}; // PlanePoints lie in a row
  const double h = 1e-5;
  double largest = 0, worst = 0;
  for (int j = 0; j < D::directions; ++j) {
    double &q = coordinates[j / (2 * nodes)][j % (2 * nodes)];
    const double keep = q;
    q = keep + h;
    const auto forward = line_pair_mortar<nodes, double>(measure, pair);
    q = keep - h;
    const auto backward = line_pair_mortar<nodes, double>(measure, pair);
    q = keep;
    for (int a = 0; a < nodes; ++a)
      for (int m = 0; m < nodes; ++m) {
        EXPECT_NEAR(dual.M[a][m].v, plain.M[a][m], 1e-14);
        const double difference = (forward.M[a][m] - backward.M[a][m]) / (2 * h);
        largest = std::max(largest, std::abs(difference));
        worst = std::max(worst, std::abs(difference - dual.M[a][m].d[j]));
      }
  }
  EXPECT_LT(worst, 1e-8 * largest);
}

TEST(LineMortar, KernelDerivativesAgreeWithDifferences)
{
  // master shifted inwards, outwards, inside the slave, around it; then as the chain's edge with an overhang
  for (const auto &[from, to] :
       {std::pair(0.9, 1.7), std::pair(1.5, 2.6), std::pair(1.5, 1.9), std::pair(1.1, 2.5)})
    for (bool edge : {false, true}) {
      const LinePair<2, double> straight{{{{1.3, 0.04}, {2.1, -0.03}}},
                                         {{{0.06, -0.99}, {-0.11, -1.02}}},
                                         {{{from, -0.05}, {to, 0.02}}},
                                         edge,
                                         edge};
      expect_kernel_derivative<2>(facet_measure<2>({{{1.3, 0}, {2.1, 0.1}}}), straight);
      const LinePair<3, double> curved{{{{1.3, 0.04}, {2.1, -0.03}, {1.72, 0.07}}},
                                       {{{0.06, -0.99}, {-0.11, -1.02}, {0.03, -0.97}}},
                                       {{{from, -0.05}, {to, 0.02}, {0.48 * from + 0.52 * to, 0.06}}},
                                       edge,
                                       edge};
      expect_kernel_derivative<3>(facet_measure<3>({{{1.3, 0}, {2.1, 0.1}, {1.68, 0.06}}}), curved);
    }
}

TEST(LineMortar, RefusesWhatItCannotIntegrate)
{
  const auto measure = facet_measure<2>({{{1.3, 0}, {2.1, 0}}});
  const FacetPoints<2, double> x{{{1.3, 0}, {2.1, 0}}}, n{{{0, -1}, {0, -1}}};
  const FacetPoints<2, double> backwards{{{2.0, -0.1}, {1.5, -0.1}}};
  EXPECT_EQ((line_pair_mortar<2, double>(measure, {x, n, backwards}).status), MortarStatus::folded);
  const FacetPoints<2, double> crossing{
      {{1, -0.2}, {-1, -0.2}}}; // normals that cross before they reach the master
  EXPECT_EQ((line_pair_mortar<2, double>(measure, {x, crossing, {{{1.5, -9}, {1.9, -9}}}}).status),
            MortarStatus::folded);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ((line_pair_mortar<2, double>(measure, {x, n, {{{1.5, nan}, {1.9, 0}}}}).status),
            MortarStatus::no_projection);

  const ContactScene scene(flat(1, breaks(6, 0, 10), 0.1), flat(1, breaks(9, 0, 12.5), 0), {.order = 1});
  const Mortar mortar(scene);
  const FacetPairs incomplete = pairs_of(mortar.pairs, 2).first(1);
  EXPECT_EQ(facet_mortar<double>(scene.geometry, 2, incomplete, mortar.x, mortar.n, mortar.y).status,
            MortarStatus::uncovered);
}

TEST(Normals, PointOutOfTheSlaveAndAreAveraged)
{
  const auto bowl = [](double t) { return PlanePoint<double>{3 * std::sin(t), 0.4 - 3 * std::cos(t)}; };
  for (int order : {1, 2}) {
    const auto surface = curve(order, breaks(8, 0, 0.9, 0.4, 5), bowl);
    const LineChain chain(surface.facets, order + 1, static_cast<int>(surface.X.size()));
    double worst = 0;
    for (int a = 0; a < chain.node_count(); ++a) {
      const auto n = nodal_normal<double>(chain, a, a == 0, [&](int b) { return surface.X[b]; });
      EXPECT_NEAR(length(n), 1, 1e-15);
      const PlanePoint<double> exact{surface.X[a].r / 3, (surface.X[a].z - 0.4) / 3};
      worst = std::max(worst, length(n - exact));
    }
    EXPECT_LT(worst, order == 1 ? 0.08 : 0.004); // the rim has one facet only: first and second order there
    const auto axis = nodal_normal<double>(chain, 0, true, [&](int b) { return surface.X[b]; });
    EXPECT_EQ(axis.r, 0);
    EXPECT_EQ(axis.z, -1);
  }
  // two facets at right angles: the mean of their normals; the rim sees its own facet only
  const LineChain corner({{0, 1, -1}, {1, 2, -1}}, 2, 3);
  const std::vector<PlanePoint<double>> X{{1, 0}, {2, 0}, {2, 3}};
  const auto at = [&](int b) { return X[b]; };
  EXPECT_NEAR(nodal_normal<double>(corner, 1, false, at).r, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(nodal_normal<double>(corner, 1, false, at).z, -std::sqrt(0.5), 1e-15);
  EXPECT_EQ(nodal_normal<double>(corner, 2, false, at).r, 1);
}

TEST(Normals, DerivativesAgreeWithDifferences)
{
  for (int order : {1, 2}) {
    ContactScene scene = wavy(order, 10, 12, 4);
    const LineChain &chain = scene.geometry.slave_chain;
    auto x = positions(scene.geometry.slave, scene.state.slave);
    const double h = 1e-5;
    for (int a = 1; a < chain.node_count(); ++a) {
      const auto normal = nodal_normal_derivative(chain, a, false, x);
      for (int q = 0; q < 2 * normal.stencil.count; ++q) {
        double &coordinate = q % 2 == 0 ? x[normal.stencil.node[q / 2]].r : x[normal.stencil.node[q / 2]].z;
        const double keep = coordinate;
        coordinate = keep + h;
        const auto forward = nodal_normal<double>(chain, a, false, [&](int b) { return x[b]; });
        coordinate = keep - h;
        const auto backward = nodal_normal<double>(chain, a, false, [&](int b) { return x[b]; });
        coordinate = keep;
        EXPECT_NEAR(normal.n.r.d[q], (forward.r - backward.r) / (2 * h), 1e-8);
        EXPECT_NEAR(normal.n.z.d[q], (forward.z - backward.z) / (2 * h), 1e-8);
      }
    }
  }
}

TEST(Search, FindsWhatIsNeededAndLittleElse)
{
  for (int order : {1, 2})
    for (double lift : {0.0, 3.0}) {
      ContactScene scene = wavy(order, 10, 12.5, 6);
      scene.state.slave.travel = lift;
      const Mortar mortar(scene);
      const int slaves = scene.geometry.slave_chain.facet_count(),
                masters = scene.geometry.master_chain.facet_count();
      std::vector<std::pair<int, int>> all;
      for (int f = 0; f < slaves; ++f)
        for (int m = 0; m < masters; ++m) all.emplace_back(f, m);
      for (int f = 0; f < slaves; ++f) {
        const auto complete =
            facet_mortar<double>(scene.geometry, f, pairs_of(all, f), mortar.x, mortar.n, mortar.y);
        EXPECT_EQ(complete.masters, mortar.facets[f].masters);
        EXPECT_EQ(complete.M, mortar.facets[f].M);
      }
      EXPECT_LT(mortar.pairs.size(), 0.5 * all.size());
    }
}

TEST(Search, PairsWithAMarginStaySufficientWhileTheSurfacesSlide)
{
  ContactScene scene = wavy(2, 10, 14, 6);
  const double margin = 0.8;
  const auto x = positions(scene.geometry.slave, scene.state.slave);
  const Mortar before(scene);
  const auto pairs =
      candidate_pairs(scene.geometry.slave_chain, x, before.n, scene.geometry.master_chain, before.y, margin);
  for (double slide : {-0.7, 0.7}) {
    auto y = before.y;
    for (auto &point : y) point.r += slide;
    for (int f = slide > 0 ? 1 : 0; f < scene.geometry.slave_chain.facet_count();
         ++f) // sliding in bares the axis facet
      EXPECT_EQ(facet_mortar<double>(scene.geometry, f, pairs_of(pairs, f), x, before.n, y).status,
                MortarStatus::ok);
  }
  EXPECT_GT(pairs.size(), before.pairs.size());
}

} // namespace
} // namespace tribogel
