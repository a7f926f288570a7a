/// Contact patch test through the whole program: two discs on lubricated plates, pressed together by up
/// to 20 %, with meshes that do not match across the contact. The exact state is homogeneous uniaxial
/// compression; the numbers come from its scalar equations (uniform_compression.hpp): stretches of each body,
/// one pressure p at every contact node, N = p times the current area, and affine positions of all nodes. All
/// of it holds to round-off, which is machine epsilon times K/p, 1e-13, times ten.
#include "tribogel/friction/polynomial.hpp"
#include "uniform_compression.hpp"

#include <algorithm>

namespace tribogel::test
{

namespace
{

constexpr double round_off = 1e-11; // relative; K / G = 144 magnifies that of the strains

/// All nodes of both bodies move affinely; the pressure is the same at every node that carries one.
void expect_uniform(const Problem &problem, const Recorder &recorder, const UniaxialState state[2])
{
  const Scene &scene = problem.system.scene;
  Vec U, Udot;
  const PetscScalar *u;
  ASSERT_EQ(DMGetLocalVector(problem.system.mesh.dm, &U), 0);
  ASSERT_EQ(DMGetLocalVector(problem.system.mesh.dm, &Udot), 0);
  ASSERT_EQ(problem.stepper.LocalState(U, Udot), 0);
  ASSERT_EQ(VecGetArrayRead(U, &u), 0);
  double worst = 0;
  for (const Node &node : problem.system.mesh.nodes) {
    const UniaxialState &body = state[node.body];
    const double plate = node.body == top_body ? scene.initial_gap + scene.top.height : -scene.bottom.height;
    const double exact[3] = {(body.lateral - 1) * node.X[0], 0, (body.axial - 1) * (node.X[1] - plate)};
    for (int i = 0; i < 3; ++i) worst = std::max(worst, std::abs(u[node.displacement + i] - exact[i]));
  }
  EXPECT_LE(worst, round_off * scene.top.radius);
  ASSERT_EQ(VecRestoreArrayRead(U, &u), 0);
  ASSERT_EQ(DMRestoreLocalVector(problem.system.mesh.dm, &Udot), 0);
  ASSERT_EQ(DMRestoreLocalVector(problem.system.mesh.dm, &U), 0);

  const double p = state[top_body].pressure;
  const double interface = scene.bottom.height * (state[bottom_body].axial - 1);
  double pressure = 0, shear = 0, flatness = 0;
  int carrying = 0;
  for (const ProfileRow &row : recorder.last_profile) {
    flatness = std::max(flatness, std::abs(row.z - interface));
    if (std::isnan(row.pressure)) continue;
    ++carrying;
    pressure = std::max(pressure, std::abs(row.pressure / p - 1));
    shear = std::max(shear, std::hypot(row.traction_radial, row.traction_circumferential) / p);
  }
  EXPECT_GE(carrying, scene.mesh.elements_radial);
  EXPECT_LE(pressure, round_off);
  EXPECT_LE(shear, round_off);
  EXPECT_LE(flatness, round_off * scene.top.height);
  const double radius = scene.top.radius * state[top_body].lateral;
  const double N = p * std::numbers::pi * radius * radius;
  const Measurement &m = recorder.phases.back().measurement;
  EXPECT_NEAR(m.normal_force / N, 1, round_off);
  EXPECT_NEAR(m.contact_force / N, 1, round_off);
  EXPECT_NEAR(m.contact_radius / radius, 1, round_off);
}

/// One gel in both discs, of different heights: no radial sliding, so friction has nothing to do.
void one_gel(int order, const PolynomialFriction<double> &friction)
{
  const SolverOptions options(fixed_steps(1.5, 1e-13));
  Scene scene = lubricated_discs(7, 3.1, 2.3, order);
  const double compression = 0.18;
  scene.mesh.bottom_elements_radial = 7;
  scene.friction = friction;
  const double approach = compression * (scene.top.height + scene.bottom.height);
  scene.schedule = schedule_from_rates({6}, {approach}, {0});
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  const UniaxialState state = uniaxial_state(scene.top.material.equilibrium, 1 - compression);
  const UniaxialState both[2] = {state, state};
  expect_uniform(problem, recorder, both);
}

/// Two gels whose radii are chosen so that they meet at the last moment: until then the wider one overhangs
/// and the faces slide on each other. The end state does not depend on the path.
void two_gels(int order, double top_stiffness)
{
  const SolverOptions options(fixed_steps(1.5, 1e-13));
  Scene scene = lubricated_discs(7, 3.1, 2.3, order);
  scene.mesh.bottom_elements_radial = 7;
  for (double &G : scene.top.material.equilibrium.moduli) G *= top_stiffness;
  const double p = 0.41;
  const UniaxialState state[2] = {uniaxial_state_under(scene.bottom.material.equilibrium, p),
                                  uniaxial_state_under(scene.top.material.equilibrium, p)};
  scene.bottom.radius = scene.top.radius * state[top_body].lateral / state[bottom_body].lateral;
  const double approach =
      scene.top.height * (1 - state[top_body].axial) + scene.bottom.height * (1 - state[bottom_body].axial);
  scene.schedule = schedule_from_rates({6}, {approach}, {0});
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  expect_uniform(problem, recorder, state);
}

} // namespace

TEST(contact_patch, UniformWithoutFrictionOrder1)
{
  one_gel(1, {});
}

TEST(contact_patch, UniformWithoutFrictionOrder2)
{
  one_gel(2, {});
}

TEST(contact_patch, UniformWithViscousFriction)
{
  for (int order : {1, 2}) one_gel(order, {{0.3}, {1}});
}

TEST(contact_patch, UniformWithCoulombFriction)
{
  for (int order : {1, 2}) one_gel(order, {{0.2, 0.3}, {0, 1}});
}

TEST(contact_patch, UniformWhereTwoGelsSlideAndTheMasterIsWiderUntilTheEnd)
{
  for (int order : {1, 2}) two_gels(order, 0.8);
}

TEST(contact_patch, UniformWhereTwoGelsSlideAndTheSlaveIsWiderUntilTheEnd)
{
  for (int order : {1, 2}) two_gels(order, 1.3);
}

} // namespace tribogel::test
