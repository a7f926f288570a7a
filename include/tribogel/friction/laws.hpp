/// The friction laws that the program offers. A new one is a header beside this, and its line in
/// `known_laws`.
#pragma once

#include "tribogel/friction/adsorption_viscous.hpp"
#include "tribogel/friction/asinh.hpp"
#include "tribogel/friction/bounded.hpp"
#include "tribogel/friction/coulomb.hpp"
#include "tribogel/friction/exponential_decay.hpp"
#include "tribogel/friction/friction.hpp"
#include "tribogel/friction/plateau.hpp"
#include "tribogel/friction/polynomial.hpp"
#include "tribogel/friction/power.hpp"
#include "tribogel/friction/rate_and_state.hpp"
#include "tribogel/friction/stribeck.hpp"
#include "tribogel/friction/table.hpp"

#include <string>
#include <vector>

namespace tribogel
{

/// A law that can be chosen: what it is, and how it is made of its parameters' values.
struct KnownLaw {
  const LawDeclaration *declaration;
  Friction (*make)(const LawValues &values);
};

namespace laws
{
template <template <class> class Formula> Friction made(const LawValues &values)
{
  Formula<double> formula;
  formula.set(values);
  return formula;
}

template <template <class> class... Formulas> std::vector<KnownLaw> listed()
{
  return {{&Formulas<double>::declaration(), &made<Formulas>}...};
}
} // namespace laws

inline const std::vector<KnownLaw> &known_laws()
{
  // clang-format off
  static const std::vector<KnownLaw> all = laws::listed<
      PolynomialFriction,
      CoulombFriction,
      PowerFriction,
      PlateauFriction,
      ExponentialDecayFriction,
      StribeckFriction,
      AdsorptionViscousFriction,
      AsinhFriction,
      BoundedFriction,
      RateAndStateFriction,
      TableFriction
  >();
  // clang-format on
  return all;
}

} // namespace tribogel
