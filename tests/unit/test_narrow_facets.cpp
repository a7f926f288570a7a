// Contact in space where facets are narrow beside their length: points many widths away are projected, and
// the surface's edge goes on beyond a narrow facet as far as beyond a wide one.
#include "solid_scene.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <gtest/gtest.h>

using namespace tribogel;

namespace
{

const PolynomialFriction<double> friction{{0.3, 0.2}, {0, 1}, 1};

/// A square of 3 x 3 facets on [-1.5, 1.5]^2; the column in the middle is `width` wide, and all are bent like
/// hoops.
QuadReference hoops(int order, double width, double bend)
{
  return quad_grid(3, 3, 3, 3, order, true, [=](double x, double y) {
    const double outside = std::copysign(std::max(0.0, std::abs(x) - 0.5) * (1.5 - width / 2), x);
    const double inside = std::clamp(x, -0.5, 0.5) * width;
    return Vector3<double>(0.1 + inside + outside - bend * y * y, y, 0);
  });
}

struct Pressed {
  MortarReport report;
  Vector3<double> force = Vector3<double>::Zero(), moment = Vector3<double>::Zero(); ///< on the master
};

/// The same flat, up to x = 0.7 only, and the last column `width` wide.
QuadReference narrow_edge(int order, double width)
{
  return quad_grid(3, 3, 3, 3, order, true, [=](double x, double y) {
    const double inner =
        0.7 - width + 0.5 * (2.2 - width) * (std::min(x, 0.5) - 0.5); // two columns from -1.5
    return Vector3<double>(inner + width * std::max(0.0, x - 0.5), y, 0);
  });
}

/// Under uniform pressure 1.
Pressed pressed(SolidScene scene)
{
  for (auto &lambda : scene.state.multiplier) lambda = {0, 0, 1};
  SurfaceContact contact(scene.geometry);
  Pressed sum{contact.update(scene.state, contact.candidate_pairs(scene.state, 0), false)};
  for (int a = 0; a < scene.slaves(); ++a) {
    NodeBlock block;
    contact.node(a, friction, block);
    for (std::size_t k = 0; k < block.master_nodes.size(); ++k) {
      const Vector3<double> f = block.residual.segment<3>(3 + 3 * static_cast<Eigen::Index>(k));
      sum.force += f;
      sum.moment += scene.geometry.master.X[block.master_nodes[k]].cross(f);
    }
  }
  return sum;
}

QuadReference flat_square(int order)
{
  return quad_grid(2, 2, 2, 2, order, false, [](double x, double y) { return Vector3<double>(x, y, 0); });
}

} // namespace

/// The pressure on a square of side 2 about the origin has no moment; what the chords of the hoops miss is as
/// small with a facet of the width of an atom as it is with a wide one.
TEST(NarrowFacets, AreProjectedHoweverNarrow)
{
  for (int order : {1, 2})
    for (const double width : {0.1, 1e-3, 1e-6}) {
      const Pressed sum = pressed(SolidScene(flat_square(order), hoops(order, width, 0.1), order));
      ASSERT_EQ(sum.report.status, MortarStatus::ok) << "order " << order << ", width " << width;
      EXPECT_EQ(sum.report.overhang, 0);
      EXPECT_NEAR(std::abs(sum.force[2]), 4, 1e-6);
      EXPECT_LT(sum.moment.norm(), order == 1 ? 1e-6 : 3e-3) << "order " << order << ", width " << width;
    }
}

/// The square hangs over by 0.3 on one side, where the edge's facets are 0.6 wide or a sixtieth or less of
/// that.
TEST(NarrowFacets, TheEdgeGoesOnBeyondThem)
{
  for (int order : {1, 2})
    for (const bool exact_cells : {true, false})
      for (const double width : {0.6, 1e-2, 1e-6}) {
        const Pressed sum =
            pressed(SolidScene(flat_square(order), narrow_edge(order, width), order, exact_cells));
        ASSERT_EQ(sum.report.status, MortarStatus::ok) << "order " << order << ", width " << width;
        if (exact_cells) {
          EXPECT_NEAR(sum.report.overhang, 0.3 * 2, 0.02); // counted at the points of a rule
          EXPECT_LT(sum.moment.norm(), 1e-8);
        }
        EXPECT_NEAR(std::abs(sum.force[2]), 4, 1e-9);
      }
}

/// Derivatives hold where a slave hangs over narrow facets, in a general state.
TEST(NarrowFacets, JacobianIsTheDerivative)
{
  for (int order : {1, 2}) {
    SolidScene scene(flat_square(order), narrow_edge(order, 0.2), order);
    make_general(scene, 1, 5);
    scene.state.slave.rotation = scene.state.master.rotation = 0;
    SurfaceContact contact(scene.geometry);
    EXPECT_GT(contact.update(scene.state, contact.candidate_pairs(scene.state, 0), false).overhang, 0.1);
    EXPECT_LT(jacobian_error(scene, friction, order == 1 ? 1 : 7), 1e-7) << order;
  }
}
