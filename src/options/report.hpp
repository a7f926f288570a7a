/// What is about to be solved, in words and derived numbers, for the head of the console output.
#pragma once

#include "options/scene_input.hpp"

namespace tribogel
{

/// The scene; then warnings and notes, one line each. Ends with a line feed.
std::string scene_report(const SceneInput &input);

} // namespace tribogel
