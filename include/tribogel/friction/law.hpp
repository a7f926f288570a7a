/// What a friction law is: numbers in, numbers out. tau(v, p) is the tangential stress of a contact that
/// slides at speed v >= 0 [mm/s] under the pressure p >= 0 [MPa], both per current area, split by what
/// happens at v -> 0+:
///
///     tau(v, p) = threshold(p) + steep(v, p) + v drag(v, p),    steep(0, p) = 0
///
/// threshold is what a stick can hold, a set-valued force; steep rises with v with an infinite, or very
/// large, slope at v = 0 (or is 0 throughout), so its inverse is smooth there; v drag is smooth. A law
/// without the first two parts has no kink at all.
///
/// A law also says what it is made of: LawDeclaration lists its parameters, from which options, help,
/// refusals and summary come. It holds their values, and gives the slopes of its parts with respect to them,
/// for the identification from measured torques. Everything is in doubles; friction.hpp carries derivatives
/// of other quantities through by the chain rule.
#pragma once

#include "tribogel/math/step_weights.hpp"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace tribogel
{

/// A value of one of the parts at (v, p), and its slopes.
struct LawValue {
  double value = 0;
  double d_v = 0; ///< with respect to v [... s/mm]
  double d_p = 0; ///< with respect to p [... / MPa]
};

/// What a law with memory is told; the others do not look at it.
struct LawMemory {
  double start = 0; ///< the number that it remembers, where the solve starts
  StepWeights weights{std::numeric_limits<double>::infinity()};
};

/// The three parts' slopes with respect to one parameter, in units of the part over that of the parameter.
struct LawParameterSlope {
  double threshold = 0, steep = 0, drag = 0;
};

/// One number, or list of numbers, that a law is made of.
struct LawParameter {
  const char *name;     ///< last part of the option's name
  const char *fallback; ///< the default, as a user would write it; empty: must be given
  const char *unit;     ///< "-": none
  const char *meaning;
  double lowest = 0;
  bool lowest_excluded = false;
  double highest = std::numeric_limits<double>::infinity();
  bool is_list = false;
  const char *rule = "";      ///< what else is allowed, in words
  int as_long_as = -1;        ///< index of a list that has as many numbers; -1: none
  const char *source = "own"; ///< of the default: "paper", "assumed" or "own"
};

/// Values of a declaration's parameters, in its order; that of a number is a list of one.
using LawValues = std::vector<std::vector<double>>;

/// What of a law's values cannot be, though each is in its range.
struct LawObjection {
  std::size_t parameter = 0;
  std::string text; ///< what is wrong and what is allowed; empty: nothing
};

struct LawDeclaration {
  const char *name;    ///< as -friction_law takes it
  const char *formula; ///< in words that -help prints
  const char *source;  ///< of the form
  std::vector<LawParameter> parameters;
  /// Between "-friction_" and a parameter's name in that of its option; empty: nothing stands there.
  const char *prefix;
  LawObjection (*objection)(const LawValues &) = nullptr;

  std::string option(const LawParameter &parameter) const
  {
    const std::string law = prefix;
    return "-friction_" + law + (law.empty() ? "" : "_") + parameter.name;
  }
};

class FrictionLaw
{
public:
  virtual ~FrictionLaw() = default;

  virtual const LawDeclaration &declaration() const = 0;
  virtual LawValues values() const = 0;

  virtual LawValue threshold(double p, const LawMemory & = {}) const = 0;      ///< >= 0 [MPa]
  virtual LawValue drag(double v, double p, const LawMemory & = {}) const = 0; ///< finite at v = 0 [MPa s/mm]
  virtual LawValue steep(double v, double p, const LawMemory & = {}) const = 0; ///< v > 0 [MPa]

  /// The v >= 0 that solves steep(v, p) + drag v = stress, for stress, drag > 0; 0 where it underflows. Only
  /// for a law with a steep part; the sum must rise with v.
  virtual double steep_speed(double stress, double drag, double p, const LawMemory & = {}) const = 0;
  virtual bool has_steep_part() const = 0;

  // Of a law with memory.

  virtual bool has_memory() const { return false; }

  /// Of a contact that has just been made.
  virtual double initial_memory() const { return 0; }

  /// What it remembers after sliding at v, where StepWeights::reach says.
  virtual double memory_after(double v, const LawMemory &) const = 0;

  /// A bound of -d steep / d v at all speeds within a solve that does not go on for ever [MPa s/mm], >= 0.
  virtual LawValue steepest_fall(double p, const LawMemory &) const = 0;

  /// How fast it forgets a disturbance at a constant speed [1/s].
  virtual double memory_rate(double v) const = 0;

  /// Is tau proportional to p? Then it is the same per reference and per current area.
  virtual bool linear_in_pressure() const = 0;

  /// Can tau of steady sliding fall with v, or be negative, at any speed?
  virtual bool may_fall() const = 0;

  /// Does tau of steady sliding keep a value other than 0 as v -> 0?
  virtual bool holds_at_rest() const = 0;

  /// Slopes of the parts at (v, p), v > 0 if there is a steep one, with respect to entry `entry` of parameter
  /// `parameter`, what is remembered at the start fixed.
  virtual LawParameterSlope parameter_slope(std::size_t parameter, std::size_t entry, double v, double p,
                                            const LawMemory & = {}) const = 0;

  /// The law with its numbers, for people to read.
  virtual std::string in_numbers() const = 0;

  /// Beyond which the law knows nothing [mm/s].
  virtual double highest_speed() const { return std::numeric_limits<double>::infinity(); }
};

} // namespace tribogel
