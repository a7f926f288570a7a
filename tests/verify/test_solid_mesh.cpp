/// The O-grid cylinders and their surfaces, by exact geometry: every midside node of the outline lies on its
/// circle, cells are not inside out, volumes converge at the order of the sides' interpolation, and the
/// facets of the surfaces point out of the bodies: their vector areas add up to those of the plane faces, and
/// to nothing round the wall.
#include "solids.hpp"

#include "tribogel/contact/surface/facet.hpp"

#include <limits>
#include <numbers>

namespace tribogel::test
{

namespace
{

constexpr double pi = std::numbers::pi;

Scene two_gels(int order, int elements, double grading)
{
  Scene scene = paper_scene(elements, order);
  scene.model = Model::solid;
  scene.mesh.grading = grading;
  return scene;
}

void build(const Scene &scene, Mesh &mesh)
{
  ASSERT_EQ(mesh.Build(PETSC_COMM_WORLD, scene, revolved_mesh(meridian_blocks(scene))), 0);
}

struct Size {
  double volume[2] = {}, smallest = 1; ///< of the Jacobians, over the largest of the cell
};

template <int order> Size size_of(const Mesh &mesh)
{
  Size size;
  for (const MeshCell &cell : mesh.cells) {
    Cell<Solid, order> geometry;
    std::array<std::array<double, 3>, Cell<Solid, order>::nodes> X;
    for (std::size_t n = 0; n < X.size(); ++n) X[n] = mesh.nodes[cell.node[n]].X;
    EXPECT_TRUE(geometry.set(X));
    double low = std::numeric_limits<double>::infinity(), high = 0;
    static const auto gauss = gauss_rule<order + 1>();
    for (std::size_t q = 0; q < geometry.point.size(); ++q) {
      double weight = 1;
      for (int j = 0, rest = static_cast<int>(q); j < 3; ++j, rest /= order + 1)
        weight *= gauss.weight[rest % (order + 1)];
      size.volume[cell.body] += geometry.point[q].weight;
      low = std::min(low, geometry.point[q].weight / weight);
      high = std::max(high, geometry.point[q].weight / weight);
    }
    size.smallest = std::min(size.smallest, low / high);
  }
  return size;
}

/// int n dS and int x . n dS.
struct Area {
  Vector3<double> vector = Vector3<double>::Zero();
  double flux = 0;
};

template <int order> Area area_of(const Surface &surface)
{
  constexpr int n = order + 2;
  static const auto gauss = gauss_rule<n>();
  Area sum;
  for (const auto &facet : surface.facet)
    for (int q = 0; q < n * n; ++q) {
      const auto shape = tensor_shape<2, order>({gauss.point[q % n], gauss.point[q / n]});
      Vector3<double> x = Vector3<double>::Zero(), slope[2] = {x, x};
      for (std::size_t a = 0; a < shape.N.size(); ++a) {
        const Vector3<double> X(surface.node[facet[a]].X.data());
        x += shape.N[a] * X;
        for (int j = 0; j < 2; ++j) slope[j] += shape.dN[a][j] * X;
      }
      const Vector3<double> dS = gauss.weight[q % n] * gauss.weight[q / n] * slope[0].cross(slope[1]);
      sum.vector += dS;
      sum.flux += x.dot(dS);
    }
  return sum;
}

template <int order> std::vector<double> weights_of(const Surface &surface, const std::array<int, 9> &facet)
{
  QuadPoints<order> X;
  for (std::size_t b = 0; b < X.size(); ++b) X[b] = Vector3<double>(surface.node[facet[b]].X.data());
  const auto weights = quad_measure<order>(X).basis.D;
  return {weights.begin(), weights.end()};
}

} // namespace

TEST(solid_mesh, NodesOfTheOutlineLieOnTheCircle)
{
  for (int order : {1, 2})
    for (double grading : {1.0, 30.0}) {
      const Scene scene = two_gels(order, 7, grading);
      Mesh mesh;
      ASSERT_NO_FATAL_FAILURE(build(scene, mesh));
      int on_wall = 0;
      for (const Node &node : mesh.nodes) {
        const double r = std::hypot(node.X[0], node.X[1]),
                     R = node.body ? scene.top.radius : scene.bottom.radius;
        EXPECT_LE(r, R * (1 + 1e-15));
        if (!node.on(Side::wall)) continue;
        EXPECT_NEAR(r, R, 1e-14 * R);
        ++on_wall;
      }
      EXPECT_GT(on_wall, 100);
    }
}

TEST(solid_mesh, CellsAreSoundAndVolumesConverge)
{
  for (double grading : {1.0, 30.0})
    for (int order : {1, 2}) {
      double before = 0;
      for (int elements : {4, 8}) {
        Mesh mesh;
        const Scene scene = two_gels(order, elements, grading);
        ASSERT_NO_FATAL_FAILURE(build(scene, mesh));
        const Size size = order == 1 ? size_of<1>(mesh) : size_of<2>(mesh);
        const double error = 1 - size.volume[top_body] / (pi * 100 * 4.4);
        std::printf(
            "order %d grading %g elements %2d: %zu cells, %d unknowns, smallest Jacobian %.3f, volume %.2e\n",
            order, grading, elements, mesh.cells.size(), static_cast<int>(mesh.unknowns), size.smallest,
            error);
        EXPECT_GT(size.smallest, 0.5);
        if (before > 0 && grading == 1) {
          EXPECT_GT(before / std::abs(error), order == 1 ? 3.9 : 14);
        }
        before = std::abs(error);
      }
    }
}

/// Half of a radius' edges lie in the square; the rest in rings, as many as -elements_radial says.
TEST(solid_mesh, CountsElementsAlongTheRadius)
{
  for (int elements : {1, 2, 3, 4, 6, 9}) {
    Scene scene = two_gels(1, elements, 1);
    Mesh mesh;
    ASSERT_NO_FATAL_FAILURE(build(scene, mesh));
    int along = -1;
    for (const Node &node : mesh.nodes)
      along +=
          node.body == top_body && node.on(Side::slave) && std::abs(node.X[1]) < 1e-12 && node.X[0] > -1e-12;
    EXPECT_EQ(along, elements);
  }
}

TEST(solid_mesh, SurfacesPointOutwards)
{
  for (int order : {1, 2}) {
    const Scene scene = two_gels(order, 6, 4);
    Mesh mesh;
    ASSERT_NO_FATAL_FAILURE(build(scene, mesh));
    const Size size = order == 1 ? size_of<1>(mesh) : size_of<2>(mesh);
    const auto area = [order](const Surface &surface) {
      return order == 1 ? area_of<1>(surface) : area_of<2>(surface);
    };
    const Area slave = area(mesh.slave), master = area(mesh.master),
               wall[2] = {area(mesh.wall[0]), area(mesh.wall[1])};
    const double A[2] = {size.volume[0] / scene.bottom.height, size.volume[1] / scene.top.height};
    EXPECT_LT((slave.vector - Vector3<double>(0, 0, -A[1])).norm(), 1e-12 * A[1]);
    EXPECT_LT((master.vector - Vector3<double>(0, 0, A[0])).norm(), 1e-12 * A[0]);
    for (int body : {bottom_body, top_body}) {
      EXPECT_LT(wall[body].vector.norm(), 1e-12 * A[body]);
      EXPECT_NEAR(wall[body].flux / (2 * size.volume[body]), 1, 1e-12); // div (x, y, 0)
    }
    double sum = 0, smallest = A[0];
    for (const auto &facet : mesh.slave.facet)
      for (const double weight :
           order == 1 ? weights_of<1>(mesh.slave, facet) : weights_of<2>(mesh.slave, facet)) {
        sum += weight;
        smallest = std::min(smallest, weight);
      }
    EXPECT_NEAR(sum / A[1], 1, 1e-12);
    EXPECT_GT(smallest, 0); // the corners of 9-node facets too
    for (const auto &node : mesh.slave.node) EXPECT_EQ(node.multiplier, true);
    const auto rim =
        static_cast<std::size_t>(std::count_if(mesh.slave.node.begin(), mesh.slave.node.end(), [&](auto &n) {
          return std::hypot(n.X[0], n.X[1]) > (1 - 1e-12) * scene.top.radius;
        }));
    EXPECT_EQ(mesh.slave.node.size(),
              1 + mesh.slave.facet.size() * (order == 1 ? 1 : 4) + rim / 2); // Euler: a disc
  }
}

} // namespace tribogel::test
