#include "options/sizes.hpp"

#include "options/option_reader.hpp"
#include "support/parse.hpp"

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

/// What is odd about the contact faces of a mesh file: warnings and notes. Faces that touch in part only are
/// marked in the scene.
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

void check_approach(SceneInput &input)
{
  const Scene &scene = input.scene;
  const auto resolved = std::find_if(input.options.begin(), input.options.end(),
                                     [](const auto &option) { return option.first == "schedule_approach"; });
  const std::string &text = resolved->second;
  const double height = scene.gel_height() + scene.gap();
  double largest = scene.schedule.front().end_approach;
  for (const Phase &phase : scene.schedule) largest = std::max(largest, phase.end_approach);
  if (!(largest < height))
    refuse("-schedule_approach", text,
           "allowed: each less than " + to_text(height) + " mm, " +
               (!scene.has_top()     ? "the height of the bottom specimen"
                : scene.has_bottom() ? "both heights and -initial_gap together"
                                     : "the height of the top specimen and -initial_gap together"));
  if (scene.has_contact() && largest <= scene.initial_gap)
    input.notes.push_back("-schedule_approach = " + text +
                          ": the specimens are never pressed together (-initial_gap " +
                          to_text(scene.initial_gap) + " mm)");
}

void take_sizes(SceneInput &input, const SpecimenSizes &sizes)
{
  Scene &scene = input.scene;
  const auto take = [&input](const std::string &name, double value, double &place) {
    place = value;
    for (auto &[option, text] : input.options)
      if (option == name) text = to_text(value);
  };
  if (scene.has_bottom()) {
    take("bottom_radius", sizes.radius[0], scene.bottom.radius);
    take("bottom_height", sizes.height[0], scene.bottom.height);
  }
  if (scene.has_top()) {
    take("top_radius", sizes.radius[1], scene.top.radius);
    take("top_height", sizes.height[1], scene.top.height);
    take("initial_gap", sizes.gap, scene.initial_gap);
  }
  check_approach(input);
  judge_sizes(input);
  judge_faces(input, sizes);
}

} // namespace tribogel
