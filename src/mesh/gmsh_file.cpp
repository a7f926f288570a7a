#include "mesh/gmsh_file.hpp"

#include "scene/parse.hpp"
#include "scene/user_error.hpp"

#include <cstdlib>
#include <sstream>
#include <utility>

namespace tribogel
{

namespace
{

using Tag = std::pair<long, long>; ///< dimension, and the number of an entity or a group

constexpr const char *allowed_file = "; allowed: an ASCII file as Gmsh writes it, format 2.2 or 4.1";

struct ElementType {
  int dim;
  std::size_t nodes;
};

/// Gmsh's numbers of types of elements; dim 0 or 1 are passed over.
ElementType type_of(long number, const std::string &where)
{
  static const std::map<long, ElementType> taken{{15, {0, 1}}, {1, {1, 2}}, {8, {1, 3}},   {3, {2, 4}},  {16, {2, 8}},
                                                 {10, {2, 9}}, {5, {3, 8}}, {17, {3, 20}}, {12, {3, 27}}};
  static const std::map<long, const char *> others{
      {2, "triangle"}, {9, "triangle"}, {4, "tetrahedron"}, {11, "tetrahedron"}, {6, "prism"},
      {13, "prism"},   {18, "prism"},   {7, "pyramid"},     {14, "pyramid"},     {19, "pyramid"}};
  if (const auto found = taken.find(number); found != taken.end()) return found->second;
  const auto other = others.find(number);
  throw UserError{where + "an element of type " + std::to_string(number) +
                  (other == others.end() ? "" : std::string(" (") + other->second + ")") +
                  "; allowed: hexahedra of 8, 20 or 27 nodes and their faces"};
}

class Reader
{
public:
  explicit Reader(std::istream &file) : stream(file) {}

  GmshFile read()
  {
    while (next()) section();
    if (format.empty()) throw UserError{"no $MeshFormat" + std::string(allowed_file)};
    return std::move(result);
  }

private:
  /// The next line that is not empty, in words; false at the end.
  bool next()
  {
    std::string text;
    do {
      if (!std::getline(stream, text)) return false;
      ++number;
      line = text;
      std::istringstream split(text);
      words.clear();
      for (std::string word; split >> word;) words.push_back(word);
    } while (words.empty());
    return true;
  }

  [[noreturn]] void complain(const std::string &what) const
  {
    throw UserError{"line " + std::to_string(number) + ": " + what + allowed_file};
  }

  /// The next line, at least so many words.
  void expect(std::size_t least)
  {
    if (!next()) complain("the file ends too early");
    if (words.size() < least) complain("too few words");
  }

  long whole(std::size_t k) const
  {
    if (k >= words.size()) complain("too few words");
    const auto parsed = parse_integer(words[k]);
    if (!parsed.value) complain(parsed.error);
    return *parsed.value;
  }

  double real(std::size_t k) const
  {
    const auto parsed = parse_real(words[k]);
    if (!parsed.value) complain(parsed.error);
    return *parsed.value;
  }

  void section()
  {
    const std::string name = words[0];
    if (name[0] != '$') complain("no section begins here");
    if (name == "$MeshFormat")
      mesh_format();
    else if (name == "$PhysicalNames")
      physical_names();
    else if (name == "$Entities" && format == "4.1")
      entities();
    else if (name == "$Nodes" && format == "4.1")
      node_blocks();
    else if (name == "$Nodes" && format == "2.2")
      nodes();
    else if (name == "$Elements" && format == "4.1")
      element_blocks();
    else if (name == "$Elements" && format == "2.2")
      elements();
    else if (name == "$Nodes" || name == "$Elements")
      complain("no $MeshFormat before it");
    else
      while (next() && words[0] != "$End" + name.substr(1)) continue;
    if (words.empty() || words[0] != "$End" + name.substr(1)) {
      expect(1);
      if (words[0] != "$End" + name.substr(1)) complain("$End" + name.substr(1) + " is expected here");
    }
  }

  void mesh_format()
  {
    expect(2);
    if (words[0] != "2.2" && words[0] != "4.1") complain("format " + words[0]);
    if (words[1] != "0") complain("a binary file");
    format = words[0];
  }

