/// Option texts -> Scene, with all checks. Pure: no PETSc, no MPI, no files; what PETSc read is handed in as
/// text.
#pragma once

#include "support/settings.hpp"
#include "support/user_error.hpp"
#include "tribogel/scene/scene.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tribogel
{

/// What the user gave: option name with its dash -> text, empty where the value is missing.
using GivenOptions = std::map<std::string, std::string>;

struct SceneInput {
  Scene scene;
  OutputSettings output;
  std::string mesh_file; ///< -mesh_file; empty: the cylinders of the scene
  std::vector<std::pair<std::string, std::string>>
      options;                       ///< every option as resolved: name without the dash, text
  GivenOptions given;                ///< as they came in
  std::vector<std::string> warnings; ///< runs, but is hardly what was meant
  std::vector<std::string> notes;    ///< worth knowing, e.g. an option without effect here
};

/// Throws UserError at the first option that is wrong.
SceneInput scene_from_options(const GivenOptions &given);

} // namespace tribogel
