#include "options/size_doubts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tribogel
{

namespace
{

/// Specimens of rheometers are disks of 4 to 60 mm across and of a tenth of a millimetre to some centimetres
/// in height. A tenth of the smallest and ten times the largest are not doubted; a wrong unit is off by a
/// thousand.
constexpr double smallest_radius = 0.2, smallest_height = 0.01, largest = 300; // mm

/// Four digits.
std::string four_digits(double x)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

/// A place on a face of this radius; round-off is nothing.
std::string in_brackets(const std::array<double, 2> &x, double radius)
{
  const auto digits = [&](double value) {
    constexpr double round_off = 1e-9;
    return four_digits(std::abs(value) < round_off * radius ? 0 : value);
  };
  return "(" + digits(x[0]) + ", " + digits(x[1]) + ") mm";
}

} // namespace

void judge_sizes(SceneInput &input)
{
  const Scene &scene = input.scene;
  std::string odd;
  bool large = false;
  const auto judge = [&](const std::string &name, double size, double smallest) {
    if (smallest <= size && size <= largest) return;
    odd += (odd.empty() ? "" : ", ") + name + " = " + four_digits(size) + " mm";
    large = size > largest;
  };
  const auto judge_both = [&](const std::string &body, const Specimen &specimen) {
    judge("-" + body + "_radius", specimen.radius, smallest_radius);
    judge("-" + body + "_height", specimen.height, smallest_height);
  };
  if (scene.has_top()) judge_both("top", scene.top);
  if (scene.has_bottom()) judge_both("bottom", scene.bottom);
  if (odd.empty()) return;
  input.warnings.push_back(
      (input.mesh_file.empty() ? odd : "-mesh_file = " + input.mesh_file + " stands for " + odd) +
      ": lengths are in mm, and a rheometer hardly takes a specimen so " +
      (large ? "large; was it meant in micrometres?" : "small; was it meant in metres?"));
}

void judge_faces(SceneInput &input, const SpecimenSizes &sizes)
{
  Scene &scene = input.scene;
  const std::string file = "-mesh_file = " + input.mesh_file + ": ";
  constexpr double beside = 0.01; // of the radius
  for (int body = scene.has_bottom() ? 0 : 1; body < (scene.has_top() ? 2 : 1); ++body) {
    const std::string name = body == 1 ? "top_contact" : scene.has_top() ? "bottom_contact" : "top_plate";
    const auto &centroid = sizes.centroid[body];
    if (!sizes.around_axis[body])
      input.warnings.push_back(
          file + "the plates' axis x = y = 0 lies outside of " + name + ", which has its centroid at " +
          in_brackets(centroid, sizes.radius[body]) + " and the area of a circle with the radius " +
          four_digits(sizes.radius[body]) + " mm: turning carries the gel around the axis");
    else if (std::hypot(centroid[0], centroid[1]) > beside * sizes.radius[body])
      input.notes.push_back(file + name + " has its centroid at " +
                            in_brackets(centroid, sizes.radius[body]) +
                            ", beside the plates' axis x = y = 0");
  }
  double pressed = 0;
  for (const Phase &phase : scene.schedule) pressed = std::max(pressed, phase.end_approach - sizes.gap);
  if (!scene.has_contact() || pressed == 0 || sizes.unevenness <= pressed) return;
  scene.even_faces = false;
  input.notes.push_back(
      file + "the contact faces are uneven by " + four_digits(sizes.unevenness) +
      " mm and pressed together by " + four_digits(pressed) +
      " mm, so that they touch in part; mu_apparent and mu_gong, which take all of the face as evenly "
      "pressed, are nan");
}

} // namespace tribogel
