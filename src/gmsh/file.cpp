#include "gmsh/file.hpp"

#include "gmsh/tables.hpp"
#include "support/parse.hpp"
#include "support/user_error.hpp"

#include <cstdlib>
#include <set>
#include <sstream>
#include <utility>

namespace tribogel
{

namespace
{

using Tag = std::pair<long, long>; ///< dimension, and the number of an entity or a group

constexpr const char *allowed_file = "; allowed: an ASCII file as Gmsh writes it, format 2.2 or 4.1";

class Reader
{
public:
  explicit Reader(std::istream &file) : stream(file) {}

  GmshFile read()
  {
    while (next()) section();
    if (format.empty()) throw UserError{"no $MeshFormat" + std::string(allowed_file)};
    expect_all_nodes();
    expect_all_partitions();
    name_groups();
    return std::move(result);
  }

private:
  /// The next line that is not empty, in words; false at the end.
  bool next()
  {
    do {
      if (!std::getline(stream, line)) return false;
      if (++number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3); // a byte-order mark
      std::istringstream split(line);
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
    if (name[0] != '$' || name == "$") complain("no section begins here" + foreign_head(line));
    if (name == "$NOD" || name == "$ELM") complain("format 1");
    if (name == "$MeshFormat")
      mesh_format();
    else if (name == "$PhysicalNames")
      physical_names();
    else if (name == "$Entities" && format == "4.1")
      entities();
    else if (name == "$PartitionedEntities" && format == "4.1")
      partitioned_entities();
    else if (name == "$Nodes" && format == "4.1")
      node_blocks();
    else if ((name == "$Nodes" || name == "$ParametricNodes") && format == "2.2")
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
    if (words[1] != "0") complain("a binary file (gmsh OLD.msh -save -o NEW.msh writes it in ASCII)");
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
        read_groups({dim, whole(0)}, dim == 0 ? 4 : 7); // after the tag and the point or the bounding box
      }
  }

  /// How many groups an entity is in, and their numbers, negative where the entity is turned round.
  void read_groups(const Tag &entity, std::size_t at)
  {
    std::set<Tag> &groups = groups_of[entity];
    for (long k = 1; k <= whole(at); ++k)
      groups.insert({entity.first, std::abs(whole(at + static_cast<std::size_t>(k)))});
  }

  /// Format 4.1: the parts into which Gmsh has cut the entities, and the interfaces between parts. These
  /// stand under the entity that they cut, of a higher dimension, whose groups are none of theirs.
  void partitioned_entities()
  {
    expect(1);
    partitions = whole(0);
    expect(1);
    for (long ghosts = whole(0); ghosts > 0; --ghosts) expect(2);
    expect(4);
    const std::array<long, 4> counts{whole(0), whole(1), whole(2), whole(3)};
    for (int dim = 0; dim < 4; ++dim)
      for (long left = counts[dim]; left > 0; --left) {
        expect(4);
        const Tag entity{dim, whole(0)}, parent{whole(1), whole(2)};
        const long parts = whole(3);
        if (parts < 0 || parts > static_cast<long>(words.size())) complain("a wrong number of partitions");
        for (long k = 0; k < parts; ++k) parts_of[entity].insert(whole(4 + static_cast<std::size_t>(k)));
        if (parent.first != dim) continue;
        read_groups(entity, 4 + static_cast<std::size_t>(parts) + (dim == 0 ? 3 : 6));
        groups_of[entity].insert(groups_of[parent].begin(), groups_of[parent].end());
      }
  }

  void add_node(long tag)
  {
    if (!result.nodes
             .emplace(tag, std::array{real(words.size() - 3), real(words.size() - 2), real(words.size() - 1)})
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

  /// From the line's words: its tag, then nodes from word `first` on. `owner` is its group or, in format 4.1,
  /// entity.
  void add_element(const GmshElementType &type, std::size_t first, const Tag &owner)
  {
    if (type.dim < 2) return;
    if (words.size() != first + type.nodes) complain("a wrong number of words");
    GmshElement element{whole(0), type.dim, {}, {}};
    for (std::size_t k = first; k < words.size(); ++k) element.nodes.push_back(whole(k));
    result.elements.push_back(std::move(element));
    owners.push_back(owner);
  }

  void elements()
  {
    expect(1);
    for (long left = whole(0); left > 0; --left) {
      expect(3);
      const GmshElementType type = gmsh_element_type(whole(1), place());
      const long tags = whole(2);
      if (tags < 0 || tags > static_cast<long>(words.size())) complain("a wrong number of tags");
      const long group = tags > 0 ? std::abs(whole(3)) : 0; // then the entity and partitions
      add_element(type, 3 + static_cast<std::size_t>(tags), {type.dim, group});
    }
  }

  void element_blocks()
  {
    expect(4);
    for (long blocks = whole(0); blocks > 0; --blocks) {
      expect(4);
      const Tag entity{whole(0), whole(1)};
      const GmshElementType type = gmsh_element_type(whole(2), place());
      for (long left = whole(3); left > 0; --left) {
        expect(2);
        add_element(type, 1, entity);
      }
    }
  }

  void expect_all_nodes() const
  {
    for (const GmshElement &element : result.elements)
      for (const long node : element.nodes)
        if (!result.nodes.count(node))
          throw UserError{"no node " + std::to_string(node) + ", which element " +
                          std::to_string(element.tag) + " has" + allowed_file};
  }

  /// Gmsh can write each partition to a file of its own.
  void expect_all_partitions() const
  {
    std::set<long> present;
    for (std::size_t k = 0; k < owners.size(); ++k)
      if (const auto found = parts_of.find(owners[k]); result.elements[k].dim == 3 && found != parts_of.end())
        present.insert(found->second.begin(), found->second.end());
    const auto count = static_cast<long>(present.size());
    if (count > 0 && count < partitions)
      throw UserError{"holds " + std::to_string(count) + " of the " + std::to_string(partitions) +
                      " parts into which the mesh was cut; allowed: a mesh in one file"};
  }

  void name_groups()
  {
    for (const auto &[tag, name] : names)
      if (tag.first >= 2) result.groups[{static_cast<int>(tag.first), tag.second}].name = name;
    for (std::size_t k = 0; k < owners.size(); ++k) {
      GmshElement &element = result.elements[k];
      const std::set<Tag> groups = format == "4.1" ? groups_of[owners[k]] : std::set<Tag>{owners[k]};
      for (const Tag &tag : groups) {
        if (tag.second == 0) continue; // in no group
        GmshGroup &group = result.groups[{element.dim, tag.second}];
        ++group.elements;
        if (!group.name.empty()) element.groups.push_back(group.name);
      }
    }
  }

  std::string place() const { return "line " + std::to_string(number) + ": "; }

  std::istream &stream;
  long number = 0; ///< of the line
  std::string line, format;
  std::vector<std::string> words;
  long partitions = 0;                    ///< of the whole mesh
  std::map<Tag, std::string> names;       ///< of groups
  std::map<Tag, std::set<Tag>> groups_of; ///< entities
  std::map<Tag, std::set<long>> parts_of; ///< entities: the partitions they are in
  std::vector<Tag> owners;                ///< of the elements: groups or, in format 4.1, entities
  GmshFile result;
};

} // namespace

GmshFile read_gmsh(std::istream &stream)
{
  return Reader(stream).read();
}

} // namespace tribogel
