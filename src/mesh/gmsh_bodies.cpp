#include "mesh/gmsh_bodies.hpp"

#include "mesh/gmsh_groups.hpp"
#include "scene/parse.hpp"
#include "scene/user_error.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace tribogel
{

namespace
{

using Place = std::array<double, 3>;
using Face = std::array<int, 4>; ///< vertices, increasing

/// Corners in Gmsh's order, lexicographic.
constexpr int gmsh_corner[8] = {0, 1, 3, 2, 4, 5, 7, 6};

/// Of a hexahedron in Gmsh's order of corners: its edges and faces in Gmsh's order of nodes.
constexpr int gmsh_edge[12][2] = {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3},
                                  {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}};
constexpr int gmsh_face[6][4] = {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}};

constexpr const char *body_names[2] = {"bottom", "top"};

bool stands_in(const GmshElement &element, const char *group)
{
  return std::find(element.groups.begin(), element.groups.end(), group) != element.groups.end();
}

std::string in_words(const Place &X)
{
  return "(" + to_text(X[0]) + ", " + to_text(X[1]) + ", " + to_text(X[2]) + ")";
}

class Builder
{
public:
  Builder(const GmshFile &given, bool top, int element_order) : file(given), has_top(top), order(element_order)
  {
    mesh.dim = 3;
  }

  SerialMesh build()
  {
    expect_groups();
    for (const GmshElement &element : file.elements)
      if (element.dim == 3) add_cell(element);
    for (const GmshElement &element : file.elements)
      if (element.dim == 2) name_face(element);
    for (const auto &[face, known] : faces)
      if (known.cells == 1) mesh.boundary.push_back({known.around, known.named ? known.side : Side::wall});
    return std::move(mesh);
  }

private:
  struct KnownFace {
    Face around{}; ///< its vertices one after the other
    int cells = 0, body = 0;
    bool named = false;
    Side side = Side::wall;
  };

  /// What must be there, all of it in the refusal.
  void expect_groups() const
  {
    const auto expect = [&](int dim, const char *name) {
      for (const GmshElement &element : file.elements)
        if (element.dim == dim && stands_in(element, name)) return;
      throw UserError{no_such_group(file, dim, name) + "; allowed: " +
                      (has_top ? "volumes top and bottom, surfaces top_plate, bottom_plate, top_contact and "
                                 "bottom_contact"
                               : "with -specimens bottom volume bottom, surfaces top_plate and bottom_plate")};
    };
    expect(3, "bottom");
    if (has_top) expect(3, "top");
    for (const SurfaceGroup &group : surface_groups(has_top)) expect(2, group.name);
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
      complain(element,
               "shares node " + std::to_string(tag) +
                   " with the other body; allowed: bodies that have nodes of their own, also where they touch");
    return place->second;
  }

  /// Columns of the Jacobian's determinant at a corner: its three edges.
  double volume_at(const std::array<int, 8> &vertices, int corner) const
  {
    double edge[3][3];
    for (int j = 0; j < 3; ++j) {
      const Place &low = mesh.vertex[vertices[corner & ~(1 << j)]], &high = mesh.vertex[vertices[corner | 1 << j]];
      for (int i = 0; i < 3; ++i) edge[j][i] = high[i] - low[i];
    }
    double volume = 0;
    for (int i = 0; i < 3; ++i)
      volume +=
          edge[0][i] * (edge[1][(i + 1) % 3] * edge[2][(i + 2) % 3] - edge[1][(i + 2) % 3] * edge[2][(i + 1) % 3]);
    return volume;
  }

  void add_cell(const GmshElement &element)
  {
    const bool in[2] = {stands_in(element, "bottom"), has_top && stands_in(element, "top")};
    if (!in[0] && !in[1]) return;
    if (in[0] && in[1]) complain(element, "stands in top and in bottom; allowed: one of them");
    SerialMesh::Cell cell{{}, in[1] ? top_body : bottom_body, 0};
    std::array<int, 8> corner;
    double middle[2] = {};
    for (int v = 0; v < 8; ++v) {
      corner[v] = vertex(element, element.nodes[v], cell.body);
      for (int j = 0; j < 2; ++j) middle[j] += mesh.vertex[corner[v]][j];
    }
    cell.key = std::atan2(middle[1], middle[0]);
    for (int v = 0; v < 8; ++v) cell.vertex[v] = corner[gmsh_corner[v]];
    if (volume_at(cell.vertex, 0) < 0)
      for (int v : {1, 5}) std::swap(cell.vertex[v], cell.vertex[v + 1]);
    for (int v = 0; v < 8; ++v)
      if (!(volume_at(cell.vertex, v) > 0))
        complain(element,
                 "is degenerate or folded at " + in_words(mesh.vertex[cell.vertex[v]]) + "; allowed: convex hexahedra");
    mesh.cell.push_back(cell);
    for (const auto &local : gmsh_face) {
      KnownFace &face = faces[key({corner[local[0]], corner[local[1]], corner[local[2]], corner[local[3]]})];
      face.around = {corner[local[0]], corner[local[1]], corner[local[2]], corner[local[3]]};
      face.body = cell.body;
      if (++face.cells > 2) complain(element, "has a face that two others have; allowed: each cell once");
    }
    if (order == 2 && element.nodes.size() > 8) add_middles(element, corner);
  }

