/// The undeformed specimens and how they stand between the plates.
#include "options/option_groups.hpp"
#include "options/option_reader.hpp"
#include "support/parse.hpp"
#include "tribogel/scene/overhang.hpp"

#include <cmath>
#include <cstdio>

namespace tribogel
{

namespace
{

Option length(const char *name, const char *value, const char *meaning, const char *source)
{
  return {.name = name,
          .kind = OptionKind::real,
          .fallback = value,
          .unit = "mm",
          .meaning = meaning,
          .source = source,
          .range = positive};
}

std::vector<Option> cylinders()
{
  Option top_radius = length("-top_radius", "10", "radius of the top specimen", "paper");
  top_radius.rule = "not larger than -bottom_radius: the face of the top gel lies on that of the bottom gel";
  Option gap = length("-initial_gap", "0", "distance of the two gels at t = 0", "own");
  gap.range = non_negative;
  return {top_radius, length("-top_height", "4.4", "height of the top specimen", "assumed"),
          length("-bottom_radius", "12.5", "radius of the bottom specimen", "paper"),
          length("-bottom_height", "4", "height of the bottom specimen", "assumed"), gap};
}

/// How the top plate stands, in space.
std::vector<Option> misalignment()
{
  return {{.name = "-top_offset",
           .kind = OptionKind::reals,
           .fallback = "0,0",
           .unit = "mm",
           .meaning = "where the top plate's axis stands, x,y from the bottom's (-model solid)",
           .source = "own",
           .range = any_real,
           .count = 2},
          {.name = "-top_tilt",
           .kind = OptionKind::real,
           .fallback = "0",
           .unit = "rad",
           .meaning = "inclination of the top plate's face, and with it of its gel, against the axis about "
                      "which it turns;"
                      " at t = 0 the gel is lowest at +x, and -initial_gap is measured there (-model solid)",
           .source = "own",
           .range = {-0.5, 0.5}}};
}

std::vector<OptionGroup> declare_geometry()
{
  OptionGroup group{"Geometry (undeformed)", cylinders()};
  for (const Option &option : misalignment()) group.options.push_back(option);
  const std::vector<Option> others{
      {.name = "-mesh_file",
       .kind = OptionKind::path,
       .fallback = "",
       .meaning =
           "Gmsh file of specimens of any shape, instead of the sizes above: hexahedra in the physical "
           "volumes"
           " top and bottom, their faces in the physical surfaces top_plate, bottom_plate, top_contact and"
           " bottom_contact (with -specimens bottom: bottom, top_plate and bottom_plate; with -counterface"
           " rigid: top, top_plate and top_contact); mm, z = 0 is the"
           " bottom specimen's contact face, x = y = 0 the axis",
       .source = "own",
       .rule = "ASCII, format 2.2 or 4.1, from the working directory; -model solid, -schedule_kind transient",
       .may_change = true}, // to another path of the same mesh
      {.name = "-plate_contact",
       .kind = OptionKind::flag,
       .fallback = "true",
       .meaning = "side walls may touch, not penetrate, the plates; the top gel's may roll onto the bottom "
                  "gel",
       .source = "own"}};
  group.options.insert(group.options.end(), others.begin(), others.end());
  return {group};
}

void read_sizes(const OptionReader &reader, Scene &scene)
{
  scene.top.radius = reader.real("-top_radius");
  scene.top.height = reader.real("-top_height");
  scene.bottom.radius = reader.real("-bottom_radius");
  scene.bottom.height = reader.real("-bottom_height");
  scene.initial_gap = reader.real("-initial_gap");
  scene.plate_contact = reader.flag("-plate_contact");
  if (!reader.is_given("-mesh_file") && scene.has_top() && scene.has_bottom() &&
      scene.top.radius > scene.bottom.radius) {
    const Option &option = OptionReader::declared("-top_radius");
    refuse("-top_radius", reader.text(option),
           "allowed: " + option.allowed() + ", here -bottom_radius = " + to_text(scene.bottom.radius) +
               ". If the wider gel is the upper one, exchange the two, -top_ for -bottom_ in all options: N "
               "and T are the "
               "same");
  }
}

/// Three digits.
std::string percent(double share)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100 * share);
  return text;
}

void read_misalignment(const OptionReader &reader, Scene &scene)
{
  const Option &offset = OptionReader::declared("-top_offset"), &tilt = OptionReader::declared("-top_tilt");
  const std::vector<double> c = reader.reals(offset);
  const double angle = reader.real("-top_tilt");
  if (!scene.has_top()) return;
  scene.misalignment = {{c[0], c[1]}, angle};
  if (reader.is_given("-mesh_file")) {
    if (angle != 0)
      refuse(tilt.name, reader.text(tilt), "allowed: 0 with -mesh_file, whose plates are level");
    return; // how far the bottom specimen reaches is not known yet
  }
  for (const Option *option : {&offset, &tilt})
    if (scene.model == Model::axisymmetric && scene.misalignment.any() && reader.is_given(option->name))
      refuse(option->name, reader.text(*option),
             "allowed: " + option->fallback + " with -model axisymmetric");
  if (!scene.has_bottom()) {
    if (std::hypot(c[0], c[1]) > 0)
      refuse(offset.name, reader.text(offset),
             "allowed: 0,0 with -counterface rigid, a plane that is the same everywhere");
    return;
  }
  const double beyond = disc_overhang(scene.top.radius, scene.bottom.radius, std::hypot(c[0], c[1]));
  if (beyond > largest_overhang)
    refuse(offset.name, reader.text(offset),
           percent(beyond) + " of the top gel's face lies beyond the bottom gel; allowed: at most " +
               percent(largest_overhang) + ", here with -top_radius = " + to_text(scene.top.radius) +
               " and -bottom_radius = " + to_text(scene.bottom.radius) + " (none up to an offset of " +
               to_text(scene.bottom.radius - scene.top.radius) + " mm)");
}

/// -mesh_file, if it is given, in place of all that describes cylinders and their meshes.
void read_mesh_file(const OptionReader &reader, SceneInput &input)
{
  const Option &option = OptionReader::declared("-mesh_file");
  if (!reader.is_given(option.name)) return;
  input.mesh_file = reader.path(option);
  input.scene.round = false;
  if (input.scene.model != Model::solid) refuse(option.name, input.mesh_file, "allowed: with -model solid");
  std::string idle;
  for (const char *name :
       {"-top_radius", "-top_height", "-bottom_radius", "-bottom_height", "-initial_gap", "-elements_radial",
        "-bottom_elements_radial", "-mesh_grading", "-mesh_refinements"})
    if (reader.is_given(name)) idle += (idle.empty() ? "" : ", ") + std::string(name);
  if (!idle.empty()) input.notes.push_back("without effect with -mesh_file: " + idle);
}

void read_geometry(const OptionReader &reader, SceneInput &input)
{
  read_mesh_file(reader, input);
  read_sizes(reader, input.scene);
  read_misalignment(reader, input.scene);
}

} // namespace

OptionSubject geometry_options()
{
  return {declare_geometry, read_geometry};
}

} // namespace tribogel
