/// The bodies' internal forces and their tangent: a loop over this rank's cells that gathers, calls the
/// element and scatters. It knows neither dimension nor material.
#pragma once

#include "mesh/mesh.hpp"
#include "tribogel/element/energy.hpp"
#include "tribogel/material/status.hpp"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace tribogel
{

/// Internal variables at all quadrature points of this rank, cell by cell; hyperelastic cells take no room.
using History = std::vector<double>;

/// Why and where an evaluation failed on this rank.
struct BulkFailure {
  PointStatus status = PointStatus::ok;
  int body = 0;
  std::array<double, 3> X{}; ///< centre of the cell, as Node::X [mm]
  int dim = 2;

  explicit operator bool() const { return status != PointStatus::ok; }
};

class Bulk
{
public:
  virtual ~Bulk() = default;

  /// Forces of the displacements in the local array `U` (prescribed ones included) are added to the local
  /// array `F` [N], and their absolute values to `magnitude`, against which a residual is small.
  virtual BulkFailure AddResidual(const double *U, const History &history, StepWeights step, double *F,
                                  double *magnitude) = 0;

  /// The forces of those cells alone that are bonded to the top plate.
  virtual BulkFailure AddTopPlateForces(const double *U, const History &history, StepWeights step,
                                        double *F) const = 0;

  /// Adds the tangent to the matrix `A` (global, with a local-to-global mapping). Collective only in
  /// assembly.
  virtual PetscErrorCode AddJacobian(const double *U, const History &history, StepWeights step, Mat A,
                                     BulkFailure &failure) = 0;

  /// Inserts zeros where AddJacobian will add.
  virtual PetscErrorCode AddPattern(Mat A) const = 0;

  /// Looks up where AddJacobian will add to an assembled matrix, which spares it the search.
  virtual PetscErrorCode LocateEntries(Mat A) = 0;

  /// Internal variables at the end of a step that ended at U, and the energies of this rank's cells.
  virtual BulkFailure Advance(const double *U, const History &history, StepWeights step, History &next,
                              CellEnergy &energy) = 0;

  virtual History InitialHistory() const = 0;

  /// Where each of this rank's cells begins in a History, and the History's size.
  virtual std::vector<std::size_t> HistoryOffsets() const = 0;

  /// Sum of the squares of C_i^-1 - 1, over this rank's points and branches.
  virtual double SquaredStrain(const History &history) const = 0;

  /// Sum of the squares of a change of the internal variables, each times its branch's share of the
  /// material's shear modulus before any relaxation.
  virtual double SquaredStress(const History &change) const = 0;

  /// Round-off that the forces of a stress-free body carry: machine epsilon times bulk modulus times int
  /// |grad N| dV [N], added to the local array.
  virtual void AddRoundOff(double *magnitude) const = 0;

  /// Whether it keeps what it last evaluated, for when the same is asked again.
  virtual bool remembers() const = 0;

  /// Geometry and evaluation of a cell take 7 kB at order 1 in space, 2.5 kB for each unknown: more than all
  /// else without the solver.
  static constexpr std::size_t most_remembered = std::size_t{1} << 28; ///< bytes on a rank

  /// It remembers where that takes `memory` bytes at most.
  static PetscErrorCode Create(const Mesh &mesh, const Scene &scene, std::unique_ptr<Bulk> &bulk,
                               std::size_t memory = most_remembered);
};

/// Makes a failure on any rank known to all: they must leave the evaluation, and the solve, together.
/// Collective.
PetscErrorCode ShareFailure(MPI_Comm comm, BulkFailure &failure);

/// In words, for messages.
std::string describe(const BulkFailure &failure);

} // namespace tribogel
