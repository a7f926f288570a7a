/// A flat punch of radius a on a half-space of hexahedra, without contact: displacements are prescribed below
/// it.
///
/// Bonded and turned: T = 16/3 G a^3 theta; a finite block errs (a/L)^3 only. Pressed without
/// friction: F = 2 E* a delta; a finite block of width and height L errs c a/L, so that two of them give the
/// half-space: delta/F = 2 (delta/F)_2L - (delta/F)_L.
///
/// The tractions are infinite at the edge. Towards it edges halve one by one, down to `finest`; what is left
/// of T is proportional to that, so its limit is 2 T_fine - T_coarse. In indentation the ratio of the edges,
/// which stays 2, shows at order 1.
#include "outlines.hpp"
#include "solids.hpp"

#include "gmsh/bodies.hpp"

#include <numbers>

namespace tribogel::test
{

namespace
{

constexpr double a = 1.3, pi = std::numbers::pi, G = 0.4;

/// Distances from 0 to L that begin with `first` and about double.
std::vector<double> doubling(double L, double first)
{
  const long n = std::lround(std::log2(1 + L / first));
  double low = 1.01, high = 8; // the ratio
  for (int k = 0; k < 80; ++k) {
    const double q = 0.5 * (low + high);
    (first * (std::pow(q, n) - 1) / (q - 1) < L ? low : high) = q;
  }
  std::vector<double> points;
  for (long k = 0; k < n; ++k) points.push_back(first * (std::pow(low, k) - 1) / (low - 1));
  points.push_back(L);
  return points;
}

/// Half the edge of the inner square over a.
constexpr double square = 0.45;

double radius(const std::array<double, 3> &X)
{
  return std::hypot(X[0], X[1]);
}

/// A disc of `around` cells about the axis, a multiple of 8; cells in lexicographic order of vertices. All
/// but the inner square is polar.
struct Plane {
  std::vector<std::array<double, 2>> vertex;
  std::vector<std::array<int, 4>> cell;