  static Face key(Face face)
  {
    std::sort(face.begin(), face.end());
    return face;
  }

  /// Of the 27 places those with two, four and eight corners; what an element of 20 nodes does not have is that of its
  /// serendipity shape functions.
  void add_middles(const GmshElement &element, const std::array<int, 8> &corner)
  {
    const auto node = [&](int k) { return file.nodes.at(element.nodes[k]); };
    const auto put = [&](const std::vector<int> &vertices, const Place &X) { mesh.middle[middle_key(vertices)] = X; };
    const bool whole = element.nodes.size() == 27;
    for (int e = 0; e < 12; ++e) put({corner[gmsh_edge[e][0]], corner[gmsh_edge[e][1]]}, node(8 + e));
    /// Corners by -1/4, edges by `weight`: 1/2 in a face, 1/4 in the cell.
    const auto blend = [&](const std::vector<int> &corners, double weight) {
      Place X{};
      const auto has = [&](int v) { return std::find(corners.begin(), corners.end(), v) != corners.end(); };
      const auto add = [&X](double w, const Place &x) {
        for (int i = 0; i < 3; ++i) X[i] += w * x[i];
      };
      for (const int v : corners) add(-0.25, node(v));
      for (int e = 0; e < 12; ++e)
        if (has(gmsh_edge[e][0]) && has(gmsh_edge[e][1])) add(weight, node(8 + e));
      return X;
    };
    for (int f = 0; f < 6; ++f) {
      const std::vector<int> local(gmsh_face[f], gmsh_face[f] + 4);
      std::vector<int> vertices;
      for (const int v : local) vertices.push_back(corner[v]);
      put(vertices, whole ? node(20 + f) : blend(local, 0.5));
    }
    put({corner.begin(), corner.end()}, whole ? node(26) : blend({0, 1, 2, 3, 4, 5, 6, 7}, 0.25));
  }

  void name_face(const GmshElement &element)
  {
    for (const SurfaceGroup &group : surface_groups(has_top)) {
      if (!stands_in(element, group.name)) continue;
      const std::string where = std::string("of ") + group.name + " ";
      Face vertices{};
      bool known = true;
      for (int v = 0; v < 4; ++v) {
        const auto found = vertex_of.find(element.nodes[v]);
        known = known && found != vertex_of.end();
        if (known) vertices[v] = found->second;
      }
      const auto face = known ? faces.find(key(vertices)) : faces.end();
      if (face == faces.end() || face->second.cells != 1 || face->second.body != group.body)
        complain(element, where + "is not on the boundary of " + body_names[group.body] +
                              "; allowed: faces of one of its cells");
      if (face->second.named && face->second.side != group.side)
        complain(element, where + "stands in another surface too; allowed: one of them");
      face->second.named = true;
      face->second.side = group.side;
    }
  }

  const GmshFile &file;
  bool has_top;
  int order;
  SerialMesh mesh;
  std::map<long, int> vertex_of; ///< tags
  std::vector<int> body_of;      ///< vertices
  std::map<Face, KnownFace> faces;
};

} // namespace

std::vector<SurfaceGroup> surface_groups(bool has_top)
{
  if (!has_top) return {{"top_plate", Side::top_plate, bottom_body}, {"bottom_plate", Side::bottom_plate, bottom_body}};
  return {{"top_plate", Side::top_plate, top_body},
          {"bottom_plate", Side::bottom_plate, bottom_body},
          {"top_contact", Side::slave, top_body},
          {"bottom_contact", Side::master, bottom_body}};
}

std::array<int, 8> middle_key(const std::vector<int> &vertices)
{
  std::array<int, 8> key;
  key.fill(-1);
  std::copy(vertices.begin(), vertices.end(), key.begin());
  std::sort(key.begin(), key.end(), std::greater<>());
  return key;
}

SerialMesh mesh_of_gmsh(std::istream &stream, bool has_top, int order)
{
  const GmshFile file = read_gmsh(stream);
  return Builder(file, has_top, order).build();
}

} // namespace tribogel
