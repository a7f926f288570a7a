#include "options/petsc_limits.hpp"

#include "options/option_table.hpp"
#include "support/command_line.hpp"
#include "support/parse.hpp"

#include <algorithm>

namespace tribogel
{

namespace
{

struct Limit {
  const char *name;
  const char *why;                    ///< in front of what is allowed
  std::vector<std::string> allowed{}; ///< words; empty: none, if there is no range either
  const char *instead = "";           ///< the way out
  const Range *range = nullptr;       ///< of a number
};

constexpr Range fraction{0, 1, true}, at_most_one{0, 1}, tenth{0, 0.1};

/// What TS, SNES and KSP of PETSc 3.18 ask the options for.
const std::vector<Limit> &limits()
{
  static const std::vector<std::string> no{"false", "no", "off", "0"};
  static const std::vector<Limit> table{
      // When the run begins, ends and stops in between.
      {"-ts_max_time", "the schedule ends the run", {}, "; use -schedule_end_times"},
      {"-ts_final_time", "the schedule ends the run", {}, "; use -schedule_end_times"},
      {"-ts_time_span", "the schedule says which times are met exactly", {}, "; use -schedule_end_times"},
      {"-ts_init_time", "a run begins at t = 0", {}, "; to continue one: -restart"},
      {"-ts_exact_final_time", "phases end exactly when the schedule says", {"matchstep"}},
      {"-ts_error_if_step_fails", "a run that cannot go on keeps what it has and ends with status 3", no},
      {"-ts_convergence_estimate",
       "it would run phases again in the midst of the run",
       {},
       "; use -error_estimate"},
      // How long steps are.
      {"-ts_adapt_type", "the steps follow the error of N and T", {"basic", "dsp", "none"}},
      {"-ts_adapt_dt_min",
       "how short a step may become is the program's to find",
       {},
       "; -ts_dt is the first step of each phase, -time_tolerance what the steps follow"},
      {"-ts_rtol", "the error of a step is held against the largest N and T", {}, "; use -time_tolerance"},
      {"-ts_atol",
       "it is the error of N and T over their largest values",
       {},
       "; or use -time_tolerance",
       &fraction},
      {"-ts_adapt_always_accept", "the steps keep to the tolerance", no, "; use a larger -time_tolerance"},
      {"-ts_adapt_wnormtype", "the error is that of N and T, not a norm of the unknowns", {}},
      {"-ts_adapt_max_ignore", "the error is that of N and T, not a norm of the unknowns", {}},
      {"-ts_adapt_glee_use_local", "no time rule of the program estimates errors like that", {}},
      {"-ts_theta_theta", "the time rule is fixed", {"1"}, "; use -maxwell_integrator"},
      {"-ts_theta_endpoint", "the time rule is fixed", no, "; use -maxwell_integrator"},
      {"-ts_use_splitrhsfunction", "the equations have no right-hand side to split", no},
      {"-ts_rhs_jacobian_test_mult", "the equations have no right-hand side", no,
       "; use -snes_test_jacobian"},
      {"-ts_rhs_jacobian_test_mult_transpose", "the equations have no right-hand side", no,
       "; use -snes_test_jacobian"},
      {"-ts_save_trajectory", "it would write beside the output directory", no,
       "; history.csv and checkpoint.h5 hold the run"},
      {"-ts_adjoint_solve", "there are no adjoint equations", no},
      // When a step is solved: each force is held against what meets in it, whatever solver is chosen.
      {"-snes_convergence_test", "a step is solved when its forces balance to -snes_rtol", {}},
      {"-snes_rtol", "it is what may be left of the forces that meet", {}, "", &tenth},
      // PETSc does not read it where the factors solve alone.
      {"-ksp_rtol", "it is what a linear solve may leave of its right-hand side", {}, "", &at_most_one},
      {"-snes_atol", "what may be left is relative to the forces that meet", {}, "; use -snes_rtol"},
      {"-snes_stol", "a short step is no balance of forces", {"0"}, "; use -snes_rtol"},
      {"-snes_max_funcs", "nothing counts them", {}, "; use -snes_max_it"},
      {"-snes_divergence_tolerance",
       "the residual may rise while the contact changes",
       {"-1"},
       "; use -snes_max_it"},
      {"-snes_norm_schedule", "each iteration's residual is looked at", {"always"}},
      {"-snes_function_type", "it is the forces that are looked at", {"unpreconditioned", "default"}},
      {"-snes_type",
       "other methods do not look at the forces or do not balance them",
       {"newtonls", "newtontr"}},
      {"-snes_linesearch_type", "there are these", {"basic", "bt", "l2", "cp", "nleqerr"}},
      {"-snes_error_if_not_converged", "a step that is not solved is tried again with a shorter one", no},
      {"-ksp_error_if_not_converged", "a step that is not solved is tried again with a shorter one", no},
      // The tangent and the mesh.
      {"-ts_fd_color", "the tangent is exact", no, "; -snes_test_jacobian compares it with differences"},
      {"-snes_fd", "the tangent is exact", no, "; -snes_test_jacobian compares it with differences"},
      {"-snes_fd_color", "the tangent is exact", no, "; -snes_test_jacobian compares it with differences"},
      {"-snes_mf", "the linear solver needs the tangent", no, "; use -snes_mf_operator"},
      {"-snes_fd_function", "there is no energy to take the forces from", no},
      {"-snes_grid_sequence", "the mesh is one for the whole run", {"0"}, "; use -mesh_refinements"},
      {"-snes_adapt_initial", "the mesh is one for the whole run", {"0"}, "; use -mesh_refinements"},
      {"-snes_adapt_sequence", "the mesh is one for the whole run", {"0"}, "; use -mesh_refinements"},
      {"-snes_convergence_estimate", "the mesh is one for the whole run", {}, "; use -error_estimate"},
  };
  return table;
}

std::string in_words(const Limit &limit)
{
  if (limit.range) return "a real number " + limit.range->in_words();
  std::string text;
  for (const std::string &word : limit.allowed) text += (text.empty() ? "" : " or ") + word;
  return text.empty() ? "nothing" : text;
}

} // namespace

std::vector<std::string> limited_petsc_options()
{
  std::vector<std::string> names;
  for (const Limit &limit : limits()) names.emplace_back(limit.name);
  return names;
}

void check_petsc_option(const std::string &name, const std::string &value)
{
  for (const Limit &limit : limits()) {
    if (!same_name(limit.name, name)) continue;
    const Parsed<double> number = parse_real(value);
    const bool fits =
        limit.range ? value.empty() || (number.value && limit.range->contains(*number.value))
                    : std::find(limit.allowed.begin(), limit.allowed.end(), value) != limit.allowed.end();
    if (!fits)
      throw UserError{name + (value.empty() ? "" : " = " + value) + ": " + limit.why +
                      "; allowed: " + in_words(limit) + limit.instead};
  }
}

} // namespace tribogel
