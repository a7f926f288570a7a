/// A bulk that remembers its last evaluations and one without room for that answer the same, bit for bit,
/// whatever is asked in whatever order: tangents before and after residuals, forces of the top plate's cells
/// between them, another state, length of a step or history at the same displacements, and an end of the step
/// elsewhere than at the last state.
#include "solids.hpp"

namespace tribogel::test
{

namespace
{

/// Smooth, without symmetry, far from small; a local array.
std::vector<double> state_of(const Mesh &mesh, double size)
{
  std::vector<double> U(3 * mesh.nodes.size());
  for (const Node &node : mesh.nodes) {
    const double x = node.X[0], y = node.X[1], z = mesh.dim == 2 ? 0.3 : node.X[2];
    U[node.displacement] = size * 0.1 * x * std::cos(0.4 * y + 0.9 * z);
    U[node.displacement + 1] = size * (0.3 * std::sin(0.8 * y - 0.2 * x) + 0.1 * x);
    U[node.displacement + 2] = size * 0.25 * std::sin(0.5 * x - 0.7 * y + 0.4 * z);
  }
  return U;
}

/// All that is asked of one bulk, and what it answers.
class Asked
{
public:
  Asked(const Problem &problem, std::unique_ptr<Bulk> bulk)
      : given(problem), asked(std::move(bulk)), history(asked->InitialHistory())
  {
    EXPECT_EQ(asked->LocateEntries(given.stepper.jacobian), 0);
  }

  void residual(double size, double step)
  {
    const std::vector<double> U = state_of(given.system.mesh, size);
    std::vector<double> F(U.size(), 0), magnitude(U.size(), 0);
    EXPECT_FALSE(asked->AddResidual(U.data(), history, {step}, F.data(), magnitude.data()));
    add(F);
    add(magnitude);
  }

  void plate(double size, double step)
  {
    const std::vector<double> U = state_of(given.system.mesh, size);
    std::vector<double> F(U.size(), 0);
    EXPECT_FALSE(asked->AddTopPlateForces(U.data(), history, {step}, F.data()));
    add(F);
  }

  void tangent(double size, double step)
  {
    BulkFailure failure;
    MatInfo info;
    PetscScalar *values;
    EXPECT_EQ(MatZeroEntries(given.stepper.jacobian), 0);
    EXPECT_EQ(asked->AddJacobian(state_of(given.system.mesh, size).data(), history, {step},
                                 given.stepper.jacobian, failure),
              0);
    EXPECT_FALSE(failure);
    EXPECT_EQ(MatAssemblyBegin(given.stepper.jacobian, MAT_FINAL_ASSEMBLY), 0);
    EXPECT_EQ(MatAssemblyEnd(given.stepper.jacobian, MAT_FINAL_ASSEMBLY), 0);
    EXPECT_EQ(MatGetInfo(given.stepper.jacobian, MAT_LOCAL, &info), 0);
    EXPECT_EQ(MatSeqAIJGetArray(given.stepper.jacobian, &values), 0);
    add({values, values + static_cast<std::size_t>(info.nz_used)});
    EXPECT_EQ(MatSeqAIJRestoreArray(given.stepper.jacobian, &values), 0);
  }

  void advance(double size, StepWeights step)
  {
    CellEnergy energy;
    EXPECT_FALSE(asked->Advance(state_of(given.system.mesh, size).data(), history, step, history, energy));
    add(history);
    add({energy.stored, energy.dissipated});
  }

  /// A few steps as SNES and TS take them, and questions that they do not ask.
  void steps()
  {
    double size = 0.2;
    for (const double step : {0.4, 0.4, 3.0}) {
      residual(size, step); // at the displacements that the last step ended with
      for (const double change : {0.3, 0.1}) {
        tangent(size, step);
        plate(size, step);
        residual(size += change, step);
      }
      residual(size, 2 * step);
      tangent(size, step);
      tangent(size - 0.05, step);
      advance(size, step < 1 ? StepWeights{step} : StepWeights{step, 2.4});
      advance(size, {0.1});
      residual(size, 0.1); // nothing but the history has changed
    }
  }

  std::vector<std::vector<double>> answers;

private:
  void add(const std::vector<double> &values) { answers.push_back(values); }

  const Problem &given;
  std::unique_ptr<Bulk> asked;
  History history;
};

void expect_same(const Scene &scene)
{
  Problem problem;
  std::unique_ptr<Bulk> with, without;
  ASSERT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene), 0);
  ASSERT_EQ(problem.stepper.BuildMatrix(), 0);
  ASSERT_EQ(Bulk::Create(problem.system.mesh, scene, with), 0);
  ASSERT_EQ(Bulk::Create(problem.system.mesh, scene, without, 0), 0);
  ASSERT_TRUE(with->remembers());
  ASSERT_FALSE(without->remembers());
  Asked first(problem, std::move(with)), second(problem, std::move(without));
  first.steps();
  second.steps();
  ASSERT_EQ(first.answers.size(), second.answers.size());
  for (std::size_t k = 0; k < first.answers.size(); ++k) {
    ASSERT_FALSE(first.answers[k].empty());
    EXPECT_TRUE(first.answers[k] == second.answers[k])
        << "answer " << k << ", order " << scene.mesh.element_order;
  }
}

} // namespace

TEST(bulk_memory, WithoutRoomForItTheAnswersAreTheSame)
{
  for (const int order : {1, 2}) {
    Scene scene = cylinder(4.5, 3, viscoelastic_gel(), order, 3);
    scene.schedule = schedule_from_twists({1}, {0}, {0});
    expect_same(scene);
  }
  Scene scene = solid_cylinder(4.5, 3, viscoelastic_gel(), 1, 2);
  scene.schedule = schedule_from_twists({1}, {0}, {0});
  expect_same(scene);
}

} // namespace tribogel::test
