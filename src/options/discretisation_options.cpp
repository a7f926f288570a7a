/// Elements, contact integrals and steps of time.
#include "options/discretisation_options.hpp"

#include "options/option_groups.hpp"
#include "options/option_reader.hpp"
#include "support/parse.hpp"

#include <cmath>
#include <cstdio>

namespace tribogel
{

namespace
{

std::vector<Option> time_options()
{
  return {{.name = "-maxwell_integrator",
           .kind = OptionKind::choice,
           .fallback = "sdirk2",
           .meaning = "time rule of the Maxwell branches and of the sliding velocity, unconditionally stable:"
                      " exponential_euler: first order; sdirk2: second order, two solves a step",
           .source = "own",
           .choices = {"exponential_euler", "sdirk2"}},
          {.name = "-time_tolerance",
           .kind = OptionKind::real,
           .fallback = "0.1",
           .unit = "%",
           .meaning =
               "error in time that the steps follow, per cent of the largest N and T so far:"
               " exponential_euler: of a step; sdirk2: of N(t) and T(t), and of the internal variables",
           .source = "own",
           .range = positive,
           .may_change = true}};
}

std::vector<Option> mesh_options()
{
  return {
      {.name = "-element_order",
       .kind = OptionKind::integer,
       .fallback = "2",
       .unit = "-",
       .meaning = "order of the elements",
       .source = "own",
       .range = {1, 2}},
      {.name = "-elements_radial",
       .kind = OptionKind::integer,
       .fallback = "12",
       .unit = "-",
       .meaning =
           "elements along the top radius (the bottom one if it is alone); the rest of the mesh follows"
           " (with -model solid the default is 3)",
       .source = "own",
       .range = {1, 1e6}},
      {.name = "-bottom_elements_radial",
       .kind = OptionKind::integer,
       .fallback = "0",
       .unit = "-",
       .meaning = "as -elements_radial, over the same length, for the bottom gel's mesh; 0: the same number",
       .source = "own",
       .range = {0, 1e6}},
      {.name = "-mesh_grading",
       .kind = OptionKind::real,
       .fallback = "30",
       .unit = "-",
       .meaning = "largest over smallest element edge; small ones go to the plates' and the contact's rims"
                  " (with -model solid the default is 1)",
       .source = "own",
       .range = {1, 1e6}},
      {.name = "-mesh_refinements",
       .kind = OptionKind::integer,
       .fallback = "0",
       .unit = "-",
       .meaning =
           "how often every edge of that mesh is halved; the nodes it had stay, for studies of convergence",
       .source = "own",
       .range = {0, 10}}};
}

std::vector<OptionGroup> declare_discretisation()
{
  OptionGroup group{"Discretisation", mesh_options()};
  group.options.push_back(
      {.name = "-contact_integration",
       .kind = OptionKind::choice,
       .fallback = "segments",
       .meaning = "segments: over the exact intervals or polygons where a slave and a master facet overlap; "
                  "elements:"
                  " at Gauss points of each slave facet, cheaper and less exact (-model solid)",
       .source = "own",
       .choices = {"segments", "elements"}});
  for (const Option &option : time_options()) group.options.push_back(option);
  return {group};
}

/// The default mesh in space. Elements of order 2, the paper scene's steady states at 1 rad/s with walls at
/// the plates (the axisymmetric model's limit is 290.4 N, 11.44 N mm; one core, all five phases):
///
///     elements  grading  unknowns  N [N]    T [N mm]  CPU [s]
///     3         1        6795      291.92   11.517    7
///     3         6        6795      291.95   11.529    8
///     4         3        10491     292.07   11.538    14
///     4         8        11643     292.56   11.566    21
///
/// With so few elements a grading takes more from the middle than it gives to the rims.
struct SolidMesh {
  static constexpr const char *elements_radial = "3", *grading = "1";
};

void read_mesh(const OptionReader &reader, SceneInput &input)
{
  Scene &scene = input.scene;
  const auto in_space = [&](const char *name, const char *fallback) {
    if (scene.model != Model::solid || reader.is_given(name)) return false;
    input.options.emplace_back(name + 1, fallback);
    return true;
  };
  scene.mesh.element_order = reader.integer("-element_order");
  scene.mesh.elements_radial = in_space("-elements_radial", SolidMesh::elements_radial)
                                   ? std::stoi(SolidMesh::elements_radial)
                                   : reader.integer("-elements_radial");
  scene.mesh.bottom_elements_radial = reader.integer("-bottom_elements_radial");
  scene.mesh.grading = in_space("-mesh_grading", SolidMesh::grading) ? std::stod(SolidMesh::grading)
                                                                     : reader.real("-mesh_grading");
  scene.mesh.refinements = reader.integer("-mesh_refinements");
  for (const char *name :
       {"-elements_radial", "-bottom_elements_radial"}) // one cell would fill the whole circle
    if (scene.model == Model::solid && scene.has_top() && reader.integer(name) == 1 &&
        scene.mesh.refinements == 0)
      refuse(name, "1", "allowed: at least 2 with -model solid, whose circles need a ring of cells");
}

void read_contact_integration(const OptionReader &reader, Scene &scene)
{
  const bool at_elements = reader.choice("-contact_integration") == "elements";
  if (at_elements && scene.model == Model::axisymmetric && scene.has_contact())
    refuse("-contact_integration", "elements", "allowed: segments with -model axisymmetric");
  scene.contact_integration = at_elements ? ContactIntegration::elements : ContactIntegration::segments;
}

void read_time(const OptionReader &reader, Scene &scene)
{
  const bool second_order = reader.choice("-maxwell_integrator") == "sdirk2";
  const bool steady = scene.schedule_kind == ScheduleKind::steady; // nothing to integrate: one solve a step
  scene.time.rule = second_order && !steady ? TimeRule::sdirk2 : TimeRule::exponential_euler;
  scene.time.tolerance = reader.real("-time_tolerance");
}

void expect_possible_number(const SceneInput &input)
{
  const Scene &scene = input.scene;
  const double elements = estimated_elements(scene);
  if (input.mesh_file.empty() && elements > most_elements(scene)) {
    char rounded[32];
    std::snprintf(rounded, sizeof rounded, "%.3g", elements);
    refuse("-elements_radial", std::to_string(scene.mesh.elements_radial),
           std::string("with these radii and heights a mesh of ") + rounded + " elements; allowed: at most " +
               to_text(most_elements(scene)) + " elements (matrix positions are 32-bit numbers)");
  }
}

void read_discretisation(const OptionReader &reader, SceneInput &input)
{
  read_mesh(reader, input);
  read_contact_integration(reader, input.scene);
  read_time(reader, input.scene);
  expect_possible_number(input);
}

} // namespace

double estimated_elements(const Scene &scene)
{
  const double radius = scene.upper_gel().radius;
  const auto count = [&](const Specimen &s, int elements) {
    const double edge = radius / (elements << scene.mesh.refinements);
    const double along = std::ceil(s.radius / edge), layers = std::ceil(s.height / edge);
    return scene.model == Model::solid ? 3 * along * along * layers : along * layers; // 3: revolved_mesh
  };
  const int top = scene.mesh.elements_radial, bottom = scene.mesh.bottom_elements_radial;
  return (scene.has_bottom() ? count(scene.bottom, bottom > 0 ? bottom : top) : 0) +
         (scene.has_top() ? count(scene.top, top) : 0);
}

OptionSubject discretisation_options()
{
  return {declare_discretisation, read_discretisation};
}

} // namespace tribogel