  void physical_names()
  {
    expect(1);
    for (long left = whole(0); left > 0; --left) {
      expect(3);
      const std::size_t from = line.find('"'), to = line.rfind('"');
      if (from == to) complain("a name without quotes");
      names[{whole(0), whole(1)}] = line.substr(from + 1, to - from - 1);
    }
  }

  /// Format 4.1: points, curves, surfaces and volumes with the numbers of their groups.
  void entities()
  {
    expect(4);
    const std::array<long, 4> counts{whole(0), whole(1), whole(2), whole(3)};
    for (int dim = 0; dim < 4; ++dim)
      for (long left = counts[dim]; left > 0; --left) {
        expect(dim == 0 ? 5 : 8);
        const std::size_t at = dim == 0 ? 4 : 7; // after the tag and the point or the bounding box
        for (long k = 1; k <= whole(at); ++k)
          groups_of[{dim, whole(0)}].push_back({dim, std::abs(whole(at + static_cast<std::size_t>(k)))});
      }
  }

  void add_node(long tag)
  {
    if (!result.nodes.emplace(tag, std::array{real(words.size() - 3), real(words.size() - 2), real(words.size() - 1)})
             .second)
      complain("node " + std::to_string(tag) + " a second time");
  }

  void nodes()
  {
    expect(1);
    for (long left = whole(0); left > 0; --left) {
      expect(4);
      words.resize(4);
      add_node(whole(0));
    }
  }

  void node_blocks()
  {
    expect(4);
    for (long blocks = whole(0); blocks > 0; --blocks) {
      expect(4);
      std::vector<long> tags;
      for (long left = whole(3); left > 0; --left) {
        expect(1);
        tags.push_back(whole(0));
      }
      for (const long tag : tags) {
        expect(3);
        words.resize(3); // what may follow are parameters on the entity
        add_node(tag);
      }
    }
  }

  /// From the line's words: its tag, then nodes from word `first` on.
  void add_element(const ElementType &type, std::size_t first, const std::vector<Tag> &groups)
  {
    if (type.dim < 2) return;
    if (words.size() != first + type.nodes) complain("a wrong number of words");
    GmshElement element{whole(0), type.dim, {}, {}};
    for (std::size_t k = first; k < words.size(); ++k) {
      element.nodes.push_back(whole(k));
      if (!result.nodes.count(element.nodes.back())) complain("no node " + words[k]);
    }
    for (const Tag &group : groups)
      if (const auto found = names.find(group); found != names.end()) element.groups.push_back(found->second);
    result.elements.push_back(std::move(element));
  }

  void elements()
  {
    expect(1);
    for (long left = whole(0); left > 0; --left) {
      expect(3);
      const ElementType type = type_of(whole(1), place());
      const long tags = whole(2);
      if (tags < 0 || tags > static_cast<long>(words.size())) complain("a wrong number of tags");
      std::vector<Tag> groups;
      if (tags > 0) groups.push_back({type.dim, std::abs(whole(3))}); // then the entity and partitions
      add_element(type, 3 + static_cast<std::size_t>(tags), groups);
    }
  }

  void element_blocks()
  {
    expect(4);
    for (long blocks = whole(0); blocks > 0; --blocks) {
      expect(4);
      const std::vector<Tag> groups = groups_of[{whole(0), whole(1)}];
      const ElementType type = type_of(whole(2), place());
      for (long left = whole(3); left > 0; --left) {
        expect(2);
        add_element(type, 1, groups);
      }
    }
  }

  std::string place() const { return "line " + std::to_string(number) + ": "; }

  std::istream &stream;
  long number = 0; ///< of the line
  std::string line, format;
  std::vector<std::string> words;
  std::map<Tag, std::string> names;          ///< of groups
  std::map<Tag, std::vector<Tag>> groups_of; ///< entities
  GmshFile result;
};

} // namespace

GmshFile read_gmsh(std::istream &stream)
{
  return Reader(stream).read();
}

} // namespace tribogel
