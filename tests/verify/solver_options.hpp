/// PETSc options for the length of a test.
#pragma once

#include <gtest/gtest.h>

#include <petscsys.h>

#include <iomanip>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace tribogel::test
{

using OptionList = std::vector<std::pair<std::string, std::string>>;

/// PETSc options for the problems that are set up while this lives.
class SolverOptions
{
public:
  explicit SolverOptions(std::vector<std::pair<std::string, std::string>> given) : options(std::move(given))
  {
    for (const auto &[name, text] : options)
      EXPECT_EQ(PetscOptionsSetValue(nullptr, name.c_str(), text.c_str()), 0);
  }
  SolverOptions(const SolverOptions &) = delete;
  SolverOptions &operator=(const SolverOptions &) = delete;
  ~SolverOptions()
  {
    for (const auto &option : options) EXPECT_EQ(PetscOptionsClearValue(nullptr, option.first.c_str()), 0);
  }

private:
  std::vector<std::pair<std::string, std::string>> options;
};

inline std::string text_of(double x)
{
  std::ostringstream text;
  text << std::setprecision(17) << x;
  return text.str();
}

/// Residuals over the forces that meet in them.
inline OptionList newton_tolerance(double tolerance)
{
  return {{"-snes_rtol", text_of(tolerance)}};
}

/// Steps of equal size `dt` [s]; each phase still ends exactly.
inline OptionList fixed_steps(double dt, double tolerance)
{
  return {{"-ts_adapt_type", "none"}, {"-ts_dt", text_of(dt)}, {"-snes_rtol", text_of(tolerance)}};
}

} // namespace tribogel::test
