#include "options/option_groups.hpp"

#include <utility>

namespace tribogel
{

const std::vector<OptionSubject> &option_subjects()
{
  static const std::vector<OptionSubject> all{
      scene_options(),    geometry_options(),       material_options(), friction_options(),
      schedule_options(), discretisation_options(), output_options()};
  return all;
}

const std::vector<OptionGroup> &option_table()
{
  static const std::vector<OptionGroup> table = [] {
    std::vector<OptionGroup> groups;
    for (const OptionSubject &subject : option_subjects())
      for (OptionGroup &group : subject.declare()) groups.push_back(std::move(group));
    return groups;
  }();
  return table;
}

} // namespace tribogel
