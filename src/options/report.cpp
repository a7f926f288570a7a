#include "options/report.hpp"

#include "tribogel/material/relaxation.hpp"

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
  return std::to_string(law.moduli.size()) + (law.moduli.size() == 1 ? " Ogden term" : " Ogden terms") +
         ", G " + number(law.shear_modulus()) + " MPa, K " + number(law.bulk_modulus) +
         (law.volumetric_law == VolumetricLaw::quadratic ? " MPa (quadratic)" : " MPa") +
         ", Poisson's ratio " + number(initial_poisson_ratio(law));
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
    std::snprintf(line, sizeof line, "  %5zu %12.6g %12.5g %12.5g %10.4g\n", k + 1, phase.end_time,
                  phase.end_approach, phase.rate, angle / (2 * std::numbers::pi));
    text += line;
  }
  return text + "  altogether " + number(turned / (2 * std::numbers::pi)) + " turns; fastest rim speed " +
         number(fastest * radius) + " mm/s\n";
}

/// How the top specimen stands to the bottom one.
std::string describe_placing(const Scene &scene)
{
  const Misalignment &m = scene.misalignment;
  std::string text = "; initial gap " + number(scene.initial_gap) + " mm\n";
  if (m.any())
    text += "  the top plate's axis stands at x = " + number(m.offset[0]) +
            " mm, y = " + number(m.offset[1]) + " mm from the bottom's; its face is inclined by " +
            number(m.tilt) + " rad\n";
  return text;
}

std::string describe_friction(const Scene &scene)
{
  std::string text = "  friction: " + (scene.friction.law() ? scene.friction.law()->in_numbers() : "none");
  if (const auto &speeds = scene.friction_speeds)
    text += ", found for " + number((*speeds)[0]) + " to " + number((*speeds)[1]) + " mm/s";
  return text + describe_placing(scene);
}

std::string describe_mesh(const Scene &scene, const std::string &mesh_file)
{
  std::string text = std::string(scene.model == Model::solid ? "  solid" : "  axisymmetric") +
                     " model, elements of order " + std::to_string(scene.mesh.element_order) + ", ";
  if (!mesh_file.empty()) {
    text += "mesh of " + mesh_file;
  } else {
    text += std::to_string(scene.mesh.elements_radial << scene.mesh.refinements) + " along the radius";
    if (scene.has_top() && scene.has_bottom() && scene.mesh.bottom_elements_radial > 0)
      text += " (bottom gel: " + std::to_string(scene.mesh.bottom_elements_radial << scene.mesh.refinements) +
              ")";
    text += ", grading " + number(scene.mesh.grading);
  }
  if (scene.has_contact() && scene.contact_integration == ContactIntegration::elements)
    text += ", contact at Gauss points of each slave facet";
  return text + "\n  side walls " +
         (scene.plate_contact ? "may touch the plates" : "do not feel the plates") + "\n";
}

std::string describe_time(const Scene &scene)
{
  if (scene.schedule_kind == ScheduleKind::steady)
    return "  steady states only: the way there is not computed\n";
  std::string text = std::string("  time rule ") +
                     (scene.time.rule == TimeRule::sdirk2 ? "sdirk2" : "exponential_euler") + ", steps to " +
                     number(scene.time.tolerance) + " % of the largest N and T";
  if (scene.phase_end_tolerance > 0)
    text += "; a phase ends in one step once they change by less than " + number(scene.phase_end_tolerance) +
            " %";
  return text + "\n";
}

std::string describe(const OutputSettings &output)
{
  std::string text =
      std::string(output.restart ? "  continues the run in " : "  output in ") + output.directory;
  if (std::isfinite(output.wall_time)) text += ", stops after " + number(output.wall_time) + " s";
  return text + "\n";
}

} // namespace

std::string scene_report(const SceneInput &input)
{
  const Scene &scene = input.scene;
  const bool from_file = !input.mesh_file.empty();
  const std::string shape = from_file ? "gel" : "gel cylinder";
  std::string text;
  switch (scene.arrangement) {
  case Arrangement::gel_on_gel:
    text = "Two " + shape + "s, bonded to the plates, pressed together and turned\n";
    break;
  case Arrangement::gel_on_rigid:
    text = "One " + shape + ", bonded to the top plate, pressed on a rigid plane and turned\n";
    break;
  case Arrangement::single_gel:
    text = "One " + shape + ", bonded to both plates\n";
    break;
  }
  if (scene.has_top()) text += describe(scene.top, "top   ", from_file);
  if (scene.has_bottom()) text += describe(scene.bottom, "bottom", from_file);
  if (scene.has_contact()) text += describe_friction(scene);
  text += describe(scene.schedule, scene.upper_gel().radius);
  text += describe_mesh(scene, input.mesh_file) + describe_time(scene) + describe(input.output);
  for (const std::string &warning : input.warnings) text += "warning: " + warning + "\n";
  for (const std::string &note : input.notes) text += "note: " + note + "\n";
  return text;
}

} // namespace tribogel
