/// Meshes from Gmsh files: the O-grids written and read again give the forces of the built-in mesh, in both
/// formats, with straight and curved cells; what a file must not be is refused in words.
#include "gmsh_texts.hpp"
#include "solver_options.hpp"
#include "tribogel/friction/polynomial.hpp"

namespace tribogel::test
{

namespace
{

Scene turned_gels(int order, int elements)
{
  Scene scene = paper_scene(elements, order);
  scene.model = Model::solid;
  scene.mesh.grading = 1;
  scene.top.material = scene.bottom.material = hyperelastic_gel();
  scene.friction = PolynomialFriction<double>{{0.02}, {1}};
  scene.schedule = schedule_from_rates({1, 2}, {0.3, 0.3}, {0, 0.5});
  return scene;
}

Measurement measured(const Scene &scene, const SerialMesh &serial)
{
  Problem problem;
  Recorder recorder("");
  bool completed = false;
  std::string why;
  EXPECT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene, serial), 0);
  EXPECT_EQ(problem.Run({&recorder}, completed, why), 0);
  EXPECT_TRUE(completed) << why;
  return recorder.rows.back().measurement;
}

} // namespace

/// Order 2: the 27 nodes lie on the curved bodies, and so do those of the built-in mesh.
TEST(mesh_file, GivesTheForcesOfTheBuiltInMesh)
{
  const SolverOptions options(
      fixed_steps(0.5, 1e-10)); // 1e-12 is below the round-off of the gap at the first touch
  for (const auto &[order, elements] : {std::array{1, 3}, std::array{2, 2}}) {
    const Scene scene = turned_gels(order, elements);
    const SerialMesh serial = revolved_mesh(meridian_blocks(scene));
    const GmshWriter writer(serial, Arrangement::gel_on_gel, order == 1 ? 8 : 27);
    const Measurement a = measured(scene, serial),
                      b = measured(scene, read(order == 1 ? writer.format_2() : writer.format_4(), order));
    EXPECT_GT(a.normal_force, 10);
    EXPECT_GT(a.torque, 1);
    std::printf("order %d: N differs by %.1e, T by %.1e\n", order, b.normal_force / a.normal_force - 1,
                b.torque / a.torque - 1);
    EXPECT_NEAR(b.normal_force / a.normal_force, 1, 1e-10);
    EXPECT_NEAR(b.torque / a.torque, 1, 1e-10);
  }
}

/// One gel that both plates hold.
TEST(mesh_file, GivesTheForcesOfOneGel)
{
  const SolverOptions options(fixed_steps(0.5, 1e-12));
  Scene scene = solid_cylinder(4.5, 3, hyperelastic_gel(), 2, 3);
  scene.schedule = schedule_from_twists({1, 2}, {0.3, 0.3}, {0, 0.5});
  const SerialMesh serial = revolved_mesh(meridian_blocks(scene));
  const Measurement a = measured(scene, serial),
                    b = measured(scene, read(GmshWriter(serial, Arrangement::single_gel, 27).format_2(), 2,
                                             Arrangement::single_gel));
  EXPECT_GT(a.torque, 1);
  EXPECT_NEAR(b.normal_force / a.normal_force, 1, 1e-10);
  EXPECT_NEAR(b.torque / a.torque, 1, 1e-10);
}

TEST(mesh_file, IsTheSameInBothFormats)
{
  const SerialMesh serial = revolved_mesh(meridian_blocks(turned_gels(2, 3)));
  for (const int nodes : {8, 20, 27}) {
    const GmshWriter writer(serial, Arrangement::gel_on_gel, nodes);
    const SerialMesh one = read(writer.format_2(), 2), other = read(writer.format_4(), 2);
    ASSERT_EQ(one.cell.size(), serial.cell.size());
    EXPECT_EQ(one.vertex, other.vertex);
    EXPECT_EQ(one.middle, other.middle);
    ASSERT_EQ(one.boundary.size(), other.boundary.size());
    ASSERT_EQ(one.boundary.size(), serial.boundary.size());
    for (std::size_t k = 0; k < one.cell.size(); ++k) {
      EXPECT_EQ(one.cell[k].vertex, other.cell[k].vertex);
      EXPECT_EQ(one.cell[k].body, serial.cell[k].body);
    }
    for (std::size_t k = 0; k < one.boundary.size(); ++k)
      EXPECT_EQ(one.boundary[k].side, other.boundary[k].side);
  }
}

