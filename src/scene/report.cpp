#include "scene/report.hpp"

#include "scene/material_input.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace tribogel
{

namespace
{

/// Four significant digits: for reading, not for computing on.
std::string number(double x)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

std::string describe(const Ogden<double> &law)
{
  return std::to_string(law.moduli.size()) + (law.moduli.size() == 1 ? " Ogden term" : " Ogden terms") + ", G " +
         number(law.shear_modulus()) + " MPa, K " + number(law.bulk_modulus) +
         (law.volumetric_law == VolumetricLaw::quadratic ? " MPa (quadratic)" : " MPa") + ", Poisson's ratio " +
         number(initial_poisson_ratio(law));
}

std::string describe(const Specimen &specimen, const std::string &name, bool from_file)
{
  std::string text = "  " + name + (from_file ? "  area of a circle with the radius " : "  radius ") +
                     number(specimen.radius) + " mm, height " + number(specimen.height) + " mm, " +
                     (specimen.material.branches.empty() ? "hyperelastic" : "viscoelastic") +
                     "\n          equilibrium: " + describe(specimen.material.equilibrium) + "\n";
  for (const MaxwellBranch<double> &branch : specimen.material.branches)
    text += "          Maxwell branch: " + describe(branch.spring) + ", relaxation times " +
            number(shape_relaxation_time(branch)) + " s (shape), " + number(volume_relaxation_time(branch)) +
            " s (volume)\n";
  return text;
}

std::string describe(const PolynomialFriction<double> &friction)
{
  if (friction.coefficients.empty()) return "none";
  std::string text = "mu =";
  for (std::size_t i = 0; i < friction.coefficients.size(); ++i) {
    const double b = friction.coefficients[i], m = friction.exponents[i];
    text += (i ? (b < 0 ? " - " : " + ") : (b < 0 ? " -" : " ")) + number(std::abs(b));
    if (m != 0) text += " v" + (m == 1 ? std::string() : "^" + number(m));
  }
  text += " (v in mm/s)";
  if (friction.linear_in_pressure()) return text;
  return text + ", |traction| = mu p^" + number(friction.pressure_exponent) + " (p in MPa, above " +
         number(friction.pressure_floor) + ")";
}

std::string describe(const Schedule &schedule, double radius)
{
  double turned = 0, fastest = 0;
  std::string text = "  phase      until s  approach mm   rate rad/s      turns\n";
  for (std::size_t k = 0; k < schedule.size(); ++k) {
    const Phase &phase = schedule[k];
    const double angle = phase.end_rotation() - phase.start_rotation;
    turned += std::abs(angle);
    fastest = std::max(fastest, std::abs(phase.rate));
    char line[128];
    std::snprintf(line, sizeof line, "  %5zu %12.6g %12.5g %12.5g %10.4g\n", k + 1, phase.end_time, phase.end_approach,
                  phase.rate, angle / (2 * std::numbers::pi));
    text += line;
  }
  return text + "  altogether " + number(turned / (2 * std::numbers::pi)) + " turns; fastest rim speed " +
         number(fastest * radius) + " mm/s\n";
}

} // namespace

std::string scene_report(const SceneInput &input)
{
  const Scene &scene = input.scene;
  const bool from_file = !input.mesh_file.empty();
  const std::string shape = from_file ? "gel" : "gel cylinder";
  std::string text = scene.has_top ? "Two " + shape + "s, bonded to the plates, pressed together and turned\n"
                                   : "One " + shape + ", bonded to both plates\n";
  if (scene.has_top) text += describe(scene.top, "top   ", from_file);
  text += describe(scene.bottom, "bottom", from_file);
  if (scene.has_top)
    text += "  friction: " + describe(scene.friction) + "; initial gap " + number(scene.initial_gap) + " mm\n";
  text += describe(scene.schedule, scene.has_top ? scene.top.radius : scene.bottom.radius);
  text += std::string(scene.model == Model::solid ? "  solid" : "  axisymmetric") + " model, elements of order " +
          std::to_string(scene.mesh.element_order) + ", ";
  if (from_file)
    text += "mesh of " + input.mesh_file + "\n";
  else
    text += std::to_string(scene.mesh.elements_radial << scene.mesh.refinements) + " along the radius, grading " +
            number(scene.mesh.grading) + "\n";
  text += "  output in " + scene.output.directory + "\n";
  for (const std::string &warning : input.warnings) text += "warning: " + warning + "\n";
  for (const std::string &note : input.notes) text += "note: " + note + "\n";
  return text;
}

} // namespace tribogel
