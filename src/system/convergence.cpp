/// When is a residual small? Each group of rows is held against the forces that meet in it, and against the
/// round-off that these forces carry: no dimension enters, and a body without load (no force to be relative
/// to) converges too.
#include "support/petsc_arrays.hpp"
#include "system/system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribogel
{

namespace
{

/// Round-off of a row that sums the products of one cell's points: a few tens of operations.
constexpr double round_off_allowance = 16;

} // namespace

/// Forces that meet the convergence test of a body without load leave N, T and the strains that uncertain.
/// What the error estimates find below that is no error of a step.
PetscErrorCode System::MeasureRoundOff()
{
  LocalVector local;
  ConstArray floors;
  double sums[4] = {0, 0, 0, static_cast<double>(bulk->InitialHistory().size())};
  PetscFunctionBeginUser;
  PetscCall(local.GetZero(mesh.dm));
  {
    MutableArray values;
    PetscCall(values.Get(local));
    bulk->AddRoundOff(values);
    if (contact) contact->AddRoundOff(values);
  }
  PetscCall(VecZeroEntries(rows.round_off));
  PetscCall(DMLocalToGlobal(mesh.dm, local, ADD_VALUES, rows.round_off));
  PetscCall(floors.Get(rows.round_off));
  for (std::size_t k = 0; k < rows.group.size(); ++k)
    if (rows.group[k] < 3) sums[static_cast<std::size_t>(rows.group[k])] += floors[k] * floors[k];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, comm()));
  least.loads = {round_off_allowance * std::sqrt(sums[2]),
                 round_off_allowance * std::sqrt(sums[0] + sums[1]) * scene.twist_length()};
  double bulk_over_shear = 0;
  for (const Specimen *gel : scene.gels()) {
    const auto &spring = gel->material.equilibrium;
    bulk_over_shear = std::max(bulk_over_shear, spring.bulk_modulus / spring.shear_modulus());
  }
  constexpr double eps = std::numeric_limits<double>::epsilon();
  least.strain = round_off_allowance * eps * bulk_over_shear * std::sqrt(sums[3]);
  PetscFunctionReturn(0);
}

/// The node of the largest entry in the worst group, for messages.
PetscErrorCode System::LocateWorst(const double *f, WorstResidual &worst) const
{
  struct {
    double size;
    int rank;
  } peak{-1, 0};
  std::size_t place = 0;
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm(), &rank));
  peak.rank = rank;
  for (std::size_t k = 0; k < rows.group.size(); ++k)
    if (rows.group[k] == worst.group && std::abs(f[k]) > peak.size) {
      peak.size = std::abs(f[k]);
      place = k;
    }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &peak, 1, MPI_DOUBLE_INT, MPI_MAXLOC, comm()));
  if (rank == peak.rank) {
    const Node &node = mesh.nodes[rows.node[place]];
    worst.X = node.X;
    worst.body = node.body;
  }
  PetscCallMPI(MPI_Bcast(worst.X.data(), 3, MPI_DOUBLE, peak.rank, comm()));
  PetscCallMPI(MPI_Bcast(&worst.body, 1, MPI_INT, peak.rank, comm()));
  PetscFunctionReturn(0);
}

/// Round-off is an excuse for what an iteration has left, not for making none: the start of a solve may be
/// far off and its residual below the floor, which allows for all that may be lost.
PetscErrorCode System::JudgeResidual(Vec F, double tolerance, bool has_iterated, WorstResidual &worst,
                                     bool &converged) const
{
  ConstArray f, sizes, floors;
  double sums[3 * residual_groups] = {};
  PetscFunctionBeginUser;
  PetscCall(f.Get(F));
  PetscCall(sizes.Get(rows.magnitude));
  PetscCall(floors.Get(rows.round_off));
  for (std::size_t k = 0; k < rows.group.size(); ++k) {
    const int g = rows.group[k];
    sums[3 * g] += f[k] * f[k];
    sums[3 * g + 1] += sizes[k] * sizes[k];
    sums[3 * g + 2] += floors[k] * floors[k];
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 3 * residual_groups, MPI_DOUBLE, MPI_SUM, comm()));
  double all = 0;
  for (int g = 0; g < residual_groups; ++g) all += sums[3 * g + 1];
  worst = {};
  double limits[residual_groups];
  bool needs_the_floor = false;
  for (int g = 0; g < residual_groups; ++g) {
    const double floor = std::sqrt(sums[3 * g + 2]) + std::numeric_limits<double>::epsilon() * std::sqrt(all);
    const double norm = std::sqrt(sums[3 * g]), relative = tolerance * std::sqrt(sums[3 * g + 1]);
    limits[g] = relative + round_off_allowance * floor;
    needs_the_floor |= norm > relative;
    const double ratio = norm == 0 ? 0 : norm / limits[g];
    if (ratio > worst.ratio) {
      worst.ratio = ratio;
      worst.group = g;
    }
  }
  converged = worst.ratio <= 1 && (has_iterated || !needs_the_floor);
  if (worst.group >= 0 && !converged) PetscCall(LocateWorst(f, worst));
  PetscFunctionReturn(0);
}

} // namespace tribogel
