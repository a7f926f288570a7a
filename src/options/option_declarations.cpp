// The declarations themselves; option_table.hpp says what the members mean.
#include "options/friction_options.hpp"
#include "options/option_table.hpp"

namespace tribogel
{

namespace
{

OptionGroup scene_group()
{
  return {"Scene",
          {{.name = "-model",
            .kind = OptionKind::choice,
            .fallback = "axisymmetric",
            .meaning = "axisymmetric: coaxial specimens of revolution with any rotation, in the (R, Z) half "
                       "plane; solid: "
                       "in space",
            .source = "own",
            .choices = {"axisymmetric", "solid"}},
           {.name = "-task",
            .kind = OptionKind::choice,
            .fallback = "simulate",
            .meaning = "simulate: from the scene to force, torque and profiles",
            .source = "own",
            .choices = {"simulate"}},
           {.name = "-specimens",
            .kind = OptionKind::choice,
            .fallback = "both",
            .meaning = "both: two gels in contact; bottom: one gel bonded to both plates, no contact",
            .source = "paper",
            .choices = {"both", "bottom"}},
           {.name = "-counterface",
            .kind = OptionKind::choice,
            .fallback = "gel",
            .meaning = "what the top gel is pressed on: gel: the bottom gel; rigid: a plane at z = 0 in its "
                       "place, which does not yield, as glass or metal",
            .source = "paper",
            .choices = {"gel", "rigid"}}}};
}

OptionGroup geometry_group()
{
  const auto length = [](const char *name, const char *value, const char *meaning, const char *source) {
    return Option{.name = name,
                  .kind = OptionKind::real,
                  .fallback = value,
                  .unit = "mm",
                  .meaning = meaning,
                  .source = source,
                  .range = positive};
  };
  OptionGroup group{
      "Geometry (undeformed)",
      {length("-top_radius", "10", "radius of the top specimen", "paper"),
       length("-top_height", "4.4", "height of the top specimen", "assumed"),
       length("-bottom_radius", "12.5", "radius of the bottom specimen", "paper"),
       length("-bottom_height", "4", "height of the bottom specimen", "assumed"),
       length("-initial_gap", "0", "distance of the two gels at t = 0", "own"),
       {.name = "-top_offset",
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
        .range = {-0.5, 0.5}},
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
        .rule =
            "ASCII, format 2.2 or 4.1, from the working directory; -model solid, -schedule_kind transient",
        .may_change = true}, // to another path of the same mesh
       {.name = "-plate_contact",
        .kind = OptionKind::flag,
        .fallback = "true",
        .meaning = "side walls may touch, not penetrate, the plates; the top gel's may roll onto the bottom "
                   "gel",
        .source = "own"}}};
  group.options[0].rule =
      "not larger than -bottom_radius: the face of the top gel lies on that of the bottom gel";
  group.options[4].range = non_negative;
  return group;
}

/// Ogden moduli, exponents and bulk modulus: the same three for the equilibrium part and for each branch.
std::vector<Option> ogden_options(const BranchNames &names, const std::string &part,
                                  const std::string &moduli)
{
  return {{.name = names.moduli,
           .kind = OptionKind::reals,
           .fallback = moduli,
           .unit = "MPa",
           .meaning = part + ": Ogden moduli G_r",
           .source = "assumed",
           .range = any_real,
           .rule = "each G_r alpha_r > 0"},
          {.name = names.exponents,
           .kind = OptionKind::reals,
           .fallback = "1.3,2,5",
           .unit = "-",
           .meaning = part + ": Ogden exponents alpha_r",
           .source = "paper",
           .range = any_real,
           .rule = "not 0, as many as moduli"},
          {.name = names.bulk_modulus,
           .kind = OptionKind::real,
           .fallback = "200",
           .unit = "MPa",
           .meaning = part + ": bulk modulus K",
           .source = "assumed",
           .range = positive}};
}

std::vector<Option> branch_options(const std::string &body, int branch)
{
  const BranchNames names = branch_names(body, branch);
  std::vector<Option> options = ogden_options(names, "Maxwell branch", "0.25,0.45,0.18");
  options.push_back({.name = names.viscosities,
                     .kind = OptionKind::reals,
                     .fallback = "4.5,200",
                     .unit = "MPa s",
                     .meaning = "Maxwell branch: viscosities, deviatoric and volumetric",
                     .source = "assumed",
                     .range = positive,
                     .count = 2});
  return options;
}

OptionGroup material_group(const std::string &body)
{
  OptionGroup group{"Material of the " + body + " specimen", {}};
  group.options.push_back(
      {.name = "-" + body + "_material",
       .kind = OptionKind::choice,
       .fallback = "viscoelastic",
       .meaning = "viscoelastic: equilibrium part and Maxwell branches; hyperelastic: the former alone",
       .source = "paper",
       .choices = {"viscoelastic", "hyperelastic"}});
  const std::string stem = "-" + body;
  const BranchNames equilibrium{stem + "_ogden_moduli", stem + "_ogden_exponents", stem + "_bulk_modulus",
                                ""};
  for (const Option &option : ogden_options(equilibrium, "equilibrium", "0.75,0.45,0.18"))
    group.options.push_back(option);
  group.options.push_back({.name = stem + "_volumetric_law",
                           .kind = OptionKind::choice,
                           .fallback = "logarithmic",
                           .meaning =
                               "volumetric energy of all springs: logarithmic: K/4 (J^2 - 2 ln J - 1); "
                               "quadratic: K/2 (J - 1)^2",
                           .source = "paper",
                           .choices = {"logarithmic", "quadratic"}});
  for (const Option &option : branch_options(body, 1)) group.options.push_back(option);
  return group;
}

OptionGroup schedule_group()
{
  return {
      "Schedule (phases of the top plate; the bottom plate is fixed)",
      {{.name = "-schedule_end_times",
        .kind = OptionKind::reals,
        .fallback = "27,3600,4500,5400,6300",
        .unit = "s",
        .meaning = "end of each phase, counted from t = 0",
        .source = "paper",
        .range = positive,
        .rule = "increasing"},
       {.name = "-schedule_approach",
        .kind = OptionKind::reals,
        .fallback = "0.79",
        .unit = "mm",
        .meaning =
            "travel of the top plate since t = 0 at each phase's end, -initial_gap included; linear between",
        .source = "assumed",
        .range = any_real,
        .rule = "one for each phase or one for all, less than the height of what stands between the plates"},
       {.name = "-schedule_rates",
        .kind = OptionKind::reals,
        .fallback = "0,0,0.01,0.1,1",
        .unit = "rad/s",
        .meaning = "rate of the top plate in each phase, about +z",
        .source = "paper",
        .range = any_real,
        .rule = "one for each phase or one for all; of this and -schedule_twists the later counts"},
       {.name = "-schedule_twists",
        .kind = OptionKind::reals,
        .fallback = "",
        .unit = "rad",
        .meaning = "instead of rates: angle of the top plate reached at each phase's end",
        .source = "own",
        .range = any_real,
        .rule = "one for each phase or one for all; of this and -schedule_rates the later counts"},
       {.name = "-schedule_kind",
        .kind = OptionKind::choice,
        .fallback = "transient",
        .meaning =
            "transient: the whole history; steady: for each phase the relaxed state at its rate and approach",
        .source = "paper",
        .choices = {"transient", "steady"}},
       {.name = "-phase_end_tolerance",
        .kind = OptionKind::real,
        .fallback = "0",
        .unit = "%",
        .meaning = "what is left of a phase is one step once N and T, going on as fast as now, would change "
                   "by less than "
                   "this part of their largest values; 0: never",
        .source = "own",
        .range = {0, 100}}}};
}

/// Time belongs to the same group.
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

OptionGroup discretisation_group()
{
  OptionGroup group{
      "Discretisation",
      {{.name = "-element_order",
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
        .range = {0, 10}},
       {.name = "-contact_integration",
        .kind = OptionKind::choice,
        .fallback = "segments",
        .meaning = "segments: over the exact intervals or polygons where a slave and a master facet overlap; "
                   "elements:"
                   " at Gauss points of each slave facet, cheaper and less exact (-model solid)",
        .source = "own",
        .choices = {"segments", "elements"}}}};
  for (const Option &option : time_options()) group.options.push_back(option);
  return group;
}

OptionGroup output_group()
{
  return {
      "Output",
      {{.name = "-output_directory",
        .kind = OptionKind::path,
        .fallback = "tribogel-output",
        .meaning = "made if need be, parents included",
        .source = "own",
        .rule = "a directory that holds no run, unless -overwrite",
        .may_change = true},
       {.name = "-overwrite",
        .kind = OptionKind::flag,
        .fallback = "false",
        .meaning = "replace the files of a run that is there; other files stay",
        .source = "own",
        .rule = "not together with -restart",
        .may_change = true},
       {.name = "-checkpoint_every",
        .kind = OptionKind::real,
        .fallback = "600",
        .unit = "s",
        .meaning =
            "wall time between checkpoints; 0: after each step. There is one at each phase's end in any case",
        .source = "own",
        .range = non_negative,
        .may_change = true},
       {.name = "-restart",
        .kind = OptionKind::path,
        .fallback = "",
        .meaning =
            "continue the run in this directory with its options; those of the solver and of the output may"
            " change",
        .source = "own",
        .rule = "the directory of a run that has written a checkpoint",
        .may_change = true},
       {.name = "-error_estimate",
        .kind = OptionKind::flag,
        .fallback = "false",
        .meaning =
            "after the run others of the same scene, on coarser meshes and with shorter steps, and from them"
            " the errors of N and T at each phase's end; they take about twice the run's time",
        .source = "own",
        .may_change = true},
       {.name = "-wall_time",
        .kind = OptionKind::real,
        .fallback = "",
        .unit = "s",
        .meaning = "stop with a checkpoint and status 4 before the program has run for longer than this",
        .source = "own",
        .range = positive,
        .may_change = true}}};
}

} // namespace

const std::vector<OptionGroup> &option_table()
{
  static const std::vector<OptionGroup> table = [] {
    std::vector<OptionGroup> all{scene_group(), geometry_group(), material_group("top"),
                                 material_group("bottom")};
    for (OptionGroup &group : friction_groups()) all.push_back(std::move(group));
    for (const auto &group : {schedule_group(), discretisation_group(), output_group()}) all.push_back(group);
    return all;
  }();
  return table;
}

BranchNames branch_names(const std::string &body, int branch)
{
  const std::string stem = "-" + body + "_maxwell" + (branch > 1 ? std::to_string(branch) : "");
  return {stem + "_ogden_moduli", stem + "_ogden_exponents", stem + "_bulk_modulus", stem + "_viscosities"};
}

std::vector<Option> further_branch_options(const std::string &body, int branch)
{
  std::vector<Option> options = branch_options(body, branch);
  for (Option &option : options) option.fallback.clear();
  return options;
}

} // namespace tribogel