/// Of 20 nodes the serendipity functions make those that are missing: on a cell that is affine, the means; an
/// edge that bulges by b moves the middles of its two faces by b/2 and that of the cell by b/4.
TEST(mesh_file, FillsTheMiddlesOfTwentyNodes)
{
  SerialMesh mesh = cubes();
  for (auto &X : mesh.vertex) X = {X[0] + 0.3 * X[2], X[1] - 0.1 * X[0], X[2]};
  const auto shape = [](std::array<double, 3> X) {
    if (X[2] == -0.5 && X[0] < 0 && X[1] > 0.9) X[0] -= 0.2; // of the edge x = 0, y = 1 of the bottom cube
    return X;
  };
  const SerialMesh straight = read(GmshWriter(mesh, Arrangement::gel_on_gel, 27).format_2(), 2);
  mesh.shape[bottom_body] = shape;
  const SerialMesh bulging = read(GmshWriter(mesh, Arrangement::gel_on_gel, 20).format_2(), 2);
  ASSERT_EQ(bulging.middle.size(), 2 * (12 + 6 + 1));
  double moved = 0;
  for (const auto &[key, X] : bulging.middle) {
    const auto &before = straight.middle.at(key);
    const double by = before[0] - X[0];
    moved += by;
    EXPECT_NEAR(X[1], before[1], 1e-15);
    EXPECT_NEAR(X[2], before[2], 1e-15);
    EXPECT_TRUE(std::abs(by) < 1e-15 || std::abs(by - 0.2) < 1e-15 || std::abs(by - 0.1) < 1e-15 ||
                std::abs(by - 0.05) < 1e-15)
        << by;
  }
  EXPECT_NEAR(moved, 0.2 + 2 * 0.1 + 0.05, 1e-14);
}

TEST(mesh_file, TurnsLeftHandedCells)
{
  const SerialMesh mesh = cubes();
  SerialMesh mirrored = mesh;
  for (SerialMesh::Cell &cell : mirrored.cell)
    for (const int v : {1, 5}) std::swap(cell.vertex[v], cell.vertex[v + 1]);
  for (int nodes : {8, 27}) {
    const SerialMesh a = read(GmshWriter(mesh, Arrangement::gel_on_gel, nodes).format_2(), 2),
                     b = read(GmshWriter(mirrored, Arrangement::gel_on_gel, nodes).format_2(), 2);
    for (std::size_t k = 0; k < 2; ++k)
      for (int v = 0; v < 8; ++v) EXPECT_EQ(a.vertex[a.cell[k].vertex[v]], b.vertex[b.cell[k].vertex[v]]);
  }
}

TEST(mesh_file, SaysWhatIsWrong)
{
  const SerialMesh mesh = cubes();
  const GmshWriter writer(mesh, Arrangement::gel_on_gel, 8);
  const std::string good = writer.format_2(), four = writer.format_4();
  const auto &expect = expect_refusal;
  EXPECT_EQ(refusal(good), "taken");
  EXPECT_EQ(refusal(four), "taken");
  for (const char *name : {"top_plate", "bottom_plate", "top_contact", "bottom_contact"})
    for (const std::string &text : {good, four})
      expect(refusal(replaced(text, std::string("\"") + name, "\"other")),
             std::string("no physical surface '") + name);
  for (const char *name : {"top", "bottom"})
    expect(refusal(replaced(good, std::string("\"") + name + "\"", "\"other\"")),
           std::string("volume '") + name);
  expect(refusal(good, 1, Arrangement::single_gel), "of top_plate is not on the boundary of bottom");
  expect(refusal(""), "no $MeshFormat");
  expect(refusal("solid cube\n"), "line 1");
  expect(refusal(replaced(good, "2.2 0 8", "4 0 8")), "format 4");
  expect(refusal(replaced(good, "2.2 0 8", "2.2 1 8")), "binary");
  for (const std::string &text : {good, four})
    for (std::size_t length = text.size() / 40; length < text.size() - 20; length += text.size() / 40)
      EXPECT_NE(refusal(text.substr(0, length)), "taken") << length;
  expect(refusal(replaced(good, "\n1 5 2 1 7 1 2", "\n1 4 2 1 7 1 2")), "type 4 (tetrahedron)");
  expect(refusal(replaced(good, "\n1 5 2 1 7 1 2", "\n1 5 2 1 7 1 99")), "no node 99");
  expect(refusal(replaced(good, "\n1 5 2 1 7 1 2", "\n1 5 2 1 7 2 1")), "degenerate or folded at (");
  expect(refusal(replaced(good, "\n2 1 0 -1\n", "\n2 nan 0 -1\n")), "not finite");
  expect(refusal(replaced(good, "\n2 1 0 -1\n", "\n1 1 0 -1\n")), "node 1 a second time");
  expect(refusal(replaced(good, "\n3 3 2 4 7 1 ", "\n3 3 2 4 7 9 ")),
         "of bottom_plate is not on the boundary of bottom");
  SerialMesh spoiled = mesh;
  for (int &v : spoiled.cell[1].vertex)
    v = v > 11 ? v : v - 4; // the upper cube stands on the lower one's nodes
  expect(refusal(GmshWriter(spoiled, Arrangement::gel_on_gel, 8).format_2()),
         "shares node 5 with the other body");
  spoiled = mesh;
  spoiled.boundary.push_back({mesh.boundary[0].vertex, Side::master});
  expect(refusal(GmshWriter(spoiled, Arrangement::gel_on_gel, 8).format_2()),
         "stands in another surface too");
}

} // namespace tribogel::test
