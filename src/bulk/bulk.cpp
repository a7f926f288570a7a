#include "bulk/bulk.hpp"

#include "tribogel/element/mean_dilatation.hpp"
#include "tribogel/kinematics/axisymmetric.hpp"
#include "tribogel/kinematics/solid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>

namespace tribogel
{

namespace
{

template <class Kinematics, int order> class BulkOf final : public Bulk
{
  using Element = MeanDilatation<Kinematics, order>;
  using CellType = typename Element::CellType;
  using Vector = typename Element::template Vector<double>;
  using Evaluation = typename Element::template Evaluation<double>;
  static constexpr int dofs = Element::dofs, dim = Kinematics::dim;

public:
  BulkOf(const Mesh &mesh, const Kinematics &model, const Viscoelastic<double> materials[2],
         std::size_t memory)
      : kinematics(model)
  {
    for (int body : {bottom_body, top_body}) {
      material[body] = materials[body];
      by_lanes[body] = material[body].cast<Lanes>();
    }
    remembering = mesh.cells.size() * sizeof(Known) <= memory;
    known.resize(remembering ? mesh.cells.size() : 1);
    cells.reserve(mesh.cells.size());
    PetscInt offset = 0;
    for (const MeshCell &mesh_cell : mesh.cells) {
      CellData data{};
      data.body = mesh_cell.body;
      for (int a = 0; a < Element::nodes; ++a) {
        const Node &node = mesh.nodes[mesh_cell.node[a]];
        std::copy_n(node.X.begin(), dim, data.X[a].begin());
        for (int i = 0; i < 3; ++i) data.dof[3 * a + i] = node.displacement + i;
      }
      if (!known[remembering ? cells.size() : 0].cell.set(data.X) && !degenerate)
        degenerate = failure_of(data, {});
      for (int a = 0; a < Element::nodes; ++a)
        data.at_top_plate = data.at_top_plate || mesh.nodes[mesh_cell.node[a]].on(Side::top_plate);
      data.history = offset;
      offset += static_cast<PetscInt>(Element::points) * material[data.body].history_size();
      cells.push_back(data);
    }
    history_size = offset;
    if (remembering) history_before.resize(history_size);
    history_after.resize(history_size);
  }

  BulkFailure AddResidual(const double *U, const History &history, StepWeights step, double *F,
                          double *magnitude) override
  {
    for (std::size_t n = 0; n < cells.size(); ++n) {
      const Known *k;
      const PointStatus status = Evaluate(n, U, history, step, false, k);
      if (status != PointStatus::ok) return failure_of(cells[n], status);
      const Vector R = Element::forces(kinematics, k->cell, k->evaluation);
      for (int i = 0; i < dofs; ++i) {
        F[cells[n].dof[i]] += R[i];
        magnitude[cells[n].dof[i]] += std::abs(R[i]);
      }
    }
    return {};
  }

  BulkFailure AddTopPlateForces(const double *U, const History &history, StepWeights step,
                                double *F) const override
  {
    for (const CellData &c : cells) {
      if (!c.at_top_plate) continue;
      CellType cell;
      cell.set(c.X);
      Evaluation evaluation;
      const PointStatus status = evaluation.set(kinematics, cell, by_lanes[c.body], gather(c, U),
                                                history.data() + c.history, step, nullptr, false);
      if (status != PointStatus::ok) return failure_of(c, status);
      const Vector R = Element::forces(kinematics, cell, evaluation);
      for (int k = 0; k < dofs; ++k) F[c.dof[k]] += R[k];
    }
    return {};
  }

  PetscErrorCode AddJacobian(const double *U, const History &history, StepWeights step, Mat A,
                             BulkFailure &failure) override
  {
    typename Element::Matrix K;
    PetscScalar *values = nullptr;
    Mat own;
    PetscFunctionBeginUser;
    PetscCall(OwnBlock(A, own));
    if (A == located) PetscCall(MatSeqAIJGetArray(own, &values));
    for (std::size_t n = 0; n < cells.size(); ++n) {
      const CellData &c = cells[n];
      const Known *k;
      const PointStatus status = Evaluate(n, U, history, step, true, k);
      if (status != PointStatus::ok) {
        failure = failure_of(c, status);
        break;
      }
      Element::tangent(kinematics, k->cell, k->evaluation, K);
      if (values && c.first_entry != elsewhere)
        AddEntries(c, K, values);
      else
        PetscCall(MatSetValuesLocal(A, dofs, c.dof.data(), dofs, c.dof.data(), K.data(), ADD_VALUES));
    }
    if (values) PetscCall(MatSeqAIJRestoreArray(own, &values));
    PetscFunctionReturn(0);
  }

  PetscErrorCode LocateEntries(Mat A) override
  {
    Mat own;
    PetscInt first, last, rows;
    const PetscInt *row, *column, *to_global;
    ISLocalToGlobalMapping mapping;
    PetscBool known_rows;
    PetscFunctionBeginUser;
    located = nullptr;
    entries.clear();
    entries.reserve(dofs * cells.size());
    PetscCall(OwnBlock(A, own));
    if (!own) PetscFunctionReturn(0);
    PetscCall(MatGetOwnershipRange(A, &first, &last));
    PetscCall(MatGetLocalToGlobalMapping(A, &mapping, nullptr));
    PetscCall(ISLocalToGlobalMappingGetIndices(mapping, &to_global));
    PetscCall(MatGetRowIJ(own, 0, PETSC_FALSE, PETSC_FALSE, &rows, &row, &column, &known_rows));
    PetscCheck(known_rows, PETSC_COMM_SELF, PETSC_ERR_SUP, "the matrix does not show its rows");
    for (CellData &c : cells) {
      std::array<PetscInt, dofs> index; // in this rank's rows; negative where prescribed
      bool all_own = true;
      for (int k = 0; k < dofs; ++k) {
        const PetscInt global = to_global[c.dof[k]];
        index[k] = global < 0 ? -1 : global - first;
        all_own = all_own && (global < 0 || (global >= first && global < last));
        if (all_own && index[k] >= 0) all_own = row[index[k] + 1] - row[index[k]] < no_entry;
      }
      c.first_entry = all_own ? entries.size() : elsewhere;
      if (!all_own) continue;
      c.free = {};
      std::array<PetscInt, Element::nodes> first_free; // of each node; its others follow it
      first_free.fill(-1);
      for (int k = dofs; k-- > 0;)
        if (index[k] >= 0) {
          c.free[k / 3] |= 1u << k % 3;
          first_free[k / 3] = index[k];
        }
      for (PetscInt i : index) {
        EntriesOfRow of_row;
        of_row.node.fill(no_entry);
        if (i >= 0) {
          const PetscInt *begin = column + row[i], *end = column + row[i + 1];
          of_row.first = row[i];
          for (int b = 0; b < Element::nodes; ++b)
            if (first_free[b] >= 0)
              of_row.node[b] = static_cast<PlaceInRow>(std::lower_bound(begin, end, first_free[b]) - begin);
        }
        entries.push_back(of_row);
      }
    }
    PetscCall(MatRestoreRowIJ(own, 0, PETSC_FALSE, PETSC_FALSE, &rows, &row, &column, &known_rows));
    PetscCall(ISLocalToGlobalMappingRestoreIndices(mapping, &to_global));
    located = A;
    PetscFunctionReturn(0);
  }

  PetscErrorCode AddPattern(Mat A) const override
  {
    const std::vector<double> zeros(dofs * dofs, 0.0);
    PetscFunctionBeginUser;
    for (const CellData &c : cells)
      PetscCall(MatSetValuesLocal(A, dofs, c.dof.data(), dofs, c.dof.data(), zeros.data(), ADD_VALUES));
    PetscFunctionReturn(0);
  }

  BulkFailure Advance(const double *U, const History &history, StepWeights step, History &next,
                      CellEnergy &energy) override
  {
    for (std::size_t n = 0; n < cells.size(); ++n) {
      const Known *k;
      const PointStatus status = Evaluate(n, U, history, step, false, k);
      if (status != PointStatus::ok) return failure_of(cells[n], status);
      const CellEnergy part = k->evaluation.energy(k->cell);
      energy.stored += part.stored;
      energy.dissipated += part.dissipated;
    }
    next = history_after;
    return {};
  }

  History InitialHistory() const override
  {
    History history(history_size);
    for (const CellData &c : cells)
      for (int q = 0; q < Element::points; ++q)
        material[c.body].initial_history(history.data() + c.history + q * material[c.body].history_size());
    return history;
  }

  std::vector<std::size_t> HistoryOffsets() const override
  {
    std::vector<std::size_t> offsets;
    for (const CellData &c : cells) offsets.push_back(c.history);
    offsets.push_back(history_size);
    return offsets;
  }

  double SquaredStrain(const History &history) const override
  {
    return SumOfSquares(history, [](const Viscoelastic<double> &law, double *weights, double *origin) {
      std::fill_n(weights, law.history_size(), 1.0);
      law.initial_history(origin);
    });
  }

  double SquaredStress(const History &change) const override
  {
    return SumOfSquares(change, [](const Viscoelastic<double> &law, double *weights, double *) {
      double modulus = law.equilibrium.shear_modulus();
      for (const auto &branch : law.branches) modulus += branch.spring.shear_modulus();
      for (const auto &branch : law.branches)
        weights = std::fill_n(weights, law.history_per_branch, branch.spring.shear_modulus() / modulus);
    });
  }

  bool remembers() const override { return remembering; }

  void AddRoundOff(double *magnitude) const override
  {
    for (const CellData &c : cells) {
      double modulus = material[c.body].equilibrium.bulk_modulus;
      for (const auto &branch : material[c.body].branches) modulus += branch.spring.bulk_modulus;
      CellType cell;
      cell.set(c.X);
      for (const auto &p : cell.point)
        for (int a = 0; a < Element::nodes; ++a) {
          double slope = p.shape[1][a];
          for (int j = 2; j <= dim; ++j) slope = std::hypot(slope, p.shape[j][a]);
          const double force = std::numeric_limits<double>::epsilon() * modulus * p.weight * slope;
          for (int i = 0; i < 3; ++i) magnitude[c.dof[3 * a + i]] += force;
        }
    }
  }

private:
  static constexpr std::size_t elsewhere = std::numeric_limits<std::size_t>::max();

  struct CellData {
    int body;
    std::array<PetscInt, dofs> dof; ///< offsets in a local vector
    std::size_t history;            ///< offset of its first point
    /// In `entries`; `elsewhere` if some of its unknowns are another rank's, or a row is too long.
    std::size_t first_entry;
    std::array<unsigned char, Element::nodes>
        free; ///< of each node, a bit for each displacement not prescribed
    bool at_top_plate;
    std::array<typename CellType::Position, Element::nodes> X;
  };

  using PlaceInRow = std::uint16_t;
  static constexpr PlaceInRow no_entry = std::numeric_limits<PlaceInRow>::max();

  /// Where a row of a cell's tangent goes in the values of OwnBlock: from the matrix's row on, by the
  /// column's node, the place of its first free displacement.
  struct EntriesOfRow {
    PetscInt first = 0;
    std::array<PlaceInRow, Element::nodes> node; ///< no_entry where nothing is free or the row is prescribed
  };

  /// A cell's geometry, its last evaluation, and what that was asked.
  struct Known {
    CellType cell;
    Vector U;
    StepWeights step{-1}; ///< none yet
    Evaluation evaluation;
  };

  /// SNES asks for the residual and then for the tangent at the same U, and an accepted step for the internal
  /// variables there: the material, which is most of the work, answers once. What it was asked is compared
  /// bit by bit. In meshes with too many cells for that geometry and material answer each time, without
  /// moduli where nobody asks for them.
  PointStatus Evaluate(std::size_t n, const double *U, const History &history, StepWeights step, bool moduli,
                       const Known *&answer)
  {
    const CellData &c = cells[n];
    Known &k = known[remembering ? n : 0];
    answer = &k;
    const Vector u = gather(c, U);
    const double *before = history.data() + c.history;
    double *after = history_after.data() + c.history;
    if (!remembering) {
      k.cell.set(c.X);
      return k.evaluation.set(kinematics, k.cell, by_lanes[c.body], u, before, step, after, moduli);
    }
    const auto size = static_cast<std::size_t>(Element::points) * material[c.body].history_size();
    double *copy = history_before.data() + c.history;
    if (k.step == step && k.U == u && std::equal(before, before + size, copy)) return PointStatus::ok;
    const PointStatus status =
        k.evaluation.set(kinematics, k.cell, by_lanes[c.body], u, before, step, after, true);
    k.step = status == PointStatus::ok ? step : StepWeights{-1};
    k.U = u;
    std::copy(before, before + size, copy);
    return status;
  }

  /// Sum of the squares of weight (value - origin), with the weights and origins (0 at first) that `of_point`
  /// fills in for the internal variables of a point.
  template <class OfPoint> double SumOfSquares(const History &history, OfPoint of_point) const
  {
    std::vector<double> weights[2], origin[2];
    for (int body : {bottom_body, top_body}) {
      weights[body].resize(material[body].history_size());
      origin[body].resize(material[body].history_size());
      of_point(material[body], weights[body].data(), origin[body].data());
    }
    double sum = 0;
    for (const CellData &c : cells) {
      const double *value = history.data() + c.history;
      for (int q = 0; q < Element::points; ++q)
        for (std::size_t k = 0; k < weights[c.body].size(); ++k, ++value) {
          const double part = weights[c.body][k] * (*value - origin[c.body][k]);
          sum += part * part;
        }
    }
    return sum;
  }

  void AddEntries(const CellData &c, const typename Element::Matrix &K, PetscScalar *values) const
  {
    for (int k = 0; k < dofs; ++k) {
      const EntriesOfRow &of_row = entries[c.first_entry + k];
      for (int b = 0; b < Element::nodes; ++b) {
        if (of_row.node[b] == no_entry) continue;
        PetscScalar *value = values + of_row.first + of_row.node[b];
        for (int j = 0; j < 3; ++j)
          if (c.free[b] >> j & 1u) *value++ += K(k, 3 * b + j);
      }
    }
  }

  /// The block of an AIJ matrix that this rank's unknowns share with each other; null for other types.
  static PetscErrorCode OwnBlock(Mat A, Mat &own)
  {
    PetscBool serial, distributed;
    PetscFunctionBeginUser;
    PetscCall(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(A), MATSEQAIJ, &serial));
    PetscCall(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(A), MATMPIAIJ, &distributed));
    own = serial ? A : nullptr;
    if (distributed) PetscCall(MatMPIAIJGetSeqAIJ(A, &own, nullptr, nullptr));
    PetscFunctionReturn(0);
  }

