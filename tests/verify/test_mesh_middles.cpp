/// Middles of hexahedra of second order that are somewhere else, or that two elements have at two places.
#include "checked_meshes.hpp"

#include "gmsh/hexahedron.hpp"

#include <functional>

namespace tribogel::test
{

namespace
{

/// Of the hexahedra in a file of second order, nodes and their positions as text in format 2.2.
std::string with_middles(const SerialMesh &mesh, int nodes,
                         const std::function<void(int, std::vector<X> &)> &change)
{
  std::ostringstream out;
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n6\n3 1 \"bottom\"\n3 2 \"top\"\n2 3 "
         "\"top_plate\"\n"
         "2 4 \"bottom_plate\"\n2 5 \"top_contact\"\n2 6 \"bottom_contact\"\n$EndPhysicalNames\n";
  std::ostringstream elements;
  std::vector<X> place(mesh.vertex);
  int tag = 0;
  for (const SerialMesh::Cell &cell : mesh.cell) {
    std::vector<X> given;
    for (const int v : gmsh_corner) given.push_back(mesh.vertex[cell.vertex[v]]);
    const auto whole = all_nodes(given);
    given.assign(whole.begin(), whole.begin() + nodes);
    change(++tag, given); // the middles of each cell are nodes of its own
    for (int v = 0; v < 8; ++v) place[cell.vertex[gmsh_corner[v]]] = given[v];
    elements << tag << (nodes == 20 ? " 17" : " 12") << " 2 " << cell.body + 1 << " 7";
    for (const int v : gmsh_corner) elements << " " << cell.vertex[v] + 1;
    for (int k = 8; k < nodes; ++k) {
      place.push_back(given[k]);
      elements << " " << place.size();
    }
    elements << "\n";
  }
  for (const SerialMesh::Facet &facet : mesh.boundary) {
    const int group = facet.side == Side::top_plate      ? 3
                      : facet.side == Side::bottom_plate ? 4
                      : facet.side == Side::slave        ? 5
                                                         : 6;
    elements << ++tag << " 3 2 " << group << " 7";
    for (const int v : {0, 1, 3, 2}) elements << " " << facet.vertex[v] + 1;
    elements << "\n";
  }
  out.precision(17);
  out << "$Nodes\n" << place.size() << "\n";
  for (std::size_t n = 0; n < place.size(); ++n)
    out << n + 1 << " " << place[n][0] << " " << place[n][1] << " " << place[n][2] << "\n";
  out << "$EndNodes\n$Elements\n" << tag << "\n" << elements.str() << "$EndElements\n";
  return out.str();
}

} // namespace

TEST(mesh_middles, RefuseEdgesWithTwoMiddles)
{
  const SerialMesh mesh = apart({lower, upper});
  const auto nothing = [](int, std::vector<X> &) {};
  expect_taken(judged(with_middles(mesh, 20, nothing), 2)); // of two nodes at one place
  expect_taken(judged(with_middles(mesh, 27, nothing), 2));
  // of element 1 the edge from (-2, -3, -2) to (-2, -2, -2), which element 2 has too
  const auto moved = [](int tag, std::vector<X> &node) {
    if (tag == 1) node[11][2] -= 0.1;
  };
  const std::vector<std::string> both{"element 2 has the middle of the edge from (-2, ", "at (-2, -2.5, -2)",
                                      "element 1 at (-2, -2.5, -2.1)", "one middle"};
  expect_refused(judged(with_middles(mesh, 20, moved), 2), both);
  expect_refused(judged(with_middles(mesh, 27, moved), 2), both);
  expect_taken(judged(with_middles(mesh, 20, moved), 1)); // which has none
  // A cell of eight nodes beside such of twenty: its edges are straight
  const auto straight = [&](const std::string &text) {
    std::istringstream lines(text);
    std::string result;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("1 17 2 ")) {
        std::istringstream words("1 5" + line.substr(4));
        line.clear();
        std::string word;
        for (int k = 0; k < 13 && words >> word; ++k) line += word + " ";
      }
      result += line + "\n";
    }
    return result;
  };
  const auto bulging = [](int tag, std::vector<X> &node) {
    if (tag == 2) node[9][2] -= 0.1; // the same edge
  };
  expect_taken(judged(straight(with_middles(mesh, 20, nothing)), 2));
  expect_refused(judged(straight(with_middles(mesh, 20, bulging)), 2),
                 {"element 2 has the middle of the edge from (-2, ", "element 1 at (-2, -2.5, -2)"});
  const auto face = [](int tag, std::vector<X> &node) {
    if (tag == 1) node[23][0] += 0.05; // x = -2
  };
  expect_refused(judged(with_middles(mesh, 27, face), 2),
                 {"element 2 has the middle of the face at (-2, ", "element 1 at (-1.95, -2.5, -1.5)"});
}

