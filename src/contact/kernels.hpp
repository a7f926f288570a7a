/// The kernels of contact that take the compiler longest, half a minute with what they are made of: compiled
/// once (kernels.cpp), for the program and for the tests of the operators.
#pragma once

#include "tribogel/contact/node/condition_slope.hpp"
#include "tribogel/contact/surface/element_mortar.hpp"
#include "tribogel/contact/surface/mortar_kernel.hpp"
#include "tribogel/friction/friction.hpp"

namespace tribogel
{

template <int order> using QuadPairs = std::vector<QuadPair<order>>;
template <int order> using QuadPairMortars = std::vector<QuadPairMortar<order>>;

extern template QuadMeasure<1> quad_measure(const QuadPoints<1> &);
extern template QuadMeasure<2> quad_measure(const QuadPoints<2> &);
extern template QuadPairMortar<1> quad_pair_mortar(const QuadMeasure<1> &, const QuadPair<1> &, bool);
extern template QuadPairMortar<2> quad_pair_mortar(const QuadMeasure<2> &, const QuadPair<2> &, bool);
extern template QuadPairMortars<1> quad_element_mortar(const QuadMeasure<1> &, const QuadPairs<1> &, bool);
extern template QuadPairMortars<2> quad_element_mortar(const QuadMeasure<2> &, const QuadPairs<2> &, bool);

extern template Eigen::Matrix<double, 3, 10>
condition_slope<10>(const ContactPoint<double> &, const ContactScale &, const Friction &, bool);
extern template Eigen::Matrix<double, 3, 11>
condition_slope<11>(const ContactPoint<double> &, const ContactScale &, const Friction &, bool);

} // namespace tribogel
