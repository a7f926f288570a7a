#include "options/scene_input.hpp"

#include "options/friction_options.hpp"
#include "options/material_input.hpp"
#include "options/option_reader.hpp"
#include "options/size_doubts.hpp"
#include "support/parse.hpp"
#include "tribogel/material/relaxation.hpp"
#include "tribogel/scene/overhang.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace tribogel
{

namespace
{

void read_geometry(const OptionReader &reader, Scene &scene)
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

/// A list with one number for each phase; a single one holds for all. `text` is the whole list.
std::vector<double> read_per_phase(const OptionReader &reader, const Option &option, std::size_t phases,
                                   std::string &text)
{
  std::vector<double> values = reader.reals(option);
  text = reader.text(option);
  if (values.size() != 1) {
    reader.expect_equal_lengths(option, OptionReader::declared("-schedule_end_times"),
                                ", or one number for all phases");
    return values;
  }
  const std::string one = text;
  for (std::size_t k = 1; k < phases; ++k) text += "," + one;
  return std::vector<double>(phases, values[0]);
}

/// What stands between the plates must keep a height > 0.
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

void read_schedule(const OptionReader &reader, SceneInput &input)
{
  const Option &end_times = OptionReader::declared("-schedule_end_times");
  const std::vector<double> ends = reader.reals(end_times);
  for (std::size_t k = 1; k < ends.size(); ++k)
    if (!(ends[k] > ends[k - 1]))
      refuse(end_times.name, reader.text(end_times),
             to_text(ends[k]) + " after " + to_text(ends[k - 1]) + "; allowed: " + end_times.allowed());
  std::string approach_text, turning_text;
  const std::vector<double> approach =
      read_per_phase(reader, OptionReader::declared("-schedule_approach"), ends.size(), approach_text);
  input.options.emplace_back("schedule_approach", approach_text);

  const Option &rates = OptionReader::declared("-schedule_rates"),
               &twists = OptionReader::declared("-schedule_twists");
  const bool by_twists = reader.is_given(twists.name);
  if (by_twists && reader.is_given(rates.name))
    refuse(twists.name, reader.text(twists),
           "allowed: not together with -schedule_rates = " + reader.text(rates));
  const Option &turning = by_twists ? twists : rates;
  const std::vector<double> values = read_per_phase(reader, turning, ends.size(), turning_text);
  input.scene.schedule =
      by_twists ? schedule_from_twists(ends, approach, values) : schedule_from_rates(ends, approach, values);
  input.options.emplace_back(turning.name.substr(1), turning_text);
  if (input.mesh_file.empty()) check_approach(input);
}

/// A steady state forgets how it was reached, except where friction holds gels at rest.
void read_schedule_kind(const OptionReader &reader, SceneInput &input)
{
  Scene &scene = input.scene;
  if (reader.choice("-schedule_kind") == "transient") return;
  if (scene.loads_turn())
    refuse("-schedule_kind", "steady",
           "allowed: transient with -top_offset, -top_tilt or -mesh_file, whose specimens may be other than "
           "round: each "
           "turn loads the gels anew");
  scene.schedule_kind = ScheduleKind::steady;
  if (!scene.has_contact()) return;
  const bool holds = scene.friction.law() && scene.friction.law()->holds_at_rest();
  if (holds && scene.friction.has_memory() && scene.model == Model::solid)
    refuse("-schedule_kind", "steady",
           "in space gels rest at the axis, where steady friction that does not rise with the speed has no "
           "value; allowed: transient, or a law with b < a");
  for (std::size_t k = 0; k < scene.schedule.size(); ++k)
    if (holds && scene.schedule[k].rate == 0)
      refuse("-schedule_kind", "steady",
             "phase " + std::to_string(k + 1) +
                 " is at rest, where static friction depends on the way there; allowed: transient, phases "
                 "that turn, or "
                 "no coefficient with the exponent 0");
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

void read_discretisation(const OptionReader &reader, SceneInput &input)
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
  scene.phase_end_tolerance = reader.real("-phase_end_tolerance");
  if (scene.loads_turn() && scene.phase_end_tolerance > 0)
    refuse("-phase_end_tolerance", to_text(scene.phase_end_tolerance),
           "allowed: 0 with -top_offset, -top_tilt or -mesh_file, where a phase cannot end in one long step");
  const bool at_elements = reader.choice("-contact_integration") == "elements";
  if (at_elements && scene.model == Model::axisymmetric && scene.has_contact())
    refuse("-contact_integration", "elements", "allowed: segments with -model axisymmetric");
  scene.contact_integration = at_elements ? ContactIntegration::elements : ContactIntegration::segments;
  const bool second_order = reader.choice("-maxwell_integrator") == "sdirk2";
  const bool steady = scene.schedule_kind == ScheduleKind::steady; // nothing to integrate: one solve a step
  scene.time.rule = second_order && !steady ? TimeRule::sdirk2 : TimeRule::exponential_euler;
  scene.time.tolerance = reader.real("-time_tolerance");
  const double elements = estimated_elements(scene);
  if (input.mesh_file.empty() && elements > most_elements(scene)) {
    char rounded[32];
    std::snprintf(rounded, sizeof rounded, "%.3g", elements);
    refuse("-elements_radial", std::to_string(scene.mesh.elements_radial),
           std::string("with these radii and heights a mesh of ") + rounded + " elements; allowed: at most " +
               to_text(most_elements(scene)) + " elements (matrix positions are 32-bit numbers)");
  }
}

void warn_about_relaxation(const Scene &scene, SceneInput &input)
{
  double shortest = scene.schedule.front().duration();
  for (const Phase &phase : scene.schedule) shortest = std::min(shortest, phase.duration());
  const auto check = [&](const Specimen &specimen, const std::string &body) {
    for (std::size_t k = 0; k < specimen.material.branches.size(); ++k) {
      const MaxwellBranch<double> &branch = specimen.material.branches[k];
      const double time = shape_relaxation_time(branch);
      if (time < 1e-6 * shortest)
        input.warnings.push_back(branch_names(body, static_cast<int>(k) + 1).viscosities + " = " +
                                 to_text(branch.deviatoric_viscosity) + "," +
                                 to_text(branch.volumetric_viscosity) + ": relaxation time " + to_text(time) +
                                 " s, while the shortest phase takes " + to_text(shortest) +
                                 " s; the branch will not be seen. Is it in MPa s?");
      if (time > 1e3 * scene.schedule.back().end_time)
        input.warnings.push_back(branch_names(body, static_cast<int>(k) + 1).viscosities + " = " +
                                 to_text(branch.deviatoric_viscosity) + "," +
                                 to_text(branch.volumetric_viscosity) + ": relaxation time " + to_text(time) +
                                 " s, while the schedule takes " + to_text(scene.schedule.back().end_time) +
                                 " s; the branch will not relax. Is it in MPa s?");
    }
  };
  if (scene.has_top()) check(scene.top, "top");
  if (scene.has_bottom()) check(scene.bottom, "bottom");
}

/// A run that goes on does so where it is.
void read_output(const OptionReader &reader, SceneInput &input)
{
  OutputParameters &output = input.scene.output;
  const Option &directory = OptionReader::declared("-output_directory"),
               &restart = OptionReader::declared("-restart");
  output.directory = reader.path(directory);
  output.overwrite = reader.flag("-overwrite");
  output.error_estimate = reader.flag("-error_estimate");
  output.checkpoint_every = reader.real("-checkpoint_every");
  if (reader.is_given("-wall_time")) output.wall_time = reader.real("-wall_time");
  if (!reader.is_given(restart.name)) return;
  const std::string where = reader.path(restart);
  const auto plain = [](const std::string &path) {
    return std::filesystem::path(path + "/").lexically_normal();
  };
  if (output.overwrite) refuse("-overwrite", "true", "allowed: not together with -restart = " + where);
  if (reader.is_given(directory.name) && plain(output.directory) != plain(where))
    refuse(directory.name, output.directory, "allowed: with -restart nothing, or its directory " + where);
  output.directory = where;
  output.restart = true;
  input.options.emplace_back("output_directory", where);
}

/// One gel alone: whatever concerns the other one and the contact does nothing.
void note_idle(const GivenOptions &given, SceneInput &input)
{
  const Scene &scene = input.scene;
  if (scene.arrangement == Arrangement::gel_on_gel) return;
  std::string idle;
  for (const auto &[name, text] : given) {
    const bool of_top = name.starts_with("-top_") || name.starts_with("-friction_") ||
                        name == "-initial_gap" || name == "-contact_integration";
    if (scene.has_top() ? name.starts_with("-bottom_") : of_top) idle += (idle.empty() ? "" : ", ") + name;
  }
  if (!idle.empty())
    input.notes.push_back(std::string("without effect with ") +
                          (scene.has_top() ? "-counterface rigid" : "-specimens bottom") + ": " + idle);
}

void read_arrangement(const OptionReader &reader, Scene &scene)
{
  const Option &counterface = OptionReader::declared("-counterface");
  const bool rigid = reader.choice(counterface.name) == "rigid";
  if (reader.choice("-specimens") == "bottom") {
    scene.arrangement = Arrangement::single_gel;
    if (rigid)
      refuse(counterface.name, "rigid",
             "allowed: gel with -specimens bottom, one gel that is bonded to both plates");
  } else
    scene.arrangement = rigid ? Arrangement::gel_on_rigid : Arrangement::gel_on_gel;
}

/// Whatever a reader above has not already written down as resolved.
void resolve_the_rest(const OptionReader &reader, SceneInput &input)
{
  const auto resolved = [&](const std::string &name) {
    return std::any_of(input.options.begin(), input.options.end(),
                       [&](const auto &o) { return o.first == name; });
  };
  std::vector<std::pair<std::string, std::string>> all;
  for (const OptionGroup &group : option_table())
    for (const Option &option : group.options) {
      const bool turning =
          option.name == "-schedule_rates" || option.name == "-schedule_twists"; // one of the two
      if (turning || resolved(option.name.substr(1))) continue;
      if (is_of_another_law(option.name, reader.choice("-friction_law"))) continue;
      const std::string text = reader.text(option);
      all.emplace_back(option.name.substr(1),
                       option.kind == OptionKind::flag && text.empty() ? "true" : text);
    }
  input.options.insert(input.options.begin(), all.begin(), all.end());
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

SceneInput scene_from_options(const GivenOptions &given)
{
  const GivenOptions with_table = with_friction_table(given);
  const OptionReader reader(with_table);
  SceneInput input;
  input.given = with_table;
  Scene &scene = input.scene;
  reader.choice("-task");
  read_arrangement(reader, scene);
  if (reader.choice("-model") == "solid") scene.model = Model::solid;
  read_mesh_file(reader, input);
  read_geometry(reader, scene);
  read_misalignment(reader, scene);
  SceneInput unused; // a specimen that is not there raises no warnings
  scene.top.material = read_material(reader, "top", scene.has_top() ? input : unused);
  scene.bottom.material = read_material(reader, "bottom", scene.has_bottom() ? input : unused);
  input.options.insert(input.options.end(), unused.options.begin(), unused.options.end());
  read_friction(reader, input);
  read_schedule(reader, input);
  read_schedule_kind(reader, input);
  read_discretisation(reader, input);
  read_output(reader, input);
  warn_about_relaxation(scene, input);
  if (input.mesh_file.empty()) judge_sizes(input);
  note_idle(given, input);
  resolve_the_rest(reader, input);
  return input;
}

} // namespace tribogel
