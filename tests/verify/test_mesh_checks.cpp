/// Faults of Gmsh meshes that a solver would take in silence: parts that are not joined or not held, faces
/// that their groups lack. Counts, areas and places are by hand.
#include "checked_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

namespace tribogel::test
{

namespace
{

/// A box of the bottom body between these x and z, 6 mm wide along y.
std::pair<int, Box> slab(double left, double right, double low, double high, int cells_along_y = 6)
{
  Sides sides{};
  if (low == -2) sides[4] = Side::bottom_plate;
  if (high == 0) sides[5] = Side::master;
  return {bottom_body,
          {{even(left, right, std::max(1, static_cast<int>(right - left))), even(-3, 3, cells_along_y),
            even(low, high, std::max(1, static_cast<int>(high - low)))},
           sides}};
}

/// Without the faces of this side whose centres the condition holds for.
SerialMesh without(SerialMesh mesh, Side side, const std::function<bool(const X &)> &condition)
{
  std::erase_if(mesh.boundary, [&](const SerialMesh::Facet &facet) {
    X centre{};
    for (const int v : facet.vertex)
      for (int i = 0; i < 3; ++i) centre[i] += mesh.vertex[v][i] / 4;
    return facet.side == side && condition(centre);
  });
  return mesh;
}

/// Puts these faces into the physical surface `name`, number 7.
std::string with_group(const SerialMesh &all, const SerialMesh &fewer, const std::string &name)
{
  std::string text = GmshWriter(all, Arrangement::gel_on_gel, 8).format_2();
  const std::string names = "$PhysicalNames\n6\n";
  text.replace(text.find(names), names.size(), "$PhysicalNames\n7\n2 7 \"" + name + "\"\n");
  std::istringstream lines(text), left(GmshWriter(fewer, Arrangement::gel_on_gel, 8).format_2());
  std::set<std::string> kept;
  const auto nodes = [](const std::string &line) {
    return line.substr(line.find(" 3 2 ") + 5);
  }; // group and nodes
  for (std::string line; std::getline(left, line);)
    if (line.find(" 3 2 ") != std::string::npos) kept.insert(nodes(line));
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    const auto at = line.find(" 3 2 ");
    if (at != std::string::npos && !kept.count(nodes(line))) line.replace(at, 6, " 3 2 7");
    result += line + "\n";
  }
  return result;
}

} // namespace

TEST(mesh_checks, SayWhichPartsAreNotJoined)
{
  expect_taken(judged(apart({lower, upper})));
  const SerialMesh layers = apart({slab(-3, 3, -2, -1), slab(-3, 3, -1, 0), upper});
  expect_taken(judged(welded(layers)));
  // 6 x 6 faces of either layer
  expect_refused(judged(layers),
                 {"faces of bottom lie on other faces of it with nodes of their own (72, e.g. that of "
                  "element 1 at (-2.5, -2.5, -1) on element 37)",
                  "gmsh.model.mesh.removeDuplicateNodes"});
  const SerialMesh halves = apart({slab(-3, 0, -2, 0), slab(0, 3, -2, 0), upper});
  expect_taken(judged(welded(halves)));
  expect_refused(judged(halves), {"of bottom lie on other faces of it", "(24, e.g."}); // 6 x 2 of either half
  SerialMesh digits = halves; // as a file of seven digits has it
  for (std::size_t v = 0; v < digits.vertex.size(); ++v) digits.vertex[v][0] += v % 3 * 1e-6;
  expect_refused(judged(digits), {"of bottom lie on other faces of it", "(24, e.g."});
  expect_refused(judged(apart({slab(-3, 0, -2, 0), slab(0.0005, 3, -2, 0), upper})),
                 {"lie on other faces of it"});
  expect_warned(judged(apart({slab(-3, 0, -2, 0), slab(0.01, 3, -2, 0), upper})),
                {"(24, e.g.", "a slit whose sides"});
  expect_taken(judged(apart({slab(-3, 0, -2, 0), slab(0.5, 3, -2, 0), upper}))); // two gels on one plate
}

TEST(mesh_checks, SayWhereMeshesDoNotMatch)
{
  const std::vector<std::string> hanging{"of bottom lie on or in other cells of it", "hanging nodes"};
  const SerialMesh mesh = apart({slab(-3, 0, -2, 0, 3), slab(0, 3, -2, 0, 6), upper});
  expect_refused(judged(mesh), hanging);
  expect_refused(judged(welded(mesh)), hanging); // every other node is one
  expect_refused(judged(apart({slab(-3, 0.4, -2, 0), slab(0, 3, -2, 0), upper})),
                 {"of bottom lie on or in", "overlap"});
  expect_refused(judged(apart({lower, lower, upper})), {"nodes of bottom lie on other nodes of it"});
  // Only the edge x = 0, z = 0 of either lies on the other's, which is bent away below it
  SerialMesh edge = apart({slab(-3, 0, -2, 0), slab(0.1, 3, -2, 0), upper});
  for (auto &x : edge.vertex)
    if (x[0] == 0.1) x[0] *= -x[2];
  expect_refused(judged(edge), {"nodes of bottom lie on other nodes of it (14, e.g. that at (0, -3, 0))"});
}

