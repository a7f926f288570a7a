#include "options/material_input.hpp"

#include "support/parse.hpp"
#include "tribogel/material/relaxation.hpp"

namespace tribogel
{

namespace
{

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

} // namespace

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

} // namespace tribogel
