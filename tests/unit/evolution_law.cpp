#include "evolution_law.hpp"

#include "matrix_reference.hpp"

#include <boost/numeric/odeint.hpp>

namespace samples
{

using reference::Real;

std::vector<double> integrate_flow(const Viscoelastic<double> &material,
                                   Matrix3<double> (*deformation)(double), double end)
{
  const auto law = reference::law(material);
  const auto rhs = [&](const std::vector<double> &x, std::vector<double> &dxdt, double t) {
    const reference::Matrix F = reference::lift(deformation(t)), inverse = F.inverse();
    for (std::size_t m = 0; m < law.branches.size(); ++m) {
      const reference::Matrix X =
          reference::lift(from_mandel<double>(Eigen::Map<const Mandel<double>>(&x[6 * m])));
      const reference::Matrix be = F * X * F.transpose();
      const auto flow =
          law.branches[m].flow(law.branches[m].spring.stress(reference::logarithm(be) / Real(2)));
      const reference::Matrix rate = Real(-2) * inverse * flow * be * inverse.transpose();
      Eigen::Map<Mandel<double>> out(dxdt.data() + 6 * m);
      out = to_mandel<double>(rate.real().cast<double>());
    }
  };
  std::vector<double> x(material.history_size());
  material.initial_history(x.data());
  namespace ode = boost::numeric::odeint;
  ode::integrate_adaptive(
      ode::make_controlled(1e-12, 1e-12, ode::runge_kutta_fehlberg78<std::vector<double>>()), rhs, x, 0.0,
      end, 0.01);
  return x;
}

} // namespace samples
