/// Curved outlines: the nodes, midside ones too, lie on the sphere, and areas and volumes come out at the
/// order of the elements' geometry. A ring has no axis. Both on any number of ranks (parallel/test_ranks.cpp
/// runs a cap).
#include "outlines.hpp"
#include "tribogel/element/cell.hpp"
#include "tribogel/kinematics/axisymmetric.hpp"

#include <numbers>

namespace tribogel::test
{

namespace
{

constexpr double pi = std::numbers::pi, sphere = 3.7, width = 2.9, height = 1.9;

struct Body {
  double area, volume; ///< relative errors: of the face, of the body
};

Body errors_of_cap(int order, int elements)
{
  Scene scene = lubricated_discs(width, height, 1.1, order);
  scene.plate_contact = false;
  scene.mesh.elements_radial = elements;
  std::vector<MeridianBlock> blocks = meridian_blocks(scene);
  const auto points = [&](double end) { return equal_points(0, end, end / elements); };
  blocks[1] = spherical_cap(sphere, points(width), points(height));
  Problem problem;
  EXPECT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene, blocks), 0);
  for (const SurfaceNode &node : problem.system.mesh.slave.node)
    EXPECT_NEAR(std::hypot(node.X[0], node.X[1] - sphere), sphere, 1e-14 * sphere);

  double area = 0, volume = 0;
  for (const auto &node : problem.system.contact->lower_face().weights()) area += node.D;
  for (const MeshCell &cell : problem.system.mesh.cells) {
    const auto add = [&]<int k>() {
      Cell<AxisymmetricTorsion, k> geometry;
      std::array<std::array<double, 2>, (k + 1) * (k + 1)> X;
      for (std::size_t n = 0; n < X.size(); ++n)
        std::copy_n(problem.system.mesh.nodes[cell.node[n]].X.begin(), 2, X[n].begin());
      EXPECT_TRUE(geometry.set(X));
      for (const auto &point : geometry.point) volume += point.weight;
    };
    if (cell.body == bottom_body) continue;
    order == 1 ? add.template operator()<1>() : add.template operator()<2>();
  }
  const double rise = sphere - std::sqrt(sphere * sphere - width * width);
  const double segment = pi * rise * rise * (sphere - rise / 3); // of the ball below the cap's edge
  const double exact = pi * width * width * (height - rise) + segment;
  return {area / (2 * pi * sphere * rise) - 1, volume / exact - 1};
}

/// Of neighbouring edges.
double largest_ratio(const std::vector<double> &points)
{
  double largest = 1;
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    const double before = points[k] - points[k - 1], after = points[k + 1] - points[k];
    largest = std::max({largest, after / before, before / after});
  }
  return largest;
}

} // namespace

TEST(outline, AreaAndVolumeOfACap)
{
  for (int order : {1, 2}) {
    Body error[3];
    for (int level = 0; level < 3; ++level) {
      error[level] = errors_of_cap(order, 4 << level);
      std::printf("order %d elements %2d: errors of area %.3e, volume %.3e\n", order, 4 << level,
                  error[level].area, error[level].volume);
    }
    EXPECT_NEAR(std::log2(error[1].area / error[2].area), 2 * order, 0.2);
    EXPECT_NEAR(std::log2(error[1].volume / error[2].volume), 2 * order, 0.2);
    EXPECT_LT(std::abs(error[2].area), order == 1 ? 5e-3 : 1e-4);
    EXPECT_LT(std::abs(error[2].volume), order == 1 ? 5e-3 : 1e-5);
  }
}

/// A refined mesh has every node of the one before, twice as many edges, and the same growth of their
/// lengths.
TEST(outline, RefinedMeshesAreNested)
{
  Scene scene = paper_scene(9);
  scene.mesh.grading = 30;
  const std::vector<MeridianBlock> coarse = meridian_blocks(scene);
  scene.mesh.refinements = 2;
  const std::vector<MeridianBlock> fine = meridian_blocks(scene);
  ASSERT_EQ(fine.size(), coarse.size());
  for (std::size_t b = 0; b < fine.size(); ++b)
    for (const auto &[few, many] :
         {std::pair{&coarse[b].R, &fine[b].R}, std::pair{&coarse[b].Z, &fine[b].Z}}) {
      ASSERT_EQ(many->size() - 1, 4 * (few->size() - 1));
      for (std::size_t k = 0; k < few->size(); ++k)
        EXPECT_NEAR((*many)[4 * k], (*few)[k], 1e-13 * scene.bottom.radius);
      EXPECT_LT(largest_ratio(*many),
                std::sqrt(largest_ratio(*few))); // four edges for one: nearly the fourth root
    }
}

} // namespace tribogel::test
