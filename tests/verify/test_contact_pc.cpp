/// The preconditioner `contact`: what it leaves out of the condensed system costs a Krylov method two or
/// three iterations when the rest is solved exactly, in every contact state; and it changes no result.
#include "probe.hpp"
#include "solver_options.hpp"
#include "tribogel/friction/polynomial.hpp"
#include "wall_scenes.hpp"

namespace tribogel::test
{

namespace
{

Scene pressed(PolynomialFriction<double> friction, std::vector<double> rates)
{
  Scene scene = paper_scene(4, 1);
  scene.model = Model::solid;
  scene.plate_contact = false;
  scene.mesh.grading = 1;
  scene.time.rule = TimeRule::exponential_euler; // one solve a step
  scene.friction = std::move(friction);
  scene.top.material = scene.bottom.material = hyperelastic_gel();
  scene.schedule = schedule_from_rates({1, 2}, {0.4, 0.4}, std::move(rates));
  return scene;
}

OptionList with_contact_pc(const char *inner)
{
  return {{"-pc_type", "contact"},       {"-ksp_type", "gmres"}, {"-ksp_pc_side", "right"},
          {"-condensed_pc_type", inner}, {"-ksp_rtol", "1e-8"},  {"-ksp_gmres_restart", "200"},
          {"-ts_adapt_type", "none"},    {"-ts_dt", "0.5"},      {"-snes_rtol", "1e-9"}};
}

OptionList direct()
{
  return {{"-ts_adapt_type", "none"}, {"-ts_dt", "0.5"}, {"-snes_rtol", "1e-9"}};
}

struct Outcome {
  double N, T;
  int newton, linear, slipping, sticking;
};

/// `rolled`: the number of nodes of walls under pressure at the end.
Outcome outcome(const Scene &scene, const OptionList &options, int *rolled = nullptr)
{
  const SolverOptions solver(options);
  Problem problem;
  Recorder recorder("");
  run(scene, problem, recorder);
  Outcome sum{
      recorder.rows.back().measurement.normal_force, recorder.rows.back().measurement.torque, 0, 0, 0, 0};
  sum.newton = problem.stepper.counts.newton_iterations;
  sum.linear = problem.stepper.counts.linear_iterations;
  if (rolled)
    for (const ProfileRow &row : recorder.last_profile)
      *rolled += std::string(row.surface) == "top" && row.reference_z > 0 && row.pressure > 0;
  for (ContactStatus status : problem.system.contact->lower_face().statuses()) {
    sum.slipping += status == ContactStatus::slip;
    sum.sticking += status == ContactStatus::stick;
  }
  return sum;
}

} // namespace

/// Without friction tangents are free, with much of it all is held; Coulomb's law turns in between has both,
/// and open nodes at the rim.
TEST(contact_pc, LeavesLittleToTheKrylovMethod)
{
  const auto check = [](const char *name, const Scene &scene) {
    const Outcome exact = outcome(scene, direct()), condensed = outcome(scene, with_contact_pc("lu"));
    std::printf("%-12s N %.6f N, T %.6f N mm; %d linear in %d Newton iterations; %d slip, %d stick\n", name,
                exact.N, exact.T, condensed.linear, condensed.newton, condensed.slipping, condensed.sticking);
    EXPECT_NEAR(condensed.N, exact.N, 1e-7 * exact.N) << name;
    EXPECT_NEAR(condensed.T, exact.T, 1e-7 * exact.N * scene.top.radius) << name;
    EXPECT_LE(condensed.linear, 4 * condensed.newton) << name;
    return condensed;
  };
  check("frictionless", pressed({{0.0}, {1}}, {0, 0.1}));
  check("viscous", pressed({{0.05}, {1}}, {0, 0.1}));
  const Outcome held = check("sticking", pressed({{2.0}, {0}}, {0, 0.01}));
  EXPECT_GT(held.sticking, 0);
  const Outcome mixed = check("Coulomb", pressed({{0.02}, {0}}, {0, 0.02}));
  EXPECT_GT(mixed.sticking, 0);
  EXPECT_GT(mixed.slipping, 0);
}

/// Walls at the plates have multipliers with one force direction.
TEST(contact_pc, TakesPlatesToo)
{
  Scene scene = pressed({{0.05}, {1}}, {0, 0.1});
  scene.plate_contact = true;
  scene.schedule = schedule_from_rates({1, 2}, {0.8, 0.8}, {0, 0.1});
  const Outcome exact = outcome(scene, direct()), condensed = outcome(scene, with_contact_pc("lu"));
  EXPECT_NEAR(condensed.N, exact.N, 1e-7 * exact.N);
  EXPECT_LE(condensed.linear, 4 * condensed.newton);
}

/// A wall that rolls on is a contact surface of its own, and its first row of multipliers presses on the
/// crease too.
TEST(contact_pc, FollowsAWallThatRollsOn)
{
  Scene scene = mushroom(1);
  scene.model = Model::solid;
  scene.mesh.elements_radial = 3;
  scene.mesh.bottom_elements_radial = 4;
  scene.mesh.grading = 2;
  scene.schedule = schedule_from_rates({8, 9}, {2.2, 2.2}, {0, 0.02});
  OptionList straight = direct(), contact = with_contact_pc("lu");
  for (OptionList *options : {&straight, &contact}) options->emplace_back("-ts_dt", "1");
  int rolled = 0;
  const Outcome exact = outcome(scene, straight, &rolled), condensed = outcome(scene, contact);
  std::printf("N %.6f N, T %.6f N mm; %d wall nodes pressed; %d linear in %d Newton iterations\n", exact.N,
              exact.T, rolled, condensed.linear, condensed.newton);
  EXPECT_GT(rolled, 2);
  EXPECT_GT(exact.T, 1);
  EXPECT_NEAR(condensed.N, exact.N, 1e-7 * exact.N);
  EXPECT_NEAR(condensed.T, exact.T, 1e-7 * exact.N * scene.top.radius);
  EXPECT_LE(condensed.linear, 4 * condensed.newton);
}

/// With a multigrid inside; K/G = 144.
TEST(contact_pc, MultigridGivesTheSameForces)
{
  const Scene scene = pressed({{0.02}, {0}}, {0, 0.02});
  const Outcome exact = outcome(scene, direct());
  for (const char *inner : {"gamg", "hypre"}) {
    OptionList options = with_contact_pc(inner);
    options.emplace_back("-snes_ksp_ew", "");
    options.emplace_back("-snes_ksp_ew_rtol0", "0.1");
    options.emplace_back("-snes_ksp_ew_rtolmax", "0.1");
    const Outcome found = outcome(scene, options);
    std::printf("%s: %d linear in %d Newton iterations\n", inner, found.linear, found.newton);
    EXPECT_NEAR(found.N, exact.N, 1e-7 * exact.N) << inner;
    EXPECT_NEAR(found.T, exact.T, 1e-7 * exact.N * scene.top.radius) << inner;
    EXPECT_LE(found.linear, 60 * found.newton) << inner;
  }
}

/// Products by single rows are for smoothers that do not factorise: PETSc does that by rows of one pattern.
/// K/G = 10.
TEST(contact_pc, SmoothersMayFactorise)
{
  Scene scene = pressed({{0.05}, {1}}, {0, 0.1});
  for (Specimen *body : {&scene.top, &scene.bottom})
    body->material.equilibrium.bulk_modulus = 10 * body->material.equilibrium.shear_modulus();
  scene.mesh.elements_radial = 2;
  scene.schedule = schedule_from_rates({1}, {0.2}, {0.1});
  OptionList options = with_contact_pc("gamg");
  options.emplace_back("-ts_dt", "1");
  const Outcome jacobi = outcome(scene, options);
  options.emplace_back("-condensed_mg_levels_ksp_type", "richardson");
  options.emplace_back("-condensed_mg_levels_pc_type", "ilu");
  const Outcome ilu = outcome(scene, options);
  std::printf("linear iterations: Jacobi %d, ILU %d, in %d Newton iterations\n", jacobi.linear, ilu.linear,
              ilu.newton);
  EXPECT_GT(ilu.newton, 1); // the second matrix is the first one to be factorised anew
  EXPECT_NEAR(ilu.N, jacobi.N, 1e-7 * jacobi.N);
  EXPECT_NEAR(ilu.T, jacobi.T, 1e-7 * jacobi.N * scene.top.radius);
}

/// Elements of order 2: what multigrid begins with, fields of order 1 on the same cells, is part of what it
/// is solved in, and better than what it finds without knowing of cells. K/G = 10.
TEST(contact_pc, OrderTwoBeginsWithOrderOne)
{
  Scene scene = pressed({{0.05}, {1}}, {0, 0.1});
  scene.mesh.element_order = 2;
  scene.mesh.elements_radial = 2;
  for (Specimen *body : {&scene.top, &scene.bottom})
    body->material.equilibrium.bulk_modulus = 10 * body->material.equilibrium.shear_modulus();
  scene.schedule = schedule_from_rates({1}, {0.2}, {0.1});
  OptionList straight = direct(), vertices = with_contact_pc("mg"), aggregates = with_contact_pc("gamg");
  for (OptionList *options : {&straight, &vertices, &aggregates}) options->emplace_back("-ts_dt", "1");
  const Outcome exact = outcome(scene, straight), by_vertices = outcome(scene, vertices),
                by_aggregates = outcome(scene, aggregates);
  std::printf("linear iterations: %d, without vertices %d\n", by_vertices.linear, by_aggregates.linear);
  EXPECT_NEAR(by_vertices.N, exact.N, 1e-7 * exact.N);
  EXPECT_NEAR(by_vertices.T, exact.T, 1e-7 * exact.N * scene.top.radius);
  EXPECT_LT(by_vertices.linear, 0.9 * by_aggregates.linear);
}

} // namespace tribogel::test
