/// The gels' materials.
#include "options/material_options.hpp"

#include "options/option_groups.hpp"
#include "options/option_reader.hpp"
#include "support/parse.hpp"
#include "tribogel/material/relaxation.hpp"

namespace tribogel
{

namespace
{

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

/// The declarations of a branch beyond the first: those of the first one without defaults.
std::vector<Option> further_branch_options(const std::string &body, int branch)
{
  std::vector<Option> options = branch_options(body, branch);
  for (Option &option : options) option.fallback.clear();
  return options;
}

/// Each term must be stable by itself; the sum then gives a positive shear modulus.
Ogden<double> read_ogden(const OptionReader &reader, const Option &moduli, const Option &exponents,
                         const Option &bulk_modulus, VolumetricLaw volumetric_law)
{
  reader.expect_equal_lengths(exponents, moduli);
  Ogden<double> law;
  law.moduli = reader.reals(moduli);
  law.exponents = reader.reals(exponents);
  law.bulk_modulus = reader.real(bulk_modulus);
  law.volumetric_law = volumetric_law;
  for (std::size_t r = 0; r < law.moduli.size(); ++r) {
    if (law.exponents[r] == 0)
      refuse(exponents.name, reader.text(exponents), "allowed: " + exponents.allowed());
    if (!(law.moduli[r] * law.exponents[r] > 0))
      refuse(moduli.name, reader.text(moduli),
             "with " + exponents.name + " = " + reader.text(exponents) + " term " + std::to_string(r + 1) +
                 " has G_r alpha_r = " + to_text(law.moduli[r] * law.exponents[r]) +
                 "; allowed: " + moduli.allowed());
  }
  return law;
}

void warn_if_auxetic(const Ogden<double> &law, const std::string &bulk_modulus, SceneInput &input)
{
  const double G = law.shear_modulus();
  if (law.bulk_modulus < G)
    input.warnings.push_back(bulk_modulus + " = " + to_text(law.bulk_modulus) +
                             " MPa is less than the shear modulus " + to_text(G) + " MPa" +
                             (initial_poisson_ratio(law) < 0 ? ": an auxetic material" : "") +
                             "; are both in MPa?");
}

MaxwellBranch<double> read_branch(const OptionReader &reader, const std::vector<Option> &options,
                                  VolumetricLaw volumetric_law, SceneInput &input)
{
  MaxwellBranch<double> branch;
  branch.spring = read_ogden(reader, options[0], options[1], options[2], volumetric_law);
  const std::vector<double> viscosities = reader.reals(options[3]);
  branch.deviatoric_viscosity = viscosities[0];
  branch.volumetric_viscosity = viscosities[1];
  warn_if_auxetic(branch.spring, options[2].name, input);
  return branch;
}

std::vector<Option> first_branch_options(const std::string &body)
{
  std::vector<Option> options;
  for (const std::string &name : branch_names(body, 1).all()) options.push_back(OptionReader::declared(name));
  return options;
}

bool any_given(const OptionReader &reader, const std::vector<std::string> &names)
{
  for (const std::string &name : names)
    if (reader.is_given(name)) return true;
  return false;
}

/// Of one specimen, "top" or "bottom". Adds warnings and notes.
Viscoelastic<double> read_material(const OptionReader &reader, const std::string &body, SceneInput &input)
{
  const std::string stem = "-" + body;
  const auto declared = [&](const std::string &rest) { return OptionReader::declared(stem + rest); };
  const bool viscoelastic = reader.choice(stem + "_material") == "viscoelastic";
  Viscoelastic<double> material;
  const VolumetricLaw volumetric_law = reader.choice(stem + "_volumetric_law") == "quadratic"
                                           ? VolumetricLaw::quadratic
                                           : VolumetricLaw::logarithmic;
  material.equilibrium = read_ogden(reader, declared("_ogden_moduli"), declared("_ogden_exponents"),
                                    declared("_bulk_modulus"), volumetric_law);
  warn_if_auxetic(material.equilibrium, stem + "_bulk_modulus", input);

  SceneInput branches; // read in any case, so that a wrong value is refused; kept if they count
  material.branches.push_back(read_branch(reader, first_branch_options(body), volumetric_law, branches));
  for (int number = 2; any_given(reader, branch_names(body, number).all()); ++number) {
    const std::vector<Option> options = further_branch_options(body, number);
    for (const Option &option : options) {
      if (!reader.is_given(option.name))
        throw UserError{
            option.name +
            ": value missing, a branch beyond the first has no defaults; allowed: " + option.allowed()};
      branches.options.emplace_back(option.name.substr(1), reader.text(option));
    }
    material.branches.push_back(read_branch(reader, options, volumetric_law, branches));
  }
  input.options.insert(input.options.end(), branches.options.begin(), branches.options.end());
  if (viscoelastic) {
    input.warnings.insert(input.warnings.end(), branches.warnings.begin(), branches.warnings.end());
    return material;
  }

  std::string idle;
  for (int number = 1; number <= static_cast<int>(material.branches.size()); ++number)
    for (const std::string &name : branch_names(body, number).all())
      if (reader.is_given(name)) idle += (idle.empty() ? "" : ", ") + name;
  if (!idle.empty()) input.notes.push_back("without effect with " + stem + "_material hyperelastic: " + idle);
  material.branches.clear();
  return material;
}

std::vector<OptionGroup> declare_materials()
{
  return {material_group("top"), material_group("bottom")};
}

void read_materials(const OptionReader &reader, SceneInput &input)
{
  Scene &scene = input.scene;
  SceneInput unused; // a specimen that is not there raises no warnings
  scene.top.material = read_material(reader, "top", scene.has_top() ? input : unused);
  scene.bottom.material = read_material(reader, "bottom", scene.has_bottom() ? input : unused);
  input.options.insert(input.options.end(), unused.options.begin(), unused.options.end());
}

} // namespace

BranchNames branch_names(const std::string &body, int branch)
{
  const std::string stem = "-" + body + "_maxwell" + (branch > 1 ? std::to_string(branch) : "");
  return {stem + "_ogden_moduli", stem + "_ogden_exponents", stem + "_bulk_modulus", stem + "_viscosities"};
}

void warn_about_relaxation(SceneInput &input)
{
  const Scene &scene = input.scene;
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

OptionSubject material_options()
{
  return {declare_materials, read_materials};
}

} // namespace tribogel
