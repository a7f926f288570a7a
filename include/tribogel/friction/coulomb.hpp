/// Coulomb's law, tau <= mu p at rest and tau = mu p in sliding.
#pragma once

#include "tribogel/friction/formula_law.hpp"

namespace tribogel
{

template <class T> struct CoulombFriction : NumbersOf<T, 1> {
  template <class S> using Result = typename NumbersOf<T, 1>::template Result<S>;

  static const LawDeclaration &declaration()
  {
    static const LawDeclaration all{"coulomb",
                                    "tau <= mu p",
                                    "standard",
                                    {{.name = "coefficient", .fallback = "", .unit = "-", .meaning = "mu"}},
                                    "coulomb"};
    return all;
  }

  template <class S> Result<S> threshold(const S &p) const { return this->b[0] * p; }
  template <class S> Result<S> drag(const S &, const S &) const { return 0; }
  bool linear_in_pressure() const { return true; }
  bool may_fall() const { return false; }
};

} // namespace tribogel
