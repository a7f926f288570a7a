/// The list of all that can be set: a file a subject, which declares its options and reads them into the
/// scene.
#pragma once

#include "options/option_table.hpp"

namespace tribogel
{

class OptionReader;
struct SceneInput;

struct OptionSubject {
  std::vector<OptionGroup> (*declare)(); ///< its tables of -help
  /// What its options say, after those before it in the list; adds warnings and notes. Throws UserError.
  void (*read)(const OptionReader &reader, SceneInput &input);
};

/// In the order of -help, which is that of reading.
const std::vector<OptionSubject> &option_subjects();

OptionSubject scene_options();
OptionSubject geometry_options();
OptionSubject material_options();
OptionSubject friction_options();
OptionSubject schedule_options();
OptionSubject discretisation_options();
OptionSubject output_options();

} // namespace tribogel
