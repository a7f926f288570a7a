/// Two boxes as the bodies of a Gmsh file, and what is said of such files.
#pragma once

#include "boxes.hpp"
#include "gmsh_writer.hpp"

#include "gmsh/checks.hpp"
#include "support/user_error.hpp"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

namespace tribogel::test
{

using X = std::array<double, 3>;

/// Boxes of either body in one mesh, each with nodes of its own.
inline SerialMesh apart(const std::vector<std::pair<int, Box>> &boxes)
{
  SerialMesh mesh;
  mesh.dim = 3;
  for (const auto &[body, box] : boxes) {
    const SerialMesh part = box.mesh();
    const auto shift = static_cast<int>(mesh.vertex.size());
    mesh.vertex.insert(mesh.vertex.end(), part.vertex.begin(), part.vertex.end());
    for (SerialMesh::Cell cell : part.cell) {
      for (int &v : cell.vertex) v += shift;
      cell.body = body;
      mesh.cell.push_back(cell);
    }
    for (SerialMesh::Facet facet : part.boundary) {
      for (int &v : facet.vertex) v += shift;
      mesh.boundary.push_back(facet);
    }
  }
  return mesh;
}

/// The same with one node where those of a body coincide.
inline SerialMesh welded(SerialMesh mesh)
{
  std::map<std::pair<int, X>, int> first;
  std::vector<int> of(mesh.vertex.size());
  for (SerialMesh::Cell &cell : mesh.cell)
    for (int &v : cell.vertex) v = of[v] = first.try_emplace({cell.body, mesh.vertex[v]}, v).first->second;
  for (SerialMesh::Facet &facet : mesh.boundary)
    for (int &v : facet.vertex) v = of[v];
  std::vector<int> kept(mesh.vertex.size(), -1); // without the others
  std::vector<X> vertex;
  for (SerialMesh::Cell &cell : mesh.cell)
    for (int &v : cell.vertex) {
      if (kept[v] < 0) {
        kept[v] = static_cast<int>(vertex.size());
        vertex.push_back(mesh.vertex[v]);
      }
      v = kept[v];
    }
  for (SerialMesh::Facet &facet : mesh.boundary)
    for (int &v : facet.vertex) v = kept[v];
  mesh.vertex = vertex;
  return mesh;
}

inline const std::optional<Side> none;
using Sides = std::array<std::optional<Side>, 6>;
inline const Sides lower_sides{none, none, none, none, Side::bottom_plate, Side::master};
inline const Sides upper_sides{none, none, none, none, Side::slave, Side::top_plate};

/// Above z = 0, 4 mm wide and 2 mm high.
inline const std::pair<int, Box> upper{top_body,
                                       {{even(-2, 2, 4), even(-2, 2, 4), even(0, 2, 2)}, upper_sides}};
inline const std::pair<int, Box> lower{bottom_body,
                                       {{even(-3, 3, 6), even(-3, 3, 6), even(-2, 0, 2)}, lower_sides}};

struct Verdict {
  std::string refusal;
  std::vector<std::string> warnings;
};

inline Verdict judged(const std::string &text, int order = 1, double travel = 0.5,
                      Arrangement arrangement = Arrangement::gel_on_gel)
{
  std::istringstream stream(text);
  try {
    GmshBodies bodies = bodies_of_gmsh(stream, arrangement, order);
    const std::vector<Touch> touches = touches_of(bodies);
    expect_joined(bodies, touches);
    expect_held(bodies, arrangement);
    expect_whole_groups(bodies, arrangement, travel);
    expect_apart(bodies, touches);
    return {"", bodies.warnings};
  } catch (const UserError &error) {
    return {error.text, {}};
  }
}

inline Verdict judged(const SerialMesh &mesh, int order = 1, double travel = 0.5)
{
  return judged(GmshWriter(mesh, Arrangement::gel_on_gel, 8).format_2(), order, travel);
}

inline void expect_refused(const Verdict &verdict, const std::vector<std::string> &parts)
{
  for (const std::string &part : parts)
    EXPECT_NE(verdict.refusal.find(part), std::string::npos) << part << " is not in: " << verdict.refusal;
  EXPECT_NE(verdict.refusal.find("; allowed: "), std::string::npos) << verdict.refusal;
  EXPECT_EQ(verdict.refusal.find('\n'), std::string::npos);
}

inline void expect_taken(const Verdict &verdict)
{
  EXPECT_EQ(verdict.refusal, "");
  EXPECT_TRUE(verdict.warnings.empty()) << verdict.warnings.front();
}

inline void expect_warned(const Verdict &verdict, const std::vector<std::string> &parts)
{
  EXPECT_EQ(verdict.refusal, "");
  std::string all;
  for (const std::string &warning : verdict.warnings) all += warning + "\n";
  for (const std::string &part : parts)
    EXPECT_NE(all.find(part), std::string::npos) << part << " is not in: " << all;
}

} // namespace tribogel::test