/// The same cell twice, and two cells on one side of the face that they share.
TEST(mesh_checks, RefuseCellsThatOverlap)
{
  SerialMesh twice = apart({{bottom_body, {{even(0, 1, 1), even(0, 1, 1), even(-1, 0, 1)}, lower_sides}},
                            {top_body, {{even(0, 1, 1), even(0, 1, 1), even(0, 1, 1)}, upper_sides}}});
  twice.cell.push_back(twice.cell[0]);
  expect_refused(judged(twice), {"element 3 and element 1 overlap"});
  SerialMesh folded = twice;
  for (int v = 4; v < 8; ++v) { // a lower one inside
    folded.cell[2].vertex[v] = static_cast<int>(folded.vertex.size());
    const auto &x = folded.vertex[twice.cell[0].vertex[v]];
    folded.vertex.push_back({x[0], x[1], x[2] - 0.5});
  }
  expect_refused(judged(folded), {"element 3 and element 1 overlap"});
}

TEST(mesh_checks, RefusePartsThatNoPlateHolds)
{
  const SerialMesh loose = apart({lower, slab(5, 6, -1, 0, 1), upper});
  expect_refused(judged(loose),
                 {"cells of bottom are held by no plate (element 73 at (5.5, 0, -0.5))", "bottom_plate"});
  expect_taken(judged(apart({lower, slab(5, 6, -2, 0, 1), upper})));
  // A hinge: it hangs on the edge x = 3, z = 0 of the others, or on one corner
  expect_refused(judged(welded(apart({slab(-3, 3, -2, 0), slab(3, 4, 0, 1), upper}))),
                 {"cells of bottom are held by no plate (6, e.g. element 73"});
  const std::pair<int, Box> at_corner{bottom_body, {{even(3, 4, 1), even(3, 4, 1), even(0, 1, 1)}, {}}};
  expect_refused(judged(welded(apart({lower, at_corner, upper}))),
                 {"cells of bottom are held by no plate (element 73"});
}

/// One gel between both plates, and a block that only one of them holds.
TEST(mesh_checks, WarnOfPartsThatBearNothing)
{
  const Sides both{none, none, none, none, Side::bottom_plate, Side::top_plate};
  const std::pair<int, Box> gel{bottom_body, {{even(-1, 1, 2), even(-1, 1, 2), even(-2, 0, 2)}, both}};
  const std::pair<int, Box> block{
      bottom_body,
      {{even(2, 3, 1), even(0, 1, 1), even(-2, -1, 1)}, {none, none, none, none, Side::bottom_plate}}};
  expect_taken(judged(GmshWriter(apart({gel}), Arrangement::single_gel, 8).format_2(), 1, 0.5,
                      Arrangement::single_gel));
  const SerialMesh fewer = without(apart({gel}), Side::top_plate, [](const X &x) { return x[0] > 0; });
  expect_refused(
      judged(GmshWriter(fewer, Arrangement::single_gel, 8).format_2(), 1, 0.5, Arrangement::single_gel),
      {"top_plate lacks faces of bottom: 2 mm^2, 50 %"});
  expect_warned(judged(GmshWriter(apart({gel, block}), Arrangement::single_gel, 8).format_2(), 1, 0.5,
                       Arrangement::single_gel),
                {"cells are joined to one plate only and bear nothing (element 9 at (2.5, 0.5, -1.5))"});
}

TEST(mesh_checks, WarnOfHexahedraThatAreLeftOut)
{
  std::string text =
      GmshWriter(apart({lower, slab(5, 6, -2, 0, 1), upper}), Arrangement::gel_on_gel, 8).format_2();
  for (const std::string tag : {"73", "74"}) { // the slab's
    const auto at = text.find("\n" + tag + " 5 2 1 7 ");
    ASSERT_NE(at, std::string::npos);
    text.replace(at, 10 + tag.size(), "\n" + tag + " 5 2 9 7 ");
  }
  std::string fewer; // and its faces
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto at = line.find(" 3 2 ");
    const bool of_slab = at != std::string::npos && std::stoi(line.substr(line.rfind(' '))) > 147 &&
                         std::stoi(line.substr(line.rfind(' '))) <= 147 + 12;
    if (of_slab) line.replace(at, 6, " 3 2 9");
    fewer += line + "\n";
  }
  expect_warned(judged(fewer),
                {"hexahedra that are not in the physical volumes top and bottom are left out (2, e.g. "
                 "element 73)"});
}

