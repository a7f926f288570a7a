#include "observe/checkpoint_exchange.hpp"

#include "support/first_process.hpp"
#include "support/petsc_arrays.hpp"

namespace tribogel
{

namespace
{

PetscErrorCode RankOf(MPI_Comm comm, bool &first)
{
  PetscMPIInt rank;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  first = rank == 0;
  PetscFunctionReturn(0);
}

} // namespace

PetscErrorCode NaturalOrders::SetUp(const Problem &problem)
{
  std::vector<long long> keys;
  PetscFunctionBeginUser;
  const MPI_Comm comm =
      PetscObjectComm(reinterpret_cast<PetscObject>(static_cast<Vec>(problem.stepper.state.U)));
  for (std::size_t k = 0; k < problem.system.rows.group.size(); ++k) // a node has one unknown of each group
    keys.push_back(static_cast<long long>(problem.system.mesh.nodes[problem.system.rows.node[k]].natural) *
                       residual_groups +
                   problem.system.rows.group[k]);
  PetscCall(unknowns.SetUp(comm, keys, std::vector<int>(keys.size(), 1)));

  const std::vector<std::size_t> offset = problem.system.bulk->HistoryOffsets();
  std::vector<int> lengths;
  keys.clear();
  for (std::size_t n = 0; n + 1 < offset.size(); ++n) {
    keys.push_back(problem.system.mesh.cells[n].natural);
    lengths.push_back(static_cast<int>(offset[n + 1] - offset[n]));
  }
  PetscCall(internal.SetUp(comm, keys, lengths));
  PetscFunctionReturn(0);
}

PetscErrorCode Saver::operator()(const std::string &name, const VecHandle &vector)
{
  ConstArray values;
  PetscFunctionBeginUser;
  PetscCall(values.Get(vector));
  PetscCall(orders.unknowns.Gather(values, file.numbers[name]));
  PetscFunctionReturn(0);
}

PetscErrorCode Saver::operator()(const std::string &name, const History &history)
{
  PetscFunctionBeginUser;
  PetscCheck(history.size() == orders.internal.local_size(), PETSC_COMM_SELF, PETSC_ERR_PLIB,
             "%s has another size than Bulk's internal variables", name.c_str());
  PetscCall(orders.internal.Gather(history.data(), file.numbers[name]));
  PetscFunctionReturn(0);
}

PetscErrorCode Saver::operator()(const std::string &name, const FrictionHistory &history)
{
  PetscFunctionBeginUser;
  if (!history.values.empty()) PetscCall((*this)(name, std::span<const double>(history.values)));
  PetscFunctionReturn(0);
}

PetscErrorCode Saver::operator()(const std::string &name, std::span<const double> numbers)
{
  PetscFunctionBeginUser;
  file.numbers[name].assign(numbers.begin(), numbers.end());
  PetscFunctionReturn(0);
}

PetscErrorCode Saver::Sum(const std::string &name, const double &share)
{
  double sum = share;
  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, comm));
  PetscCall((*this)(name, sum));
  PetscFunctionReturn(0);
}

std::vector<double> Loader::Take(const std::string &name, std::size_t size)
{
  const auto found = file.numbers.find(name);
  if (found != file.numbers.end() && found->second.size() == size) return found->second;
  if (complaint.empty()) complaint = name;
  return std::vector<double>(size, 0.0);
}

PetscErrorCode Loader::operator()(const std::string &name, VecHandle &vector)
{
  MutableArray values;
  PetscFunctionBeginUser;
  PetscCall(values.Get(vector));
  PetscCall(orders.unknowns.Scatter(Take(name, orders.unknowns.size()), values));
  PetscFunctionReturn(0);
}

PetscErrorCode Loader::operator()(const std::string &name, History &history)
{
  PetscFunctionBeginUser;
  history.resize(orders.internal.local_size());
  PetscCall(orders.internal.Scatter(Take(name, orders.internal.size()), history.data()));
  PetscFunctionReturn(0);
}

PetscErrorCode Loader::operator()(const std::string &name, FrictionHistory &history)
{
  PetscFunctionBeginUser;
  if (!history.values.empty()) PetscCall((*this)(name, std::span(history.values)));
  PetscFunctionReturn(0);
}

PetscErrorCode Loader::operator()(const std::string &name, std::span<double> numbers)
{
  bool first;
  PetscFunctionBeginUser;
  PetscCall(RankOf(comm, first));
  if (first) {
    const std::vector<double> taken = Take(name, numbers.size());
    std::copy(taken.begin(), taken.end(), numbers.begin());
  }
  PetscCallMPI(MPI_Bcast(numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, 0, comm));
  PetscFunctionReturn(0);
}

PetscErrorCode Loader::Sum(const std::string &name, double &share)
{
  bool first;
  PetscFunctionBeginUser;
  PetscCall(RankOf(comm, first));
  PetscCall((*this)(name, share));
  if (!first) share = 0;
  PetscFunctionReturn(0);
}

PetscErrorCode Loader::Table(const std::string &name, std::vector<double> &numbers)
{
  bool first;
  PetscFunctionBeginUser;
  PetscCall(RankOf(comm, first));
  if (first) {
    const auto found = file.numbers.find(name);
    if (found != file.numbers.end())
      numbers = found->second;
    else if (complaint.empty())
      complaint = name;
  }
  PetscCall(Broadcast(comm, numbers));
  PetscFunctionReturn(0);
}

PetscErrorCode Loader::Text(const std::string &name, std::string &text)
{
  bool first;
  PetscFunctionBeginUser;
  PetscCall(RankOf(comm, first));
  if (first) {
    const auto found = file.texts.find(name);
    text = found == file.texts.end() ? "" : found->second;
  }
  PetscCall(Broadcast(comm, text));
  PetscFunctionReturn(0);
}

} // namespace tribogel
