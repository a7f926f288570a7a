/// What tests of options share: what is read from given texts, and what a refusal says.
#pragma once

#include "options/scene_input.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace tribogel
{

inline std::string refusal(const GivenOptions &given)
{
  try {
    scene_from_options(given);
  } catch (const UserError &error) {
    return error.text;
  }
  return {};
}

inline bool contains(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}

inline std::string joined(const std::vector<std::string> &lines)
{
  std::string text;
  for (const std::string &line : lines) text += line + "\n";
  return text;
}

inline std::string resolved(const SceneInput &input, const std::string &name)
{
  const auto found = std::find_if(input.options.begin(), input.options.end(),
                                  [&](const auto &o) { return o.first == name; });
  return found == input.options.end() ? "absent" : found->second;
}

/// Refused, and the line begins with the option and its value and says what is allowed.
inline void expect_refused(const std::string &name, const std::string &value, GivenOptions others = {})
{
  others[name] = value;
  const std::string text = refusal(others);
  const std::string head = value.empty() ? name + ": value missing" : name + " = " + value;
  EXPECT_TRUE(text.starts_with(head)) << name << " = " << value << " gave '" << text << "'";
  EXPECT_TRUE(contains(text, "allowed:")) << text;
}

} // namespace tribogel