/// The elements of faces have middles too.
TEST(mesh_middles, RefuseFacesWithOtherMiddles)
{
  const SerialMesh mesh = apart({lower, upper});
  const std::string good = GmshWriter(mesh, Arrangement::gel_on_gel, 27).format_2();
  expect_taken(judged(good, 2));
  const auto face = good.find(" 10 2 3 7 "), end = good.find('\n', face);
  for (int k = 0; k < 5; ++k) { // its nodes from the last one, which is the face's
    std::string text = good;
    std::size_t to = end;
    for (int back = 0; back < k; ++back) to = text.rfind(' ', to - 1);
    const std::size_t from = text.rfind(' ', to - 1);
    text.replace(from, to - from, " 1");
    expect_refused(judged(text, 2),
                   {k == 0 ? "has the middle of the face at" : "has the middle of the edge from"});
    expect_taken(judged(text, 1));
  }
}

/// Three cells beside six on a curved face, where they share every other node: of order 1 the six are a
/// little apart from the three, but their nodes between are on the middles of the three's edges.
TEST(mesh_middles, RefuseNodesThatHangOnMiddles)
{
  const auto slab = [](double left, double right, int cells) {
    return std::pair(bottom_body,
                     Box{{even(left, right, 3), even(-3, 3, cells), even(-2, 0, 2)}, lower_sides});
  };
  const auto curved = [](const X &x) { return X{x[0] + 0.03 * (9 - x[1] * x[1]), x[1], x[2]}; };
  const SerialMesh mesh = welded(apart({slab(-3, 0, 3), slab(0, 3, 6), upper}));
  const std::string text = with_middles(mesh, 20, [&](int, std::vector<X> &node) {
    for (X &x : node) x = curved(x);
  });
  expect_warned(judged(text, 1), {"parts that are not joined, or a slit"});
  // on three heights of corners, three of the six edges' middles
  expect_refused(judged(text, 2), {"nodes of bottom lie on other nodes of it (18, e.g."});
}

TEST(mesh_middles, RefuseMiddlesThatAreNotThere)
{
  const SerialMesh mesh = apart({lower, upper});
  const auto change = [&](int k, X to) {
    return with_middles(mesh, 27, [&](int tag, std::vector<X> &node) {
      if (tag == 1) node[k] = to;
    });
  };
  expect_refused(judged(change(8, {0, 0, 0}), 2),
                 {"element 1 has the middle of an edge at (0, 0, 0), 4.3875 mm from "
                  "(-2.5, -3, -2), where its other nodes put it"});
  expect_taken(judged(change(8, {0, 0, 0}), 1));
  expect_refused(judged(change(8, {-2.25, -3, -2}), 2),
                 {"element 1 has the middle of an edge at (-2.25, -3, -2)"});
  expect_taken(judged(change(8, {-2.5, -3.1, -2}), 2)); // curved, on the free wall
  expect_refused(judged(change(26, {-2.3, -2.5, -1.5}), 2),
                 {"element 1 has the middle of the cell at (-2.3, -2.5, "});
  // So curved that it goes through the opposite edge: 0.3 mm where the cell is 0.2 mm wide
  const SerialMesh thin =
      apart({{bottom_body, {{even(-3, 3, 6), even(-3, 3, 30), even(-2, 0, 2)}, lower_sides}}, upper});
  const auto bulging = [](int tag, std::vector<X> &node) {
    if (tag == 1) node[8][1] += 0.3;
  };
  expect_refused(judged(with_middles(thin, 20, bulging), 2),
                 {"element 1 is degenerate or folded at (-2.5, ",
                  "the middle of an edge at (-2.5, -2.7, -2), 0.3 mm from"});
}

/// Edges in the order of Abaqus' C3D20 (and of CalculiX, Ansys, VTK) and of Exodus' HEX20 (Nastran, libMesh),
/// from their manuals.
TEST(mesh_middles, NameTheProgramWhoseOrderItIs)
{
  SerialMesh mesh = apart({lower, upper});
  for (auto &x : mesh.vertex) x = {x[0] + 0.2 * x[2], x[1], x[2]};
  using Edges = std::array<std::array<int, 2>, 12>;
  const Edges abaqus{
      {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}},
      exodus{
          {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 5}, {2, 6}, {3, 7}, {4, 5}, {5, 6}, {6, 7}, {7, 4}}};
  const auto in_order = [&](const Edges &edges, int nodes) {
    return with_middles(mesh, nodes, [&](int, std::vector<X> &node) {
      for (int e = 0; e < 12; ++e)
        for (int i = 0; i < 3; ++i) node[8 + e][i] = (node[edges[e][0]][i] + node[edges[e][1]][i]) / 2;
    });
  };
  for (const int nodes : {20, 27}) {
    expect_refused(judged(in_order(abaqus, nodes), 2), {"in the order of Abaqus, CalculiX, Ansys and VTK"});
    expect_refused(judged(in_order(exodus, nodes), 2), {"in the order of Exodus, Nastran and libMesh"});
    expect_taken(judged(in_order(abaqus, nodes), 1));
  }
  SerialMesh one = mesh; // whose edges are in nobody's order
  EXPECT_EQ(judged(with_middles(one, 20, [](int, std::vector<X> &node) { std::swap(node[8], node[19]); }), 2)
                .refusal.find("in the order of Abaqus"),
            std::string::npos);
}

} // namespace tribogel::test