TEST(mesh_checks, SayWhatPlatesLack)
{
  const SerialMesh all = apart({lower, upper});
  const auto corner = [](const X &x) { return x[0] > 1 && x[1] > 0; };
  const SerialMesh fewer = without(all, Side::top_plate, corner); // 1 x 2 mm of 4 x 4
  expect_refused(judged(fewer),
                 {"top_plate lacks faces of top: 2 mm^2, 12.5 %", "(2, e.g. that of element", "plane"});
  expect_warned(judged(with_group(all, fewer, "free")),
                {"top_plate lacks faces of top: 2 mm^2, 12.5 %", "physical surface 'free'"});
  expect_refused(judged(without(all, Side::bottom_plate, corner)),
                 {"bottom_plate lacks faces of bottom: 6 mm^2"});
}

TEST(mesh_checks, SayWhatContactFacesLack)
{
  const SerialMesh all = apart({lower, upper});
  const auto middle = [](const X &x) { return std::abs(x[0]) < 1 && std::abs(x[1]) < 1; };
  const auto rim = [](const X &x) { return x[0] > 1; };
  for (const auto &[where, area] :
       {std::pair<bool (*)(const X &), const char *>{middle, "4 mm^2, 25 %"}, {rim, "4 mm^2, 25 %"}}) {
    const SerialMesh fewer = without(all, Side::slave, where);
    expect_refused(judged(fewer), {std::string("top_contact lacks faces of top: ") + area});
    expect_warned(judged(with_group(all, fewer, "free")),
                  {std::string("top_contact lacks faces of top: ") + area});
  }
  expect_refused(judged(without(all, Side::master, middle)),
                 {"bottom_contact lacks faces of bottom: 4 mm^2"});
  // What the top does not reach, it may come to when it spreads
  const auto outside = [](const X &x) { return std::hypot(x[0], x[1]) > 2.9; };
  expect_warned(judged(without(all, Side::master, outside)), {"bottom_contact lacks faces of bottom: "});
}

/// A lens whose contact faces end at some radius: nothing is said of what does not come down to the other
/// gel.
TEST(mesh_checks, TakeALensOfWhichSomeIsContact)
{
  SerialMesh lens = apart({lower, upper});
  for (std::size_t v = 0; v < lens.vertex.size(); ++v) {
    auto &x = lens.vertex[v];
    if (v >= 147) x[2] += (x[0] * x[0] + x[1] * x[1]) / 10 * (2 - x[2]) / 2; // 7 x 7 x 3 are of the lower box
  }
  expect_taken(judged(lens));
  // Twelve of the sixteen faces have their lowest vertex at r^2 = 1, 0.1 mm up, and at most r^2 = 2, 0.2 mm
  const auto outside = [](const X &x) { return std::max(std::abs(x[0]), std::abs(x[1])) > 1; };
  const SerialMesh part = without(lens, Side::slave, outside);
  expect_taken(judged(part, 1, 0.05));
  expect_warned(judged(part, 1, 0.5),
                {"top_contact lacks faces of top", "(12, e.g.", "may come as near as that"});
  // A hole in the middle is surrounded
  expect_refused(
      judged(without(lens, Side::slave, [](const X &x) { return x[0] * x[0] + x[1] * x[1] < 1; }), 1, 0.05),
      {"top_contact lacks faces of top", "(4, e.g."});
}

/// A tub with the top gel in it: a wall of each touches the other's, and nobody says so.
TEST(mesh_checks, RefuseWallsThatTouch)
{
  std::pair<int, Box> side{bottom_body, {{even(2, 3, 1), even(-3, 3, 6), even(0, 1, 1)}, {Side::master}}},
      gel = upper;
  gel.second.sides[1] = Side::slave;
  SerialMesh tub = welded(apart({lower, side, gel}));
  tub = without(tub, Side::master, [](const X &x) { return x[0] > 2; }); // below the side
  const auto wall = [](const X &x) { return x[0] == 2; };
  const SerialMesh silent = without(without(tub, Side::master, wall), Side::slave, wall);
  EXPECT_EQ(judged(tub).refusal, "");
  expect_refused(judged(silent),
                 {"faces of bottom in no contact surface lie on or in top (4, e.g. that of element"});
  expect_warned(judged(with_group(tub, silent, "free")), {"in no contact surface lie on or in"});
}

} // namespace tribogel::test
