#include "contact/kernels.hpp"

namespace tribogel
{

template QuadMeasure<1> quad_measure(const QuadPoints<1> &);
template QuadMeasure<2> quad_measure(const QuadPoints<2> &);
template QuadPairMortar<1> quad_pair_mortar(const QuadMeasure<1> &, const QuadPair<1> &, bool);
template QuadPairMortar<2> quad_pair_mortar(const QuadMeasure<2> &, const QuadPair<2> &, bool);
template QuadPairMortars<1> quad_element_mortar(const QuadMeasure<1> &, const QuadPairs<1> &, bool);
template QuadPairMortars<2> quad_element_mortar(const QuadMeasure<2> &, const QuadPairs<2> &, bool);

template Eigen::Matrix<double, 3, 10> condition_slope<10>(const ContactPoint<double> &, const ContactScale &,
                                                          const Friction &, bool);
template Eigen::Matrix<double, 3, 11> condition_slope<11>(const ContactPoint<double> &, const ContactScale &,
                                                          const Friction &, bool);

} // namespace tribogel
