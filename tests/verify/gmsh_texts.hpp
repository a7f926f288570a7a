/// Gmsh files as texts: read, spoiled, refused.
#pragma once

#include "gmsh_writer.hpp"
#include "solids.hpp"

#include "support/user_error.hpp"

namespace tribogel::test
{

inline SerialMesh read(const std::string &text, int order, Arrangement arrangement = Arrangement::gel_on_gel)
{
  std::istringstream stream(text);
  return mesh_of_gmsh(stream, arrangement, order);
}

/// What reading the text is refused with.
inline std::string refusal(const std::string &text, int order = 1,
                           Arrangement arrangement = Arrangement::gel_on_gel)
{
  try {
    read(text, order, arrangement);
  } catch (const UserError &error) {
    return error.text;
  }
  return "taken";
}

inline std::string replaced(std::string text, const std::string &from, const std::string &to)
{
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// Two cubes, one on the other.
inline SerialMesh cubes()
{
  const std::optional<Side> free;
  return stacked({{even(0, 1, 1), even(0, 1, 1), even(-1, 0, 1)},
                  {free, free, free, free, Side::bottom_plate, Side::master}},
                 {{even(0, 1, 1), even(0, 1, 1), even(0, 1, 1)},
                  {free, free, free, free, Side::slave, Side::top_plate}});
}

/// One line that has this part and says what is allowed.
inline void expect_refusal(const std::string &said, const std::string &part)
{
  EXPECT_NE(said.find(part), std::string::npos) << said;
  EXPECT_NE(said.find("; allowed: "), std::string::npos) << said;
  EXPECT_EQ(said.find('\n'), std::string::npos) << said;
}

} // namespace tribogel::test
