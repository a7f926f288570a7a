/// The errors of N and T in a step, by which TS accepts it and chooses the next. THEORY 4.2 and 4.4.
#include "time/stepper.hpp"
#include "tribogel/math/sdirk2.hpp"

#include <algorithm>
#include <cmath>

namespace tribogel
{

namespace
{

/// An estimate with which TS repeats the length of the step: 0.9, its factor of safety, squared.
constexpr double keeps_the_step = 0.81;

/// An error estimate to eight bits. Its last digits are round-off, which differs between numbers of ranks,
/// and so would the steps: like this they do not, and a step is at most 1/500 off.
double rounded(double estimate)
{
  constexpr double grid = 1 << 8;
  int exponent;
  const double mantissa = std::frexp(estimate, &exponent);
  return std::ldexp(std::round(grid * mantissa) / grid, exponent);
}

/// A sum of squares over all ranks.
PetscErrorCode Norm(MPI_Comm comm, double squares, double &norm)
{
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &squares, 1, MPI_DOUBLE, MPI_SUM, comm));
  norm = std::sqrt(squares);
  PetscFunctionReturn(0);
}

} // namespace

/// At least what the schedule's largest compression would leave at every point: what is small beside that is
/// not resolved for its own sake.
PetscErrorCode Stepper::LargestStrain(const History &history, double &strain) const
{
  const double floor = system.expected_compression();
  double least = floor * floor * static_cast<double>(history.size());
  PetscFunctionBeginUser;
  PetscCall(Norm(system.comm(), system.bulk->SquaredStrain(history), strain));
  PetscCall(Norm(system.comm(), least, least));
  strain = std::max({strain, least, state.largest_strain});
  PetscFunctionReturn(0);
}

/// TS's error estimate, of what is looked at: the local error of N and T, from the second difference of their
/// last three values as TS takes it of U (h^2/2 times the second derivative), over `-ts_atol` times their
/// largest values so far.
PetscErrorCode Stepper::ErrorOfEuler(PetscReal &error) const
{
  PetscReal step, first, unresolved, fraction;
  PetscFunctionBeginUser;
  PetscCall(TSGetTimeStep(ts, &step));
  PetscCall(TSGetTolerances(ts, &fraction, nullptr, nullptr, nullptr));
  error = -1;                                      // unknown
  if (system.steady()) error = keeps_the_step / 4; // nothing is integrated: only failures shorten steps
  if (state.steps_in_phase == 0 || system.steady()) PetscFunctionReturn(0);
  PlateLoads loads;
  PetscCall(system.SumPlateLoads(loads));
  const PlateLoads scale = system.load_scales(state.largest);
  error = 0;
  for (int k = 0; k < 2; ++k) {
    const double bend = (loads[k] - state.loads[k]) / step - state.load_rates[k];
    error = std::max(error, step * step / (step + state.step) * std::abs(bend) /
                                (fraction * scale[k] + system.least.loads[k]));
  }
  error = rounded(error);
  // What is over sooner than anybody looks is not resolved: Euler's rule damps it.
  PetscCall(FirstStep(first, unresolved));
  if (step <= unresolved) error = std::min(error, keeps_the_step);
  PetscFunctionReturn(0);
}

/// THEORY (4.8), over `-time_tolerance`: such that this is what TS aims at.
PetscErrorCode Stepper::ErrorOfStages(PetscReal &error) const
{
  PetscReal step, first, unresolved, fraction;
  PlateLoads loads, scale;
  History end;
  CellEnergy energy;
  double bend = 0, strain, strain_bend;
  constexpr double gamma = sdirk2::gamma;
  PetscFunctionBeginUser;
  PetscCall(TSGetTimeStep(ts, &step));
  PetscCall(TSGetTolerances(ts, &fraction, nullptr, nullptr, nullptr));
  PetscCall(system.SumPlateLoads(loads));
  for (int k = 0; k < 2; ++k)
    scale[k] = std::max({state.largest[k], std::abs(stage.loads[k]), std::abs(loads[k])});
  scale = system.load_scales(scale);
  for (int k = 0; k < 2; ++k) {
    const double change = std::abs(loads[k] - state.loads[k] - (stage.loads[k] - state.loads[k]) / gamma);
    bend = std::max(bend, change / (fraction * scale[k] + system.least.loads[k]));
  }

  PetscCall(EvaluateEnd(stage.time, end, energy));
  PetscCall(LargestStrain(end, strain));
  for (std::size_t k = 0; k < end.size(); ++k) { // from here on what the second stage does not go on with
    const double at_start = state.history[k];
    end[k] = end[k] - at_start - (stage.history[k] - at_start) / (1 - gamma);
  }
  PetscCall(Norm(system.comm(), system.bulk->SquaredStress(end), strain_bend));
  bend = std::max(bend, strain_bend / (fraction * strain + system.least.strain));
  error = keeps_the_step * sdirk2::error_constant / (gamma * (1 - gamma)) * bend;
  error = rounded(error);
  PetscCall(FirstStep(first, unresolved));
  if (step <= unresolved) error = std::min(error, keeps_the_step);
  PetscFunctionReturn(0);
}

} // namespace tribogel
