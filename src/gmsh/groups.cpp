#include "gmsh/groups.hpp"

#include "options/nearest_name.hpp"

namespace tribogel
{

namespace
{

std::string kind_of(int dim)
{
  return dim == 3 ? "volume" : "surface";
}

/// `volumes 'top', number 4 (no name)`, or that there are none.
std::string listed(const GmshFile &file, int dim)
{
  constexpr int most = 12;
  int count = 0;
  std::string text;
  for (const auto &[tag, group] : file.groups) {
    if (tag.first != dim || ++count > most) continue;
    text += (count == 1 ? "" : ", ") +
            (group.name.empty() ? "number " + std::to_string(tag.second) + " (no name)"
                                : "'" + group.name + "'") +
            (group.elements > 0 ? "" : " (no element)");
  }
  if (count == 0) return "no " + kind_of(dim) + "s";
  if (count > most) text += " and " + std::to_string(count - most) + " more";
  return kind_of(dim) + (count == 1 ? " " : "s ") + text;
}

/// What was probably meant; empty if nothing is like it.
std::string hint(const GmshFile &file, int dim, const std::string &name)
{
  std::vector<std::string> others;
  for (const auto &[tag, group] : file.groups) {
    if (group.name == name)
      return tag.first == dim ? "the file names it, but no element is in it (with Mesh.SaveAll Gmsh leaves "
                                "groups out of format 2.2)"
                              : "'" + name + "' is a " + kind_of(tag.first);
    if (tag.first == dim && !group.name.empty()) others.push_back(group.name);
  }
  const std::string nearest = nearest_name(name, others, plausible_distance(name));
  return nearest.empty() ? nearest
                         : "there is a " + kind_of(dim) + " '" + nearest + "': names are taken to the letter";
}

} // namespace

std::string no_such_group(const GmshFile &file, int dim, const std::string &name)
{
  std::string text = "no physical " + kind_of(dim) + " '" + name + "'";
  if (const std::string meant = hint(file, dim, name); !meant.empty()) text += "; " + meant;
  if (file.groups.empty()) return text + "; the file has no physical groups";
  return text + "; the file has " + listed(file, 3) + " and " + listed(file, 2);
}

} // namespace tribogel