  Vector gather(const CellData &c, const double *U) const
  {
    Vector u;
    for (int k = 0; k < dofs; ++k) u[k] = U[c.dof[k]];
    return u;
  }

  static BulkFailure failure_of(const CellData &c, PointStatus status)
  {
    BulkFailure failure{status, c.body, {}, dim};
    for (const auto &X : c.X)
      for (int j = 0; j < dim; ++j) failure.X[j] += X[j] / Element::nodes;
    return failure;
  }

  Kinematics kinematics;
  Viscoelastic<double> material[2];
  Viscoelastic<Lanes> by_lanes[2]; ///< the same
  std::vector<CellData> cells;
  std::size_t history_size = 0;
  bool remembering = true;               ///< has room for what is known of every cell
  std::vector<Known> known;              ///< by cell, or one for all
  History history_before, history_after; ///< of the evaluations in `known`
  std::vector<EntriesOfRow> entries;     ///< by cell and row
  Mat located = nullptr;                 ///< the matrix that `entries` is about

public:
  std::optional<BulkFailure> degenerate; ///< where a cell is flat or inside out before the run
};

template <class Kinematics, int order>
PetscErrorCode Make(const Mesh &mesh, const Scene &scene, const Kinematics &kinematics, std::size_t memory,
                    std::unique_ptr<Bulk> &bulk)
{
  const Viscoelastic<double> materials[2] = {scene.bottom.material, scene.top.material};
  PetscFunctionBeginUser;
  auto made = std::make_unique<BulkOf<Kinematics, order>>(mesh, kinematics, materials, memory);
  PetscCheck(
      !made->degenerate, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG,
      "the mesh has a degenerate cell at %s; allowed: other radii and heights, or another -mesh_grading",
      describe_place(mesh.dim, made->degenerate->X).c_str());
  bulk = std::move(made);
  PetscFunctionReturn(0);
}

