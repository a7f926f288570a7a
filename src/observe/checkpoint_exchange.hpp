/// The two directions in which a checkpoint's visitors carry numbers, between all processes and the first
/// one's DataFile. All calls are collective.
#pragma once

#include "support/data_file.hpp"
#include "support/shared_order.hpp"
#include "time/problem.hpp"

#include <span>
#include <type_traits>

namespace tribogel
{

/// Unknowns and internal variables in the order of the mesh before it was distributed.
struct NaturalOrders {
  SharedOrder unknowns, internal;
  PetscErrorCode SetUp(const Problem &problem);
};

/// Into the file.
class Saver
{
public:
  Saver(const NaturalOrders &by, MPI_Comm on, DataFile &to) : orders(by), comm(on), file(to) {}

  PetscErrorCode operator()(const std::string &name, const VecHandle &vector);
  PetscErrorCode operator()(const std::string &name, const History &history);
  PetscErrorCode operator()(const std::string &name, const FrictionHistory &history);
  PetscErrorCode operator()(const std::string &name, std::span<const double> numbers);
  PetscErrorCode Sum(const std::string &name, const double &share);

  template <class Number>
  requires std::is_arithmetic_v<Number> PetscErrorCode operator()(const std::string &name,
                                                                  const Number &number)
  {
    const double value = static_cast<double>(number);
    return (*this)(name, std::span(&value, 1));
  }

private:
  const NaturalOrders &orders;
  MPI_Comm comm;
  DataFile &file;
};

/// Out of the file. What is missing or does not fit is set to zero, and `complaint` names it on the first
/// process.
class Loader
{
public:
  Loader(const NaturalOrders &by, MPI_Comm on, const DataFile &from) : orders(by), comm(on), file(from) {}

  PetscErrorCode operator()(const std::string &name, VecHandle &vector);
  PetscErrorCode operator()(const std::string &name, History &history);
  PetscErrorCode operator()(const std::string &name, FrictionHistory &history);
  PetscErrorCode operator()(const std::string &name, std::span<double> numbers);
  PetscErrorCode Sum(const std::string &name, double &share); ///< all of it on the first process

  template <class Number>
  requires std::is_arithmetic_v<Number> PetscErrorCode operator()(const std::string &name, Number &number)
  {
    double value = 0;
    PetscFunctionBeginUser;
    PetscCall((*this)(name, std::span(&value, 1)));
    number = static_cast<Number>(value);
    PetscFunctionReturn(0);
  }

  /// Any number of numbers, to all processes.
  PetscErrorCode Table(const std::string &name, std::vector<double> &numbers);

  /// To all processes; empty if there is none.
  PetscErrorCode Text(const std::string &name, std::string &text);

  std::string complaint;

private:
  std::vector<double> Take(const std::string &name, std::size_t size);

  const NaturalOrders &orders;
  MPI_Comm comm;
  const DataFile &file;
};

} // namespace tribogel
