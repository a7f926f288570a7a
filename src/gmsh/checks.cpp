#include "gmsh/checks.hpp"

#include "gmsh/outer_face.hpp"
#include "support/user_error.hpp"
#include "tribogel/contact/surface/search.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace tribogel
{

namespace
{

/// How far outside of a face its neighbour is looked for, over the face's size: what lies nearer is on the
/// face; what lies nearer than the second is so near that the mesh cannot tell whether it will touch.
constexpr double touching = 1e-3, close_by = 0.1;

using quad_search::Box;
using quad_search::Corner;

constexpr const char *how_to_join =
    "; allowed: one node where cells of a body meet (in Gmsh: BooleanFragments of the volumes of this body "
    "before "
    "meshing, or gmsh.model.mesh.removeDuplicateNodes for them; Coherence Mesh would join top and "
    "bottom where they touch, too)";

Corner corner_at(const Place &X)
{
  return {X[0], X[1], X[2]};
}

/// Whether the place is in the cell, whose edges are straight: the inverse of its map by Newton's method.
bool is_in(const SerialMesh &mesh, const SerialMesh::Cell &cell, const Place &X)
{
  Eigen::Vector3d xi = Eigen::Vector3d::Zero();
  for (int iteration = 0; iteration < 20; ++iteration) {
    const auto shape = tensor_shape<3, 1>({xi[0], xi[1], xi[2]});
    Eigen::Vector3d rest(X[0], X[1], X[2]);
    Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
    for (int a = 0; a < 8; ++a) {
      const Eigen::Vector3d x(mesh.vertex[cell.vertex[a]].data());
      rest -= shape.N[a] * x;
      for (int j = 0; j < 3; ++j) slope.col(j) += shape.dN[a][j] * x;
    }
    const Eigen::Vector3d step = slope.inverse() * rest;
    xi += step;
    if (!(xi.lpNorm<Eigen::Infinity>() < 10)) return false; // far outside
    if (step.lpNorm<Eigen::Infinity>() < 1e-9) break;
  }
  return xi.lpNorm<Eigen::Infinity>() <= 1;
}

/// Nodes on the boundary of the body that lie on another one of it. A corner on the middle of an edge hangs.
void expect_single_nodes(const GmshBodies &bodies, int body)
{
  const SerialMesh &mesh = bodies.mesh;
  struct Known {
    Place X;
    double edge; ///< the shortest there
  };
  std::map<std::array<int, 8>, Known> nodes;
  const auto add = [&](const std::vector<int> &vertices, const Place &X, double edge) {
    Known &known = nodes.try_emplace(middle_key(vertices), Known{X, edge}).first->second;
    known.edge = std::min(known.edge, edge);
  };
  for (const OuterFace &face : bodies.outer) {
    if (mesh.cell[face.cell].body != body) continue;
    for (int v = 0; v < 4; ++v) {
      const int a = face.around[v], b = face.around[(v + 1) % 4];
      const double edge = distance(mesh.vertex[a], mesh.vertex[b]);
      for (const int end : {a, b}) add({end}, mesh.vertex[end], edge);
      if (const auto middle = mesh.middle.find(middle_key({a, b})); middle != mesh.middle.end())
        add({a, b}, middle->second, edge);
    }
  }
  std::vector<const Known *> known;
  std::vector<std::pair<Box, int>> boxes;
  for (const auto &[key, node] : nodes) {
    boxes.emplace_back(Box(corner_at(node.X), corner_at(node.X)), static_cast<int>(known.size()));
    known.push_back(&node);
  }
  const quad_search::Tree tree(boxes);
  std::set<int> doubled;
  for (auto [box, k] : boxes) {
    quad_search::inflate(box, same_place * known[k]->edge);
    for (auto it = tree.qbegin(boost::geometry::index::intersects(box)); it != tree.qend(); ++it)
      if (it->second != k) doubled.insert({k, it->second});
  }
  if (!doubled.empty())
    throw UserError{std::string("nodes of ") + body_names[body] + " lie on other nodes of it (" +
                    in_number(doubled.size()) + "that at " + in_words(known[*doubled.begin()]->X) +
                    "), so that its parts are not joined there" + how_to_join};
}

/// Whether each corner of the face is a corner of the cell too, in place.
bool matches(const SerialMesh &mesh, const OuterFace &face, const SerialMesh::Cell &cell)
{
  const double tolerance = touching * std::sqrt(length(area_vector(mesh, face)));
  return std::all_of(face.around.begin(), face.around.end(), [&](int v) {
    return std::any_of(cell.vertex.begin(), cell.vertex.end(),
                       [&](int w) { return distance(mesh.vertex[v], mesh.vertex[w]) <= tolerance; });
  });
}

} // namespace

std::vector<Touch> touches_of(const GmshBodies &bodies)
{
  const SerialMesh &mesh = bodies.mesh;
  std::vector<std::pair<Box, int>> boxes;
  for (std::size_t c = 0; c < mesh.cell.size(); ++c) {
    Box box;
    boost::geometry::assign_inverse(box);
    for (const int v : mesh.cell[c].vertex) boost::geometry::expand(box, corner_at(mesh.vertex[v]));
    boxes.emplace_back(box, static_cast<int>(c));
  }
  const quad_search::Tree tree(boxes);
  const auto cell_at = [&](const Place &X, int own) {
    for (auto it = tree.qbegin(boost::geometry::index::intersects(corner_at(X))); it != tree.qend(); ++it)
      if (it->second != own && is_in(mesh, mesh.cell[it->second], X)) return it->second;
    return -1;
  };
  std::vector<Touch> touches;
  for (std::size_t f = 0; f < bodies.outer.size(); ++f) {
    const OuterFace &face = bodies.outer[f];
    const Place normal = area_vector(mesh, face);
    const double size = std::sqrt(length(normal)); // of the face; the normal is its square long
    int found = -1;
    for (const double away : {touching, close_by})
      for (const auto &[xi, eta] : {std::array{0.25, 0.25}, {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}}) {
        if (found >= 0) continue;
        found = cell_at(plus(on_face(mesh, face, xi, eta), away / size, normal), face.cell);
        if (found >= 0) touches.push_back({static_cast<int>(f), found, away == touching});
      }
  }
  return touches;
}

void expect_joined(GmshBodies &bodies, const std::vector<Touch> &touches)
{
  const SerialMesh &mesh = bodies.mesh;
  for (const int body : {bottom_body, top_body}) {
    std::vector<Touch> matching, others, slits;
    for (const Touch &touch : touches) {
      const OuterFace &face = bodies.outer[touch.face];
      if (mesh.cell[face.cell].body != body || mesh.cell[touch.cell].body != body) continue;
      (!touch.near ? slits : matches(mesh, face, mesh.cell[touch.cell]) ? matching : others).push_back(touch);
    }
    const auto on_element = [&](const Touch &touch) {
      return example(bodies, bodies.outer[touch.face]) + " on element " +
             std::to_string(bodies.element[touch.cell]);
    };
    const std::string of_body = std::string(" of ") + body_names[body];
    if (!others.empty())
      throw UserError{
          "faces" + of_body + " lie on or in other cells of it that do not have these faces (" +
          in_number(others.size()) + on_element(others.front()) +
          "): meshes that do not match (hanging nodes) or that overlap; allowed: cells that have whole "
          "faces in common (in Gmsh: BooleanFragments of the volumes of this body before meshing)"};
    if (!matching.empty())
      throw UserError{"faces" + of_body + " lie on other faces of it with nodes of their own (" +
                      in_number(matching.size()) + on_element(matching.front()) +
                      "), so that its parts are not joined there" + how_to_join};
    expect_single_nodes(bodies, body);
    if (!slits.empty())
      bodies.warnings.push_back("faces" + of_body +
                                " lie within a tenth of their size of other cells of it (" +
                                in_number(slits.size()) + on_element(slits.front()) +
                                "): parts that are not joined, or a slit whose sides do not feel each other");
  }
}

void expect_held(GmshBodies &bodies, Arrangement arrangement)
{
  const SerialMesh &mesh = bodies.mesh;
  std::set<int> held[side_count]; // parts
  for (const OuterFace &face : bodies.outer) held[static_cast<int>(face.side)].insert(bodies.part[face.cell]);
  const auto on_plate = [&](Side plate, std::size_t c) {
    return held[static_cast<int>(plate)].count(bodies.part[c]) > 0;
  };
  const auto place = [&](std::size_t c) {
    Place X{};
    for (const int v : mesh.cell[c].vertex) X = plus(X, 1. / 8, mesh.vertex[v]);
    return "element " + std::to_string(bodies.element[c]) + " at " + in_words(X);
  };
  std::vector<std::size_t> loose, on_one;
  for (std::size_t c = 0; c < mesh.cell.size(); ++c) {
    const bool below = on_plate(Side::bottom_plate, c), above = on_plate(Side::top_plate, c);
    if (!below && !above)
      loose.push_back(c);
    else if (arrangement == Arrangement::single_gel && below != above)
      on_one.push_back(c);
  }
  if (!loose.empty()) {
    const int body = mesh.cell[loose.front()].body;
    throw UserError{std::string("cells of ") + body_names[body] + " are held by no plate (" +
                    in_number(loose.size()) + place(loose.front()) +
                    "): no chain of whole faces joins them to one of " +
                    (arrangement == Arrangement::single_gel ? "bottom_plate or top_plate"
                     : body == top_body                     ? "top_plate"
                                                            : "bottom_plate") +
                    "; allowed: parts with a face on their plate"};
  }
  if (!on_one.empty())
    bodies.warnings.push_back("cells are joined to one plate only and bear nothing (" +
                              in_number(on_one.size()) + place(on_one.front()) + ")");
}

void expect_apart(GmshBodies &bodies, const std::vector<Touch> &touches)
{
  const SerialMesh &mesh = bodies.mesh;
  std::vector<const OuterFace *> nameless, meant;
  for (const Touch &touch : touches) {
    const OuterFace &face = bodies.outer[touch.face];
    if (!touch.near || face.named || mesh.cell[face.cell].body == mesh.cell[touch.cell].body) continue;
    (face.other_group.empty() ? nameless : meant).push_back(&face);
  }
  const auto text = [&](const std::vector<const OuterFace *> &faces) {
    const int body = mesh.cell[faces.front()->cell].body;
    const auto count = std::count_if(faces.begin(), faces.end(), [&](const OuterFace *face) {
      return mesh.cell[face->cell].body == body;
    });
    return std::string("faces of ") + body_names[body] + " in no contact surface lie on or in " +
           body_names[1 - body] + " (" + in_number(static_cast<std::size_t>(count)) +
           example(bodies, *faces.front()) + "): the gels pass through each other there";
  };
  if (!nameless.empty())
    throw UserError{text(nameless) +
                    "; allowed: bodies that touch with top_contact and bottom_contact, or, where they "
                    "are meant not to feel each other, a physical surface of another name"};
  if (!meant.empty()) bodies.warnings.push_back(text(meant));
}

} // namespace tribogel
