#include "gmsh/bodies.hpp"

#include "gmsh/file.hpp"
#include "gmsh/groups.hpp"
#include "gmsh/hexahedron.hpp"
#include "support/user_error.hpp"

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace tribogel
{

namespace
{

using Face = std::array<int, 4>; ///< vertices, increasing

bool stands_in(const GmshElement &element, const char *group)
{
  return std::find(element.groups.begin(), element.groups.end(), group) != element.groups.end();
}

class Builder
{
public:
  Builder(const GmshFile &given, Arrangement expected, int element_order)
      : file(given), arrangement(expected), order(element_order), parts(given.elements.size())
  {
    mesh.dim = 3;
  }

  GmshBodies build()
  {
    expect_groups();
    for (const GmshElement &element : file.elements)
      curved = curved || (element.dim == 3 && element.nodes.size() > 8);
    for (const GmshElement &element : file.elements)
      if (element.dim == 3) add_cell(element);
    for (const GmshElement &element : file.elements)
      if (element.dim == 2) name_face(element);
    if (!left_out.empty())
      bodies.warnings.push_back("hexahedra that are not in the physical " + volumes() + " are left out (" +
                                in_number(left_out.size()) + "element " + std::to_string(left_out.front()) +
                                ")");
    for (const auto &[vertices, face] : faces)
      if (face.cells == 1) bodies.outer.push_back(face.outer);
    for (const OuterFace &face : bodies.outer) mesh.boundary.push_back({face.around, face.side});
    for (std::size_t c = 0; c < mesh.cell.size(); ++c)
      bodies.part.push_back(parts.find_set(static_cast<int>(c)));
    return std::move(bodies);
  }

private:
  struct KnownFace {
    OuterFace outer{}; ///< of the first cell
    int cells = 0;
  };

  std::string volumes() const
  {
    return arrangement == Arrangement::gel_on_gel     ? "volumes top and bottom"
           : arrangement == Arrangement::gel_on_rigid ? "volume top"
                                                      : "volume bottom";
  }

  std::string surfaces() const
  {
    return arrangement == Arrangement::gel_on_gel ? "top_plate, bottom_plate, top_contact and bottom_contact"
           : arrangement == Arrangement::gel_on_rigid ? "top_plate and top_contact"
                                                      : "top_plate and bottom_plate";
  }

  std::string condition() const
  {
    return arrangement == Arrangement::gel_on_gel     ? ""
           : arrangement == Arrangement::gel_on_rigid ? "with -counterface rigid "
                                                      : "with -specimens bottom ";
  }

  /// What must be there, all of it in the refusal.
  void expect_groups() const
  {
    const auto expect = [&](int dim, const char *name) {
      for (const GmshElement &element : file.elements)
        if (element.dim == dim && stands_in(element, name)) return;
      throw UserError{no_such_group(file, dim, name) + "; allowed: " + condition() + volumes() +
                      ", surfaces " + surfaces()};
    };
    for (const int body : bodies_of(arrangement)) expect(3, body_names[body]);
    for (const SurfaceGroup &group : surface_groups(arrangement)) expect(2, group.name);
  }

  [[noreturn]] static void complain(const GmshElement &element, const std::string &what)
  {
    throw UserError{"element " + std::to_string(element.tag) + " " + what};
  }

  /// A vertex of a cell, in the order of first use.
  int vertex(const GmshElement &element, long tag, int body)
  {
    const auto [place, is_new] = vertex_of.try_emplace(tag, static_cast<int>(mesh.vertex.size()));
    if (is_new) {
      mesh.vertex.push_back(file.nodes.at(tag));
      body_of.push_back(body);
    } else if (body_of[place->second] != body)
      complain(
          element,
          "shares node " + std::to_string(tag) +
              " with the other body; allowed: bodies that have nodes of their own, also where they touch");
    return place->second;
  }

  void add_cell(const GmshElement &element)
  {
    bool in[2] = {false, false};
    for (const int body : bodies_of(arrangement)) in[body] = stands_in(element, body_names[body]);
    if (!in[0] && !in[1]) return left_out.push_back(element.tag);
    if (in[0] && in[1]) complain(element, "stands in top and in bottom; allowed: one of them");
    std::vector<Place> given;
    for (const long tag : element.nodes) given.push_back(file.nodes.at(tag));
    const auto node = all_nodes(given);
    if (const std::string fault = fault_of(node, given.size(), order); !fault.empty())
      complain(element, fault);
    SerialMesh::Cell cell{{}, in[1] ? top_body : bottom_body, 0};
    std::array<int, 8> corner;
    double middle[2] = {};
    for (int v = 0; v < 8; ++v) {
      corner[v] = vertex(element, element.nodes[v], cell.body);
      for (int j = 0; j < 2; ++j) middle[j] += node[v][j];
    }
    cell.key = std::atan2(middle[1], middle[0]);
    for (int v = 0; v < 8; ++v) cell.vertex[v] = corner[gmsh_corner[v]];
    const bool left_handed = is_left_handed(node);
    if (left_handed)
      for (int v : {1, 5}) std::swap(cell.vertex[v], cell.vertex[v + 1]);
    mesh.cell.push_back(cell);
    bodies.element.push_back(element.tag);
    for (const auto &local : gmsh_face) {
      Face around{corner[local[0]], corner[local[1]], corner[local[2]], corner[local[3]]};
      if (left_handed) std::reverse(around.begin(), around.end());
      add_face(element, around);
    }
    if (order == 2 && (curved || given.size() > 8)) add_middles(element, corner, node);
  }

  /// Of the last cell, seen from outside.
  void add_face(const GmshElement &element, const Face &around)
  {
    KnownFace &face = faces[key(around)];
    const int cell = static_cast<int>(mesh.cell.size()) - 1;
    if (++face.cells == 1) {
      face.outer = {around, cell, Side::wall, {}, false};
      return;
    }
    if (face.cells > 2) complain(element, "has a face that two others have; allowed: each cell once");
    Face back = around;
    std::reverse(back.begin(), back.end());
    std::rotate(back.begin(), std::find(back.begin(), back.end(), face.outer.around[0]), back.end());
    if (back != face.outer.around)
      complain(element, "and element " + std::to_string(bodies.element[face.outer.cell]) +
                            " overlap, they lie on the same side of a face; allowed: each cell once");
    parts.union_set(face.outer.cell, cell);
  }

  static Face key(Face face)
  {
    std::sort(face.begin(), face.end());
    return face;
  }

  /// Of the 27 places those with two, four and eight corners.
  void add_middles(const GmshElement &element, const std::array<int, 8> &corner,
                   const std::array<Place, 27> &node)
  {
    for (int k = 8; k < 27; ++k) {
      std::vector<int> vertices;
      for (const int v : corners_of_node(k)) vertices.push_back(corner[v]);
      const auto [found, is_new] = mesh.middle.try_emplace(middle_key(vertices), node[k]);
      if (!is_new) expect_same(element, vertices, node[k], found->second);
    }
  }

  /// The middle of an edge or a face where this element and where another one has it.
  void expect_same(const GmshElement &element, const std::vector<int> &vertices, const Place &here,
                   const Place &there) const
  {
    const Place &a = mesh.vertex[vertices[0]], &b = mesh.vertex[vertices[1]];
    if (distance(here, there) <= same_place * distance(a, b)) return;
    const auto has_all = [&](const SerialMesh::Cell &cell) {
      return std::all_of(vertices.begin(), vertices.end(), [&](int v) {
        return std::find(cell.vertex.begin(), cell.vertex.end(), v) != cell.vertex.end();
      });
    };
    const auto other = std::find_if(mesh.cell.begin(), mesh.cell.end(), has_all) - mesh.cell.begin();
    complain(element, "has the middle of " +
                          (vertices.size() == 2 ? "the edge from " + in_words(a) + " to " + in_words(b)
                                                : "the face at " + in_words(a)) +
                          " at " + in_words(here) + ", element " + std::to_string(bodies.element[other]) +
                          " at " + in_words(there) + "; allowed: one middle");
  }

  /// The face of a cell that has these corners.
  KnownFace *face_of(const GmshElement &element)
  {
    Face vertices{};
    for (int v = 0; v < 4; ++v) {
      const auto found = vertex_of.find(element.nodes[v]);
      if (found == vertex_of.end()) return nullptr;
      vertices[v] = found->second;
    }
    const auto found = faces.find(key(vertices));
    return found == faces.end() ? nullptr : &found->second;
  }

  void name_face(const GmshElement &element)
  {
    KnownFace *const face = face_of(element);
    bool known = false;
    for (const SurfaceGroup &group : surface_groups(arrangement)) {
      if (!stands_in(element, group.name)) continue;
      known = true;
      const std::string where = std::string("of ") + group.name + " ";
      if (!face || face->cells != 1 || mesh.cell[face->outer.cell].body != group.body)
        complain(element, where + "is not on the boundary of " + body_names[group.body] +
                              "; allowed: faces of one of its cells");
      if (face->outer.named && face->outer.side != group.side)
        complain(element, where + "stands in another surface too; allowed: one of them");
      face->outer.named = true;
      face->outer.side = group.side;
    }
    if (face && !known && !element.groups.empty()) face->outer.other_group = element.groups.front();
    if (face && known && order == 2 && element.nodes.size() > 4) compare_middles(element);
  }

  /// The middles of a face's element are not used; where they differ from the cell's, the file means two
  /// things.
  void compare_middles(const GmshElement &element) const
  {
    for (int k = 4; k < static_cast<int>(element.nodes.size()); ++k) {
      std::vector<int> vertices;
      for (int v = 0; v < 4; ++v)
        if (k == 8 || v == k - 4 || v == (k - 3) % 4) vertices.push_back(vertex_of.at(element.nodes[v]));
      const auto found = mesh.middle.find(middle_key(vertices));
      if (found != mesh.middle.end())
        expect_same(element, vertices, file.nodes.at(element.nodes[k]), found->second);
    }
  }

  const GmshFile &file;
  Arrangement arrangement;
  int order;
  GmshBodies bodies;
  SerialMesh &mesh = bodies.mesh;
  std::map<long, int> vertex_of; ///< tags
  std::vector<int> body_of;      ///< vertices
  std::map<Face, KnownFace> faces;
  boost::disjoint_sets_with_storage<> parts; ///< of cells that are joined through faces
  std::vector<long> left_out;                ///< numbers of hexahedra
  bool curved = false;                       ///< a cell has middles
};

} // namespace

std::vector<SurfaceGroup> surface_groups(Arrangement arrangement)
{
  if (arrangement == Arrangement::single_gel)
    return {{"top_plate", Side::top_plate, bottom_body}, {"bottom_plate", Side::bottom_plate, bottom_body}};
  if (arrangement == Arrangement::gel_on_rigid)
    return {{"top_plate", Side::top_plate, top_body}, {"top_contact", Side::slave, top_body}};
  return {{"top_plate", Side::top_plate, top_body},
          {"bottom_plate", Side::bottom_plate, bottom_body},
          {"top_contact", Side::slave, top_body},
          {"bottom_contact", Side::master, bottom_body}};
}

std::vector<int> bodies_of(Arrangement arrangement)
{
  if (arrangement == Arrangement::gel_on_gel) return {bottom_body, top_body};
  return {arrangement == Arrangement::gel_on_rigid ? top_body : bottom_body};
}

std::array<int, 8> middle_key(const std::vector<int> &vertices)
{
  std::array<int, 8> key;
  key.fill(-1);
  std::copy(vertices.begin(), vertices.end(), key.begin());
  std::sort(key.begin(), key.end(), std::greater<>());
  return key;
}

GmshBodies bodies_of_gmsh(std::istream &stream, Arrangement arrangement, int order)
{
  const GmshFile file = read_gmsh(stream);
  return Builder(file, arrangement, order).build();
}

SerialMesh mesh_of_gmsh(std::istream &stream, Arrangement arrangement, int order)
{
  return bodies_of_gmsh(stream, arrangement, order).mesh;
}

} // namespace tribogel
