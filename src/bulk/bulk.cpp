#include "bulk/bulk.hpp"

#include "tribogel/kinematics/axisymmetric.hpp"

#include <cmath>
#include <limits>
#include <sstream>

namespace tribogel
{

namespace
{

template <class Kinematics, int order> class BulkOf final : public Bulk
{
  using Element = MeanDilatation<Kinematics, order>;
  using CellType = typename Element::CellType;
  static constexpr int dofs = Element::dofs;

public:
  BulkOf(const Mesh &mesh, const Kinematics &model, const Viscoelastic<double> materials[2]) : kinematics(model)
  {
    for (int body : {bottom_body, top_body}) material[body] = materials[body];
    PetscInt offset = 0;
    for (const MeshCell &mesh_cell : mesh.cells) {
      CellData data{};
      data.body = mesh_cell.body;
      std::array<std::array<double, 2>, Element::nodes> X;
      for (int a = 0; a < Element::nodes; ++a) {
        const Node &node = mesh.nodes[mesh_cell.node[a]];
        X[a] = node.X;
        for (int i = 0; i < 3; ++i) data.dof[3 * a + i] = node.displacement + i;
        for (int j = 0; j < 2; ++j) data.centre[j] += node.X[j] / Element::nodes;
      }
      sound = data.cell.set(X) && sound;
      data.history = offset;
      offset += static_cast<PetscInt>(Element::points) * material[data.body].history_size();
      cells.push_back(data);
    }
    history_size = offset;
  }

  BulkFailure AddResidual(const double *U, const History &history, StepWeights step, double *F,
                          double *magnitude) const override
  {
    for (const CellData &c : cells) {
      typename Element::template Vector<double> R;
      const PointStatus status =
          Element::residual(kinematics, c.cell, material[c.body], gather(c, U), history.data() + c.history, step, R);
      if (status != PointStatus::ok) return failure_of(c, status);
      for (int k = 0; k < dofs; ++k) {
        F[c.dof[k]] += R[k];
        magnitude[c.dof[k]] += std::abs(R[k]);
      }
    }
    return {};
  }

  PetscErrorCode AddJacobian(const double *U, const History &history, StepWeights step, Mat A,
                             BulkFailure &failure) const override
  {
    PetscFunctionBeginUser;
    for (const CellData &c : cells) {
      typename Element::template Vector<double> R;
      typename Element::Matrix K;
      const PointStatus status =
          Element::tangent(kinematics, c.cell, material[c.body], gather(c, U), history.data() + c.history, step, R, K);
      if (status != PointStatus::ok) {
        failure = failure_of(c, status);
        break;
      }
      PetscCall(MatSetValuesLocal(A, dofs, c.dof.data(), dofs, c.dof.data(), K.data(), ADD_VALUES));
    }
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
                      CellEnergy &energy) const override
  {
    for (const CellData &c : cells) {
      typename Element::template Vector<double> R;
      const PointStatus status =
          Element::residual(kinematics, c.cell, material[c.body], gather(c, U), history.data() + c.history, step, R,
                            next.data() + c.history, &energy);
      if (status != PointStatus::ok) return failure_of(c, status);
    }
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

  void AddRoundOff(double *magnitude) const override
  {
    for (const CellData &c : cells) {
      double modulus = material[c.body].equilibrium.bulk_modulus;
      for (const auto &branch : material[c.body].branches) modulus += branch.spring.bulk_modulus;
      for (const auto &p : c.cell.point)
        for (int a = 0; a < Element::nodes; ++a) {
          const double force =
              std::numeric_limits<double>::epsilon() * modulus * p.weight * std::hypot(p.shape[1][a], p.shape[2][a]);
          for (int i = 0; i < 3; ++i) magnitude[c.dof[3 * a + i]] += force;
        }
    }
  }

private:
  struct CellData {
    int body;
    std::array<PetscInt, dofs> dof; ///< offsets in a local vector
    std::array<double, 2> centre;
    std::size_t history; ///< offset of its first point
    CellType cell;
  };

  typename Element::template Vector<double> gather(const CellData &c, const double *U) const
  {
    typename Element::template Vector<double> u;
    for (int k = 0; k < dofs; ++k) u[k] = U[c.dof[k]];
    return u;
  }

  static BulkFailure failure_of(const CellData &c, PointStatus status) { return {status, c.body, c.centre}; }

  Kinematics kinematics;
  Viscoelastic<double> material[2];
  std::vector<CellData> cells;
  std::size_t history_size = 0;

public:
  bool sound = true; ///< no cell is degenerate or inside out
};

template <int order> PetscErrorCode CreateBulk(const Mesh &mesh, const Scene &scene, std::unique_ptr<Bulk> &bulk)
{
  const Viscoelastic<double> materials[2] = {scene.bottom.material, scene.top.material};
  PetscFunctionBeginUser;
  auto made =
      std::make_unique<BulkOf<AxisymmetricTorsion, order>>(mesh, AxisymmetricTorsion{scene.twist_length()}, materials);
  PetscCheck(made->sound, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG, "the mesh has a degenerate cell");
  bulk = std::move(made);
  PetscFunctionReturn(0);
}

} // namespace

PetscErrorCode Bulk::Create(const Mesh &mesh, const Scene &scene, std::unique_ptr<Bulk> &bulk)
{
  PetscFunctionBeginUser;
  if (mesh.order == 1)
    PetscCall(CreateBulk<1>(mesh, scene, bulk));
  else
    PetscCall(CreateBulk<2>(mesh, scene, bulk));
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
  PetscCallMPI(MPI_Bcast(failure.X.data(), 2, MPI_DOUBLE, worst.rank, comm));
  PetscFunctionReturn(0);
}

std::string describe(const BulkFailure &failure)
{
  std::ostringstream text;
  text << (failure.status == PointStatus::inverted ? "element turned inside out" : "Maxwell update found no solution")
       << " in the " << (failure.body == top_body ? "top" : "bottom") << " gel near R = " << failure.X[0]
       << " mm, Z = " << failure.X[1] << " mm";
  return text.str();
}

} // namespace tribogel
