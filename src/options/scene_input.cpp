#include "options/scene_input.hpp"

#include "options/friction_options.hpp"
#include "options/material_options.hpp"
#include "options/option_groups.hpp"
#include "options/option_reader.hpp"
#include "options/sizes.hpp"

#include <algorithm>

namespace tribogel
{

namespace
{

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

/// Whatever a subject has not already written down as resolved.
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

SceneInput scene_from_options(const GivenOptions &given)
{
  const GivenOptions with_table = with_friction_table(given);
  const OptionReader reader(with_table);
  SceneInput input;
  input.given = with_table;
  for (const OptionSubject &subject : option_subjects()) subject.read(reader, input);
  warn_about_relaxation(input);
  if (input.mesh_file.empty()) judge_sizes(input);
  note_idle(given, input);
  resolve_the_rest(reader, input);
  return input;
}

} // namespace tribogel
