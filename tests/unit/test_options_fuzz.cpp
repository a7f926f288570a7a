/// 20,000 sets of options, right ones and spoiled ones: each is either refused with one line that names an
/// option and what is allowed, or gives a scene that makes sense.
#include "options/discretisation_options.hpp"
#include "options/option_table.hpp"
#include "options/scene_input.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tribogel::test
{

namespace
{

class Generator
{
public:
  std::string value(const Option &option)
  {
    switch (pick(8)) {
    case 0:
      return junk();
    case 1:
      return option.fallback;
    case 2:
      return spoiled(option.fallback);
    case 3:
      return number() + "," + number();
    case 4:
      return option.choices.empty() ? number() : option.choices[pick(option.choices.size())];
    case 5:
      return list();
    default:
      return number();
    }
  }

  std::size_t pick(std::size_t count)
  {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(engine);
  }

private:
  std::string number()
  {
    static const std::vector<std::string> special = {
        "0",  "-0", "1", "-1",  "1e-300", "1e300", "1e400", "nan", "inf", "0x1", "1.5.2", "--2",
        "3e", "12", "2", "0.5", "1e-5",   "27",    "3600",  " 7",  "7 ",  "",    "+4",    ".5"};
    if (pick(3) > 0) return special[pick(special.size())];
    return std::to_string(std::lognormal_distribution<double>(0, 4)(engine));
  }

  std::string list()
  {
    std::string text = number();
    for (std::size_t k = pick(6); k > 0; --k) text += "," + number();
    return text;
  }

  std::string junk()
  {
    std::string text;
    for (std::size_t k = pick(12); k > 0; --k) text += static_cast<char>(33 + pick(94));
    return text;
  }

  std::string spoiled(std::string text)
  {
    if (text.empty()) return junk();
    const std::size_t at = pick(text.size());
    switch (pick(3)) {
    case 0:
      text.erase(at, 1);
      break;
    case 1:
      text.insert(at, 1, static_cast<char>(33 + pick(94)));
      break;
    default:
      text[at] = static_cast<char>(33 + pick(94));
      break;
    }
    return text;
  }

  std::mt19937 engine{20091334};
};

void expect_sense(const Scene &scene)
{
  for (const Specimen *gel : {&scene.top, &scene.bottom}) {
    if (gel == &scene.top && !scene.has_top()) continue;
    EXPECT_TRUE(gel->radius > 0 && std::isfinite(gel->radius) && gel->height > 0 &&
                std::isfinite(gel->height));
    EXPECT_GT(gel->material.equilibrium.bulk_modulus, 0);
    EXPECT_GT(gel->material.equilibrium.shear_modulus(), 0);
    for (const auto &branch : gel->material.branches) {
      EXPECT_GT(branch.deviatoric_viscosity, 0);
      EXPECT_GT(branch.volumetric_viscosity, 0);
    }
  }
  if (const FrictionLaw *law = scene.friction.law()) {
    for (const auto &list : law->values())
      for (const double x : list) EXPECT_TRUE(std::isfinite(x));
    EXPECT_GE(law->threshold(0.1).value, 0);
  }
  ASSERT_FALSE(scene.schedule.empty());
  for (const Phase &phase : scene.schedule) {
    EXPECT_GT(phase.duration(), 0);
    EXPECT_TRUE(std::isfinite(phase.end_approach) && std::isfinite(phase.rate));
  }
  EXPECT_TRUE(scene.mesh.element_order == 1 || scene.mesh.element_order == 2);
  EXPECT_GE(scene.mesh.elements_radial, 1);
  EXPECT_GE(scene.mesh.grading, 1);
  EXPECT_LE(estimated_elements(scene), most_elements(scene));
  EXPECT_TRUE(scene.time.tolerance > 0 && std::isfinite(scene.time.tolerance));
}

} // namespace

TEST(OptionsFuzz, every_input_is_refused_in_one_line_or_makes_sense)
{
  std::vector<const Option *> options;
  for (const OptionGroup &group : option_table())
    for (const Option &option : group.options) options.push_back(&option);
  Generator generator;
  int refused = 0, accepted = 0;
  for (int input = 0; input < 20000 && !testing::Test::HasFailure(); ++input) {
    GivenOptions given;
    for (std::size_t k = 1 + generator.pick(3); k > 0; --k) {
      const Option &option = *options[generator.pick(options.size())];
      given[option.name] = generator.value(option);
    }
    std::string shown;
    for (const auto &[name, text] : given) shown += name + " '" + text + "' ";
    SCOPED_TRACE(shown);
    try {
      expect_sense(scene_from_options(given).scene);
      ++accepted;
    } catch (const UserError &error) {
      EXPECT_EQ(error.text.find('\n'), std::string::npos) << error.text;
      EXPECT_EQ(error.text[0], '-') << error.text; // the option's name
      EXPECT_NE(error.text.find("allowed"), std::string::npos) << error.text;
      ++refused;
    }
  }
  EXPECT_GT(accepted, 2000); // it does both
  EXPECT_GT(refused, 2000);
}

} // namespace tribogel::test
