/// What is told of the sizes and faces of specimens before a run; by hand.
#include "options/sizes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tribogel
{
namespace
{

/// Two gels of a file, pressed by 0.79 mm.
SpecimenSizes plain()
{
  SpecimenSizes sizes;
  sizes.radius = {12.5, 10};
  sizes.height = {4, 4.4};
  return sizes;
}

SceneInput taken(const SpecimenSizes &sizes)
{
  SceneInput input = scene_from_options({{"-model", "solid"}, {"-mesh_file", "gel.msh"}});
  input.warnings.clear();
  input.notes.clear();
  take_sizes(input, sizes);
  return input;
}

void expect_one(const std::vector<std::string> &texts, const std::string &part)
{
  ASSERT_EQ(texts.size(), 1);
  EXPECT_NE(texts[0].find(part), std::string::npos) << texts[0];
}

TEST(SizeDoubts, ThereAreNoneOfPlainGels)
{
  const SceneInput input = taken(plain());
  EXPECT_TRUE(input.warnings.empty());
  EXPECT_TRUE(input.notes.empty());
  EXPECT_TRUE(input.scene.even_faces);
  EXPECT_TRUE(scene_from_options({}).warnings.empty());
}

TEST(SizeDoubts, AnotherUnitIsSuspected)
{
  for (const double factor : {1000.0, 0.001}) {
    SpecimenSizes sizes = plain();
    for (double *size : {&sizes.radius[0], &sizes.radius[1], &sizes.height[0], &sizes.height[1]})
      *size *= factor;
    if (factor < 1) { // the plate's travel goes by it
      sizes.gap = 0;
      EXPECT_THROW(taken(sizes), UserError); // approach 0.79 mm through 0.0084 mm
      sizes.gap = 0.79;
    }
    expect_one(taken(sizes).warnings,
               factor > 1 ? "gel.msh stands for -top_radius = 1e+04 mm, -top_height = 4400 mm, "
                            "-bottom_radius = 1.25e+04 mm, -bottom_height = 4000 mm: lengths are in "
                            "mm, and a rheometer hardly takes a specimen so large; was it meant in "
                            "micrometres?"
                          : "so small; was it meant in metres?");
  }
  expect_one(scene_from_options({{"-bottom_radius", "2000"}}).warnings,
             "-bottom_radius = 2000 mm: lengths are in mm");
}

TEST(SizeDoubts, FacesBesideTheAxis)
{
  SpecimenSizes sizes = plain();
  sizes.centroid[1] = {0.06, 0.07}; // less than a hundredth of the radius: an unstructured mesh
  EXPECT_TRUE(taken(sizes).notes.empty());
  sizes.centroid[1] = {0.6, 0.8};
  expect_one(taken(sizes).notes, "top_contact has its centroid at (0.6, 0.8) mm, beside the plates' axis");
  EXPECT_TRUE(taken(sizes).warnings.empty());
  sizes.centroid[0] = {30, -1e-14};
  sizes.around_axis[0] = false;
  expect_one(taken(sizes).warnings,
             "axis x = y = 0 lies outside of bottom_contact, which has its centroid at (30, 0) mm");
}

TEST(SizeDoubts, FacesThatTouchInPart)
{
  SpecimenSizes sizes = plain();
  sizes.unevenness = 0.78;
  EXPECT_TRUE(taken(sizes).scene.even_faces);
  sizes.unevenness = 0.8;
  const SceneInput input = taken(sizes);
  EXPECT_FALSE(input.scene.even_faces);
  expect_one(input.notes, "uneven by 0.8 mm and pressed together by 0.79 mm");
}

} // namespace
} // namespace tribogel
