/// Solids on any number of ranks: force and torque of a single gel are those of one rank, to the round-off of
/// another order of summation; the surfaces of two gels are the same list on every rank.
#include "gmsh_writer.hpp"
#include "solids.hpp"
#include "tribogel/friction/polynomial.hpp"

namespace tribogel::test
{

namespace
{

void run_on(MPI_Comm comm, const Scene &scene, const SerialMesh &serial, Problem &problem, Recorder &recorder)
{
  bool completed = false;
  std::string why;
  ASSERT_EQ(problem.SetUp(comm, scene, serial), 0);
  ASSERT_EQ(problem.Run({&recorder}, completed, why), 0);
  ASSERT_TRUE(completed) << why;
}

/// N to 1e-10 of itself, T of N R.
void compare(const Scene &scene, Problem &shared, Problem &single, const SerialMesh &given,
             const SerialMesh &whole)
{
  Recorder many(""), one("");
  run_on(PETSC_COMM_WORLD, scene, given, shared, many);
  run_on(PETSC_COMM_SELF, scene, whole, single, one);
  ASSERT_EQ(many.rows.size(), one.rows.size());
  const Measurement &a = many.rows.back().measurement, &b = one.rows.back().measurement;
  EXPECT_GT(b.normal_force, 10);
  EXPECT_GT(b.torque, 1);
  EXPECT_NEAR(a.normal_force, b.normal_force, 1e-10 * b.normal_force);
  EXPECT_NEAR(a.torque, b.torque, 1e-10 * b.normal_force * scene.twist_length());
}

void compare(const Scene &scene, Problem &shared, Problem &single)
{
  const SerialMesh serial = revolved_mesh(meridian_blocks(scene));
  compare(scene, shared, single, serial, serial);
}

int sum_over_ranks(int mine)
{
  MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_INT, MPI_SUM, PETSC_COMM_WORLD);
  return mine;
}

} // namespace

TEST(solid_ranks, GiveTheNumbersOfOne)
{
  for (int order : {1, 2}) {
    const SolverOptions options(fixed_steps(0.5, 1e-12));
    Scene scene = solid_cylinder(4.5, 3, viscoelastic_gel(), order, 3);
    scene.plate_contact = true;
    scene.schedule = schedule_from_twists({1, 2}, {0.3, 0.3}, {0, 0.5});
    Problem shared, single;
    compare(scene, shared, single);
    EXPECT_EQ(sum_over_ranks(static_cast<int>(shared.system.mesh.cells.size())),
              static_cast<int>(single.system.mesh.cells.size()));
  }
}

/// Two gels in contact, on more ranks than some own contact on.
TEST(solid_ranks, GiveTheNumbersOfOneInContact)
{
  const SolverOptions options(newton_tolerance(1e-12));
  Scene scene = paper_scene(3, 1);
  scene.model = Model::solid;
  scene.friction = PolynomialFriction<double>{{0.02, 8e-3}, {0, 1}};
  scene.schedule = schedule_from_rates({3, 5}, {0.4, 0.4}, {0.1, 0.3});
  scene.schedule_kind = ScheduleKind::steady;
  Problem shared, single;
  compare(scene, shared, single);
}

TEST(solid_ranks, GiveTheNumbersOfOneOnARigidPlane)
{
  const SolverOptions options(newton_tolerance(1e-12));
  Scene scene = paper_scene(3, 1);
  scene.arrangement = Arrangement::gel_on_rigid;
  scene.model = Model::solid;
  scene.friction = PolynomialFriction<double>{{0.02, 8e-3}, {0, 1}};
  scene.schedule = schedule_from_rates({3, 5}, {0.3, 0.3}, {0.1, 0.3});
  scene.schedule_kind = ScheduleKind::steady;
  Problem shared, single;
  compare(scene, shared, single);
}

/// Curved cells of a file that the first rank alone has read, against the same on one rank.
TEST(solid_ranks, ShareAMeshFile)
{
  const SolverOptions options(fixed_steps(0.5, 1e-12));
  Scene scene = solid_cylinder(4.5, 3, hyperelastic_gel(), 2, 3);
  scene.schedule = schedule_from_twists({1}, {0.3}, {0.5});
  const SerialMesh serial = revolved_mesh(meridian_blocks(scene));
  std::istringstream file(GmshWriter(serial, Arrangement::single_gel, 27).format_4());
  const SerialMesh whole = mesh_of_gmsh(file, Arrangement::single_gel, 2);
  SerialMesh nothing;
  nothing.dim = 3;
  int rank;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  Problem shared, single;
  compare(scene, shared, single, rank ? nothing : whole, whole);
  for (const Node &node : shared.system.mesh.nodes) {
    if (node.on(Side::wall)) {
      EXPECT_NEAR(std::hypot(node.X[0], node.X[1]), 4.5, 1e-13);
    }
  }
}

TEST(solid_ranks, KnowTheSurfacesEverywhere)
{
  for (int order : {1, 2}) {
    Scene scene = paper_scene(4, order);
    scene.model = Model::solid;
    const SerialMesh serial = revolved_mesh(meridian_blocks(scene));
    Mesh shared, single;
    ASSERT_EQ(shared.Build(PETSC_COMM_WORLD, scene, serial), 0);
    ASSERT_EQ(single.Build(PETSC_COMM_SELF, scene, serial), 0);
    for (const auto &[many, one] :
         {std::pair{&shared.slave, &single.slave}, std::pair{&shared.master, &single.master},
          std::pair{&shared.wall[0], &single.wall[0]}}) {
      EXPECT_EQ(many->facet, one->facet);
      ASSERT_EQ(many->node.size(), one->node.size());
      for (std::size_t n = 0; n < one->node.size(); ++n) {
        EXPECT_EQ(many->node[n].X, one->node[n].X);
        EXPECT_EQ(many->node[n].multiplier, one->node[n].multiplier);
        EXPECT_EQ(sum_over_ranks(many->node[n].local >= 0), 1);
      }
    }
    EXPECT_EQ(shared.unknowns, single.unknowns);
  }
}

} // namespace tribogel::test
