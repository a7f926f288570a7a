/// A mesh's digest is the same for the same mesh, however its file is written, and another for all that a run
/// sees.
#include "gmsh_texts.hpp"

#include "mesh/digest.hpp"

namespace tribogel::test
{

TEST(mesh_digest, IsThatOfTheMeshAndNotOfTheFile)
{
  const SerialMesh serial = cubes();
  for (const int nodes : {8, 20, 27}) {
    const GmshWriter writer(serial, Arrangement::gel_on_gel, nodes);
    const std::string two = writer.format_2(), mesh = digest_of(read(two, 2), true);
    EXPECT_EQ(mesh.size(), 16);
    EXPECT_EQ(digest_of(read(writer.format_4(), 2), true), mesh);
    EXPECT_EQ(digest_of(read(replaced(two, "\n1 0 0 -1\n", "\n1 -0 0.00 -1e0\n"), 2), true), mesh);
  }
}

/// By hand: FNV-1a of the four counts and of a facet, by another program (Python's integers).
TEST(mesh_digest, IsFnv)
{
  SerialMesh mesh;
  EXPECT_EQ(digest_of(mesh, true), "0c8210784d8af5a5");
  mesh.boundary.push_back({{3, 1, 7, 7}, Side::slave}); // in the half plane a facet has two vertices
  EXPECT_EQ(digest_of(mesh, true), "1f85f06cbdb2a002");
}

TEST(mesh_digest, SeesNodesCellsAndSides)
{
  const SerialMesh mesh = read(GmshWriter(cubes(), Arrangement::gel_on_gel, 27).format_2(), 2);
  std::vector<std::string> seen{digest_of(mesh, false), digest_of(mesh, true)};
  const auto changed = [&](const auto &change, bool places) {
    SerialMesh other = mesh;
    change(other);
    seen.push_back(digest_of(other, places));
  };
  changed([](SerialMesh &m) { m.vertex[3][2] = std::nextafter(m.vertex[3][2], 2); }, true);
  changed([](SerialMesh &m) { m.middle.begin()->second[1] += 1e-9; }, true);
  for (const bool places : {false, true}) {
    changed([](SerialMesh &m) { std::swap(m.cell[0], m.cell[1]); }, places);
    changed([](SerialMesh &m) { std::swap(m.cell[0].vertex[0], m.cell[0].vertex[1]); }, places);
    changed([](SerialMesh &m) { m.cell[0].body = top_body; }, places);
    changed(
        [](SerialMesh &m) {
          m.boundary[2].side = m.boundary[2].side == Side::wall ? Side::slave : Side::wall;
        },
        places);
    changed([](SerialMesh &m) { m.boundary.pop_back(); }, places);
    changed([](SerialMesh &m) { m.middle.clear(); }, places);
  }
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(std::unique(seen.begin(), seen.end()), seen.end()); // all of them differ
  SerialMesh moved = mesh;
  moved.vertex[3][2] += 1e-9;
  EXPECT_EQ(digest_of(moved, false), digest_of(mesh, false));
}

} // namespace tribogel::test
