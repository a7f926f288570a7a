/// A flat punch of radius a on a half-space of hexahedra, without contact: displacements are prescribed below it.
///
/// C8, bonded and turned: T = 16/3 G a^3 theta; a finite block errs (a/L)^3 only. C9, pressed without friction: F = 2
/// E* a delta; a finite block of width and height L errs c a/L, so that two of them give the half-space: delta/F = 2
/// (delta/F)_2L - (delta/F)_L.
///
/// The tractions are infinite at the edge. Towards it edges halve one by one, down to `finest`; what is left of T is
/// proportional to that, so its limit is 2 T_fine - T_coarse. In indentation the ratio of the edges, which stays 2,
/// shows at order 1.
#include "outlines.hpp"
#include "solids.hpp"

#include "mesh/gmsh_bodies.hpp"

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

/// A disc as O-grid in a cylinder: `around` cells about the axis (a multiple of 8). Cells are of equal size along the
/// angle, so everything but the inner square is polar. The upper face within a is the upper plate's; planes of symmetry
/// are held if `symmetric`.
SerialMesh punched(double L, double finest, int around, bool symmetric)
{
  const int k = around / 8, n = 2 * k;
  constexpr double square = 0.45;
  std::vector<double> r; // of the rings, from the square on
  const std::vector<double> inside = doubling(a * (1 - square), finest), outside = doubling(L - a, finest);
  for (auto d = inside.rbegin(); d != inside.rend(); ++d) r.push_back(a - *d);
  for (std::size_t i = 1; i < outside.size(); ++i) r.push_back(a + outside[i]);
  std::vector<double> z = doubling(L, finest);

  SerialMesh mesh;
  mesh.dim = 3;
  std::vector<std::array<double, 2>> plane;
  std::vector<std::array<int, 4>> cells;
  const auto centre = [n](int i, int j) { return i + j * (n + 1); };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = static_cast<double>(i) / k - 1, y = static_cast<double>(j) / k - 1;
      const double s = std::max(std::abs(x), std::abs(y)), R = std::hypot(x, y); // squares to circles
      plane.push_back({s > 0 ? square * a * s * x / R : 0, s > 0 ? square * a * s * y / R : 0});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      cells.push_back({centre(i, j), centre(i + 1, j), centre(i, j + 1), centre(i + 1, j + 1)});
  std::vector<int> ring;
  for (int i = 0; i < n; ++i) ring.push_back(centre(n, i));
  for (int i = 0; i < n; ++i) ring.push_back(centre(n - i, n));
  for (int i = 0; i < n; ++i) ring.push_back(centre(0, n - i));
  for (int i = 0; i < n; ++i) ring.push_back(centre(i, 0));
  for (std::size_t level = 1; level < r.size(); ++level) {
    std::vector<int> next;
    for (const int from : ring) {
      const double angle = std::atan2(plane[from][1], plane[from][0]);
      next.push_back(static_cast<int>(plane.size()));
      plane.push_back({r[level] * std::cos(angle), r[level] * std::sin(angle)});
    }
    for (int p = 0; p < around; ++p) {
      const int q = (p + 1) % around;
      cells.push_back({ring[p], next[p], ring[q], next[q]});
    }
    ring = next;
  }

  const int stride = static_cast<int>(plane.size()), layers = static_cast<int>(z.size()) - 1;
  for (int l = 0; l <= layers; ++l)
    for (const auto &x : plane) mesh.vertex.push_back({x[0], x[1], -z[layers - l]});
  const auto radius = [](const std::array<double, 3> &X) { return std::hypot(X[0], X[1]); };
  const auto polar_middle = [&](const std::vector<int> &vertices) { // of vertices beyond the square
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
  };
  for (int l = 0; l < layers; ++l)
    for (const auto &quadrilateral : cells) {
      SerialMesh::Cell cell{{}, bottom_body, 0};
      for (int v = 0; v < 4; ++v) {
        cell.vertex[v] = l * stride + quadrilateral[v];
        cell.vertex[v + 4] = cell.vertex[v] + stride;
      }
      mesh.cell.push_back(cell);
      const auto &c = cell.vertex;
      double outermost = 0;
      for (const int v : c) outermost = std::max(outermost, radius(mesh.vertex[v]));
      if (l == 0) mesh.boundary.push_back({{c[0], c[1], c[2], c[3]}, Side::bottom_plate});
      if (l == layers - 1 && outermost < a * (1 + 1e-9))
        mesh.boundary.push_back({{c[4], c[5], c[6], c[7]}, Side::top_plate});
      constexpr int face[6][4] = {{0, 2, 4, 6}, {1, 3, 5, 7}, {0, 1, 4, 5}, {2, 3, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}};
      constexpr int edge[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                                   {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
      for (const auto &f : face) {
        const std::array<int, 4> at{c[f[0]], c[f[1]], c[f[2]], c[f[3]]};
        for (int j = 0; j < 2; ++j)
          if (symmetric && std::all_of(at.begin(), at.end(), [&](int v) { return std::abs(mesh.vertex[v][j]) < 1e-9; }))
            mesh.boundary.push_back({at, j == 0 ? Side::fixed_x : Side::fixed_y});
        polar_middle({at.begin(), at.end()});
      }
      for (const auto &e : edge) polar_middle({c[e[0]], c[e[1]]});
      polar_middle({c.begin(), c.end()});
    }
  return mesh;
}

Measurement pressed_or_turned(int order, double L, double finest, double depth, double angle, double bulk_over_shear)
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
              problem.mesh.cells.size(), static_cast<int>(problem.mesh.unknowns));
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
