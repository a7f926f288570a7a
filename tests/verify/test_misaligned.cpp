/// Gels whose axes do not coincide: the top plate's axis stands aside, or its face is inclined against it.
#include "probe.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <cmath>

namespace tribogel::test
{

namespace
{

/// Coarse hyperelastic gels, pressed in one phase and turned in another.
Scene misaligned_scene(const Misalignment &misalignment, int order = 1)
{
  Scene scene = paper_scene(3, order);
  scene.model = Model::solid;
  scene.mesh.grading = 1;
  scene.top.material.branches.clear();
  scene.bottom.material.branches.clear();
  scene.friction = PolynomialFriction<double>{{0.02}, {1}};
  scene.schedule = schedule_from_rates({1, 2}, {0.5, 0.5}, {0, 0.7});
  scene.time.tolerance = 5;
  scene.misalignment = misalignment;
  return scene;
}

Measurement at_the_end(const Scene &scene)
{
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  return recorder.rows.back().measurement;
}

} // namespace

/// The meshes are their own images after a quarter of a turn: so are the results, to the solver's tolerance.
TEST(misaligned, OffsetsAlongXAndYAreOneAnotherTurned)
{
  const Measurement x = at_the_end(misaligned_scene({{0.9, 0}, 0})),
                    y = at_the_end(misaligned_scene({{0, 0.9}, 0}));
  const double N = x.normal_force, R = 10;
  EXPECT_NEAR(y.normal_force, N, 1e-7 * N);
  EXPECT_NEAR(y.torque, x.torque, 1e-7 * N * R);
  EXPECT_NEAR(y.transverse_force[0], -x.transverse_force[1], 1e-7 * N);
  EXPECT_NEAR(y.transverse_force[1], x.transverse_force[0], 1e-7 * N);
  EXPECT_NEAR(y.bending_moment[0], -x.bending_moment[1], 1e-7 * N * R);
  EXPECT_NEAR(y.bending_moment[1], x.bending_moment[0], 1e-7 * N * R);
  // Pressed where the bottom gel's middle is, the top gel is pushed away from it.
  EXPECT_GT(x.transverse_force[0], 1e-4 * N);
  EXPECT_GT(std::abs(x.bending_moment[1]), 1e-4 * N * R);
}

/// The other way inclined is the same plate half a turn later.
TEST(misaligned, TiltsToEitherSideAreOneAnotherTurned)
{
  const Measurement one = at_the_end(misaligned_scene({{}, 0.01})),
                    other = at_the_end(misaligned_scene({{}, -0.01}));
  const Measurement none = at_the_end(misaligned_scene({}));
  const double N = one.normal_force, R = 10;
  EXPECT_NEAR(other.normal_force, N, 1e-7 * N);
  EXPECT_NEAR(other.torque, one.torque, 1e-7 * N * R);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(other.transverse_force[i], -one.transverse_force[i], 1e-7 * N);
    EXPECT_NEAR(other.bending_moment[i], -one.bending_moment[i], 1e-7 * N * R);
  }
  EXPECT_LT(N, 0.95 * none.normal_force); // the travel begins at the first touch
  EXPECT_GT(std::hypot(one.bending_moment[0], one.bending_moment[1]), 1e-2 * N * R);
  EXPECT_LT(std::hypot(none.bending_moment[0], none.bending_moment[1]), 1e-7 * N * R);
}

/// What the plate measures in all six components is what the contact's tractions do to the gel.
TEST(misaligned, ThePlateFeelsTheContactsForceAndMoment)
{
  for (int order : {1, 2}) {
    Scene scene = misaligned_scene({{0.7, -0.4}, 0.01}, order);
    scene.mesh.elements_radial = order == 1 ? 3 : 2;
    scene.schedule = schedule_from_rates({1}, {0.3}, {0.2}); // balance needs no fine steps
    scene.time.rule = TimeRule::exponential_euler;
    scene.time.tolerance = 100;
    Problem problem;
    Recorder recorder("");
    run(scene, problem, recorder);
    const Measurement m = recorder.rows.back().measurement;
    ContactResults results;
    Vec U, Udot;
    const PetscScalar *u, *rate;
    const PlateFrames frames = problem.stepper.plates_now();
    const auto evaluate = [&]() -> PetscErrorCode {
      PetscFunctionBeginUser;
      PetscCall(DMGetLocalVector(problem.system.mesh.dm, &U));
      PetscCall(DMGetLocalVector(problem.system.mesh.dm, &Udot));
      PetscCall(problem.stepper.LocalState(U, Udot));
      PetscCall(VecGetArrayRead(U, &u));
      PetscCall(VecGetArrayRead(Udot, &rate));
      PetscCall(problem.system.contact->Results(frames, u, rate, results));
      PetscCall(VecRestoreArrayRead(Udot, &rate));
      PetscCall(VecRestoreArrayRead(U, &u));
      PetscCall(DMRestoreLocalVector(problem.system.mesh.dm, &Udot));
      PetscCall(DMRestoreLocalVector(problem.system.mesh.dm, &U));
      PetscFunctionReturn(0);
    };
    ASSERT_EQ(evaluate(), 0);
    Wrench contact; // in space, about the point where the plate's face meets its axis
    const double centre = problem.system.plate_height(problem.stepper.plates_now()) + frames.top_travel;
    const SurfaceResults &face = results.surfaces.front();
    for (std::size_t a = 0; a < face.nodes.size(); ++a) {
      if (!face.nodes[a].carries) continue;
      const Vector3<double> &at = face.slave[a].current, f = face.nodes[a].weight * face.nodes[a].nominal;
      const double angle = at[1] + frames.top_rotation, c = std::cos(angle), s = std::sin(angle);
      contact.add({c * f[0] - s * f[1], s * f[0] + c * f[1], f[2]}, {c * at[0], s * at[0], at[2] - centre});
    }
    const double N = m.normal_force, R = 10;
    EXPECT_NEAR(contact.force[0], m.transverse_force[0], 1e-7 * N) << order;
    EXPECT_NEAR(contact.force[1], m.transverse_force[1], 1e-7 * N) << order;
    EXPECT_NEAR(contact.force[2], N, 1e-7 * N) << order;
    EXPECT_NEAR(contact.moment[0], m.bending_moment[0], 1e-7 * N * R) << order;
    EXPECT_NEAR(contact.moment[1], m.bending_moment[1], 1e-7 * N * R) << order;
    EXPECT_NEAR(-contact.moment[2], m.torque, 1e-7 * N * R) << order;
    EXPECT_GT(std::hypot(m.transverse_force[0], m.transverse_force[1]), 1e-4 * N) << order;
  }
}

} // namespace tribogel::test