  Plane(double L, double finest, int around) : k(around / 8), n(2 * k)
  {
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const double x = static_cast<double>(i) / k - 1, y = static_cast<double>(j) / k - 1;
        const double s = std::max(std::abs(x), std::abs(y)), R = std::hypot(x, y); // squares to circles
        vertex.push_back({s > 0 ? square * a * s * x / R : 0, s > 0 ? square * a * s * y / R : 0});
      }
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) cell.push_back({at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
    std::vector<int> ring;
    for (int i = 0; i < n; ++i) ring.push_back(at(n, i));
    for (int i = 0; i < n; ++i) ring.push_back(at(n - i, n));
    for (int i = 0; i < n; ++i) ring.push_back(at(0, n - i));
    for (int i = 0; i < n; ++i) ring.push_back(at(i, 0));
    std::vector<double> r; // beyond the square
    const std::vector<double> inside = doubling(a * (1 - square), finest), outside = doubling(L - a, finest);
    for (auto d = inside.rbegin() + 1; d != inside.rend(); ++d) r.push_back(a - *d);
    for (std::size_t i = 1; i < outside.size(); ++i) r.push_back(a + outside[i]);
    for (const double R : r) add_ring(R, ring);
  }

private:
  int at(int i, int j) const { return i + j * (n + 1); }

  void add_ring(double R, std::vector<int> &ring)
  {
    std::vector<int> next;
    for (const int from : ring) {
      const double angle = std::atan2(vertex[from][1], vertex[from][0]);
      next.push_back(static_cast<int>(vertex.size()));
      vertex.push_back({R * std::cos(angle), R * std::sin(angle)});
    }
    for (std::size_t p = 0; p < ring.size(); ++p) {
      const std::size_t q = (p + 1) % ring.size();
      cell.push_back({ring[p], next[p], ring[q], next[q]});
    }
    ring = next;
  }

  int k, n;
};

/// The middle of an edge, a face or a cell beyond the square: on its circle.
void place_middle(const std::vector<int> &vertices, SerialMesh &mesh)
{
  double R = 0, x = 0, y = 0, Z = 0;
  for (const int v : vertices) {
    const auto &X = mesh.vertex[v];
    if (radius(X) < square * a * (1 - 1e-9)) return;
    R += radius(X) / static_cast<double>(vertices.size());
    Z += X[2] / static_cast<double>(vertices.size());
    x += X[0] / radius(X);
    y += X[1] / radius(X);
  }
  mesh.middle[middle_key(vertices)] = {R * x / std::hypot(x, y), R * y / std::hypot(x, y), Z};
}

void place_middles(const std::array<int, 8> &c, SerialMesh &mesh)
{
  constexpr int edge[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                               {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  for (const auto &e : edge) place_middle({c[e[0]], c[e[1]]}, mesh);
  place_middle({c.begin(), c.end()}, mesh);
}

/// A cylinder of radius and height L below z = 0. The upper face within a is the upper plate's; planes of
/// symmetry are held if `symmetric`.
SerialMesh punched(double L, double finest, int around, bool symmetric)
{
  constexpr int face[6][4] = {{0, 2, 4, 6}, {1, 3, 5, 7}, {0, 1, 4, 5},
                              {2, 3, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}};
  const Plane plane(L, finest, around);
  const std::vector<double> z = doubling(L, finest);
  const int stride = static_cast<int>(plane.vertex.size()), layers = static_cast<int>(z.size()) - 1;
  SerialMesh mesh;
  mesh.dim = 3;
  for (int l = 0; l <= layers; ++l)
    for (const auto &x : plane.vertex) mesh.vertex.push_back({x[0], x[1], -z[layers - l]});
  for (int l = 0; l < layers; ++l)
    for (const auto &quadrilateral : plane.cell) {
      std::array<int, 8> c;
      for (int v = 0; v < 8; ++v) c[v] = (l + v / 4) * stride + quadrilateral[v % 4];
      mesh.cell.push_back({c, bottom_body, 0});
      place_middles(c, mesh);
      for (int f = 0; f < 6; ++f) {
        const std::array<int, 4> at{c[face[f][0]], c[face[f][1]], c[face[f][2]], c[face[f][3]]};
        const auto all = [&](const auto &holds) {
          return std::all_of(at.begin(), at.end(), [&](int v) { return holds(mesh.vertex[v]); });
        };
        place_middle({at.begin(), at.end()}, mesh);
        if (f == 4 && l == 0) mesh.boundary.push_back({at, Side::bottom_plate});
        if (f == 5 && l == layers - 1 && all([](const auto &X) { return radius(X) < a * (1 + 1e-9); }))
          mesh.boundary.push_back({at, Side::top_plate});
        for (int j = 0; j < 2; ++j)
          if (symmetric && all([j](const auto &X) { return std::abs(X[j]) < 1e-9; }))
            mesh.boundary.push_back({at, j == 0 ? Side::fixed_x : Side::fixed_y});
      }
    }
  return mesh;
}

Measurement pressed_or_turned(int order, double L, double finest, double depth, double angle,
                              double bulk_over_shear)
{
  Scene scene = solid_cylinder(L, L, neo_hookean(G, bulk_over_shear), order, 1);
  scene.schedule = schedule_from_twists({1}, {depth}, {angle});
  if (angle == 0) scene.plate_bond = PlateBond::lubricated;
  const SolverOptions options(fixed_steps(1, 1e-9));
  Problem problem;
  Recorder recorder("");
  bool completed = false;
  std::string why;
  EXPECT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene, punched(L, finest, order == 1 ? 24 : 16, angle == 0)), 0);
  EXPECT_EQ(problem.Run({&recorder}, completed, why), 0);
  EXPECT_TRUE(completed) << why;
  std::printf("order %d, L/a %g, finest edge %.3f a: %zu cells, %d unknowns", order, L / a, finest / a,
              problem.system.mesh.cells.size(), static_cast<int>(problem.system.mesh.unknowns));
  return recorder.rows.back().measurement;
}

double torsion_error(int order, double finest)
{
  const double theta = 1e-5, T = pressed_or_turned(order, 10 * a, finest, 0, theta, 1e3).torque;
  const double error = T / (16.0 / 3 * G * a * a * a * theta) - 1;
  std::printf(": error of T %.2e\n", error);
  return error;
}

double indentation_error(int order, double finest)
{
  const double depth = 1e-5 * a, E = Elastic(neo_hookean(G, 5).equilibrium).plane();
  double compliance[2];
  for (int k = 0; k < 2; ++k) {
    const double F = pressed_or_turned(order, (k ? 20 : 10) * a, finest, depth, 0, 5).normal_force;
    compliance[k] = depth / F * 2 * E * a;
    std::printf(": 2 E* a delta/F %.5f\n", compliance[k]);
  }
  const double error = 1 / (2 * compliance[1] - compliance[0]) - 1;
  std::printf("order %d: error of F %.2e\n", order, error);
  return error;
}

} // namespace

TEST(solid_punch, Torsion)
{
  for (int order : {1, 2}) {
    const double coarse = torsion_error(order, 0.2 * a), fine = torsion_error(order, 0.1 * a);
    EXPECT_NEAR(fine / coarse, 0.5, 0.05);
    EXPECT_LT(std::abs(2 * fine - coarse), 3e-3) << "order " << order;
  }
}

TEST(solid_punch, Indentation)
{
  for (int order : {1, 2}) {
    const double coarse = indentation_error(order, 0.2 * a), fine = indentation_error(order, 0.1 * a);
    EXPECT_LT(std::abs(fine), (order == 1 ? 0.8 : 0.6) * std::abs(coarse));
    EXPECT_LT(std::abs(fine), order == 1 ? 0.07 : 4e-3);
  }
}

} // namespace tribogel::test
