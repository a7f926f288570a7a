#include "observe/companions.hpp"

#include "mesh/cylinder.hpp"
#include "observe/cost.hpp"
#include "support/parse.hpp"
#include "support/petsc_session.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tribogel
{

namespace
{

/// Over the run's edges. With these the errors of N and T of the paper scene are within those that are
/// estimated on each mesh from 6 to 32 elements (tests/measurements/error-estimate.md); with 2 and 4
/// alone and orders up to 2.4 and 4.8 believed, a third of the cost, on all but five of order 2, whose values
/// scatter.
constexpr double coarsenings[] = {4.0 / 3, 2, 8.0 / 3, 4};

/// Over the run's tolerance. Shorter steps: at the end of a phase errors of longer ones may cancel (0.4 %
/// and 1.6 % gave the same N by chance), and then the run would seem exact.
constexpr double tightened = 0.25;

/// Edges `factor` times as long: fewer halvings where that is what it takes, else fewer elements.
MeshParameters coarser(MeshParameters mesh, double factor)
{
  for (; mesh.refinements > 0 && factor >= 2; factor /= 2) --mesh.refinements;
  mesh.elements_radial = static_cast<int>(std::lround(mesh.elements_radial / factor));
  if (mesh.bottom_elements_radial > 0)
    mesh.bottom_elements_radial =
        std::max(1, static_cast<int>(std::lround(mesh.bottom_elements_radial / factor)));
  return mesh;
}

int fewest_elements(const Scene &scene)
{
  return scene.model == Model::solid ? 2
                                     : 3; // coarser ones say nothing, and cost nothing only in the half plane
}

/// Keeps N and T at the phases' ends and asks for a stop.
class PhaseEnds : public Observer
{
public:
  PhaseEnds(const StopQuestion &asked, std::vector<PlateLoads> &loads) : ask(asked), ends(loads) {}

  PetscErrorCode Start(const Problem &) override { return 0; }

  PetscErrorCode Step(const Problem &problem, const StepReport &report) override
  {
    PetscFunctionBeginUser;
    if (report.ends_phase) {
      Measurement measured;
      PetscCall(Measure(problem, measured, nullptr));
      ends.push_back({measured.normal_force, measured.torque});
    }
    const MPI_Comm comm =
        PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<Vec>(problem.stepper.state.U)));
    std::string why;
    PetscCall(ask(comm, why));
    if (!why.empty()) stop.request(why);
    PetscFunctionReturn(0);
  }

private:
  const StopQuestion &ask;
  std::vector<PlateLoads> &ends;
};

/// Other steps, whichever option the run's follow (-time_tolerance, or -ts_atol, which has the last word).
PetscErrorCode ScaleTolerance(const Problem &problem, double factor)
{
  PetscReal tolerance;
  PetscFunctionBeginUser;
  PetscCall(TSGetTolerances(problem.stepper.ts, &tolerance, nullptr, nullptr, nullptr));
  PetscCall(TSSetTolerances(problem.stepper.ts, factor * tolerance, nullptr, PETSC_DECIDE, nullptr));
  PetscFunctionReturn(0);
}

PetscErrorCode Solve(MPI_Comm comm, const Scene &scene, SerialMesh mesh, const StopQuestion &ask,
                     Companion &companion, bool &stopped)
{
  Problem problem;
  PhaseEnds observer(ask, companion.ends);
  bool completed = false;
  SNES snes;
  PetscFunctionBeginUser;
  PetscCall(problem.SetUp(comm, scene, std::move(mesh)));
  PetscCall(ScaleTolerance(problem, companion.tolerance_over));
  PetscCall(problem.Run({&observer}, completed, companion.failure));
  PetscCall(TSGetSNES(problem.stepper.ts, &snes));
  PetscCall(SNESGetTolerances(snes, nullptr, &companion.newton_tolerance, nullptr, nullptr, nullptr));
  companion.unknowns = problem.system.mesh.unknowns;
  companion.steps = problem.stepper.counts.accepted_steps;
  stopped = problem.stepper.stop.is_request();
  if (completed) companion.failure.clear();
  PetscFunctionReturn(0);
}

} // namespace

std::vector<Companion> mesh_companions(const Scene &scene)
{
  std::vector<Companion> companions;
  if (!scene.round) return companions;
  int before = scene.mesh.elements_radial << scene.mesh.refinements;
  const double run = before;
  for (const double factor : coarsenings) {
    const MeshParameters mesh = coarser(scene.mesh, factor);
    const int elements = mesh.elements_radial << mesh.refinements;
    if (elements < fewest_elements(scene) || elements == before) continue;
    before = elements;
    Companion companion;
    companion.name = std::to_string(elements) + " elements along the radius";
    companion.mesh = mesh;
    companion.size = run / elements;
    companions.insert(companions.begin(), companion);
  }
  return companions;
}

std::vector<Companion> time_companions(const Scene &scene)
{
  if (scene.schedule_kind == ScheduleKind::steady) return {};
  Companion companion;
  companion.name = "a tolerance of the steps of 1/" + to_text(1 / tightened);
  companion.mesh = scene.mesh;
  companion.tolerance_over = tightened;
  return {companion};
}

PetscErrorCode RunCompanion(MPI_Comm comm, const Scene &scene, const SerialMesh *serial,
                            const StopQuestion &ask, Companion &companion, bool &stopped)
{
  RunCost before, after;
  Scene own = scene;
  PetscFunctionBeginUser;
  own.mesh = companion.mesh;
  stopped = false;
  PetscCall(MeasureCost(comm, 0, before));
  {
    const KeptErrors kept; // the run itself is well
    SerialMesh mesh = serial ? *serial : mesh_of(own.model, meridian_blocks(own));
    if (Solve(comm, own, std::move(mesh), ask, companion, stopped) != 0)
      companion.failure = kept.text().empty() ? "PETSc failed" : kept.text();
  }
  PetscCall(MeasureCost(comm, 0, after));
  companion.cpu_seconds = after.cpu_seconds - before.cpu_seconds;
  PetscFunctionReturn(0);
}

} // namespace tribogel