template <int order>
PetscErrorCode MakeOf(const Mesh &mesh, const Scene &scene, std::size_t memory, std::unique_ptr<Bulk> &bulk)
{
  PetscFunctionBeginUser;
  if (mesh.dim == 2)
    PetscCall(Make<AxisymmetricTorsion, order>(mesh, scene, {scene.twist_length()}, memory, bulk));
  else
    PetscCall(Make<Solid, order>(mesh, scene, {}, memory, bulk));
  PetscFunctionReturn(0);
}

} // namespace

PetscErrorCode Bulk::Create(const Mesh &mesh, const Scene &scene, std::unique_ptr<Bulk> &bulk,
                            std::size_t memory)
{
  PetscFunctionBeginUser;
  if (mesh.order == 1)
    PetscCall(MakeOf<1>(mesh, scene, memory, bulk));
  else
    PetscCall(MakeOf<2>(mesh, scene, memory, bulk));
  PetscFunctionReturn(0);
}

PetscErrorCode ShareFailure(MPI_Comm comm, BulkFailure &failure)
{
  struct {
    int status, rank;
  } worst{static_cast<int>(failure.status), 0};
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &worst.rank));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_2INT, MPI_MAXLOC, comm));
  if (worst.status == static_cast<int>(PointStatus::ok)) PetscFunctionReturn(0);
  failure.status = static_cast<PointStatus>(worst.status);
  PetscCallMPI(MPI_Bcast(&failure.body, 1, MPI_INT, worst.rank, comm));
  PetscCallMPI(MPI_Bcast(failure.X.data(), 3, MPI_DOUBLE, worst.rank, comm));
  PetscCallMPI(MPI_Bcast(&failure.dim, 1, MPI_INT, worst.rank, comm));
  PetscFunctionReturn(0);
}

std::string describe(const BulkFailure &failure)
{
  std::ostringstream text;
  text << (failure.status == PointStatus::inverted ? "element turned inside out"
                                                   : "Maxwell update found no solution")
       << " in the " << (failure.body == top_body ? "top" : "bottom") << " gel near "
       << describe_place(failure.dim, failure.X);
  return text.str();
}

} // namespace tribogel
