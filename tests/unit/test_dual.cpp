#include "tribogel/math/dual.hpp"
#include "tribogel/math/tensor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <functional>
#include <limits>

using namespace tribogel;

namespace
{

using D1 = Dual<1>;
using D2 = Dual<2>;
using Complex = std::complex<double>;

struct ElementaryCase {
  const char *name;
  std::function<D1(D1)> dual;
  std::function<Complex(Complex)> complex; // its complex step is an independent exact derivative
  double at;
};

TEST(Dual, elementary_functions_have_the_derivative_of_a_complex_step)
{
  const std::vector<ElementaryCase> cases = {
      {"sqrt", [](D1 x) { return sqrt(x); }, [](Complex x) { return std::sqrt(x); }, 2.3},
      {"cbrt", [](D1 x) { return cbrt(x); }, [](Complex x) { return std::pow(x, 1.0 / 3); }, 2.3},
      {"exp", [](D1 x) { return exp(x); }, [](Complex x) { return std::exp(x); }, -0.7},
      {"expm1", [](D1 x) { return expm1(x); }, [](Complex x) { return std::exp(x) - 1.0; }, 0.6},
      {"log", [](D1 x) { return log(x); }, [](Complex x) { return std::log(x); }, 0.4},
      {"log1p", [](D1 x) { return log1p(x); }, [](Complex x) { return std::log(1.0 + x); }, 0.7},
      {"sin", [](D1 x) { return sin(x); }, [](Complex x) { return std::sin(x); }, 0.7},
      {"cos", [](D1 x) { return cos(x); }, [](Complex x) { return std::cos(x); }, 0.7},
      {"tan", [](D1 x) { return tan(x); }, [](Complex x) { return std::tan(x); }, 0.7},
      {"atan", [](D1 x) { return atan(x); }, [](Complex x) { return std::atan(x); }, 0.7},
      {"sinh", [](D1 x) { return sinh(x); }, [](Complex x) { return std::sinh(x); }, 0.7},
      {"cosh", [](D1 x) { return cosh(x); }, [](Complex x) { return std::cosh(x); }, 0.7},
      {"tanh", [](D1 x) { return tanh(x); }, [](Complex x) { return std::tanh(x); }, 0.7},
      {"pow", [](D1 x) { return pow(x, 2.4); }, [](Complex x) { return std::pow(x, 2.4); }, 1.7},
      {"abs", [](D1 x) { return abs(x); }, [](Complex x) { return -x; }, -1.7},
      {"x^x", [](D1 x) { return pow(x, x); }, [](Complex x) { return std::pow(x, x); }, 1.7},
      {"b^x", [](D1 x) { return pow(2.6, x); }, [](Complex x) { return std::pow(2.6, x); }, 1.7},
      {"hypot", [](D1 x) { return hypot(x, 3 * x + 1); },
       [](Complex x) { return std::sqrt(x * x + (3.0 * x + 1.0) * (3.0 * x + 1.0)); }, 1.7},
      {"atan2", [](D1 x) { return atan2(x, 2 - x); }, [](Complex x) { return std::atan(x / (2.0 - x)); },
       0.8},
      {"mixed", [](D1 x) { return (2 - x) * (x + 3) / (x - 5) - 4 / x + x / 7 * 2 + (-x) * (+x); },
       [](Complex x) { return (2.0 - x) * (x + 3.0) / (x - 5.0) - 4.0 / x + x / 7.0 * 2.0 - x * x; }, 0.8},
      {"compound",
       [](D1 x) {
         D1 y = x;
         y += 3 * x;
         y -= x * x;
         y *= x + 1;
         y /= x + 2;
         y += 2;
         y -= 7;
         y *= 3;
         y /= 11;
         return y;
       },
       [](Complex x) { return ((4.0 * x - x * x) * (x + 1.0) / (x + 2.0) - 5.0) * 3.0 / 11.0; }, 0.8}};
  for (const ElementaryCase &c : cases) {
    const Complex expected = c.complex(Complex(c.at, 1e-30));
    const D1 got = c.dual(D1::seed(c.at, 0));
    EXPECT_NEAR(got.v, expected.real(), 4e-15 * (1 + std::abs(expected.real()))) << c.name;
    EXPECT_NEAR(got.d[0], expected.imag() / 1e-30, 1e-14 * (1 + std::abs(got.d[0]))) << c.name;
  }
}

TEST(Dual, directions_do_not_mix)
{
  const D2 x = D2::seed(3, 0), y = D2::seed(-2, 1);
  const D2 f = x * x * y + y / x;
  EXPECT_DOUBLE_EQ(f.d[0], 2 * 3 * -2 + 2.0 / 9);
  EXPECT_DOUBLE_EQ(f.d[1], 9 + 1.0 / 3);
  const D2 angle = atan2(y, x);
  EXPECT_DOUBLE_EQ(angle.d[0], 2.0 / 13);
  EXPECT_DOUBLE_EQ(angle.d[1], 3.0 / 13);
}

TEST(Dual, compares_by_value)
{
  const D2 x = D2::seed(3, 0), y = D2::seed(3, 1);
  EXPECT_TRUE(x == y && x <= y && x >= y && !(x != y) && !(x < y) && !(x > y));
  EXPECT_TRUE(x < 4 && 2 < x && x > 2.5 && x != 4);
  EXPECT_EQ(std::max(x, D2(2)).d[0], 1);
}

TEST(Dual, kinks_and_powers_at_zero_are_finite)
{
  const D2 x = D2::seed(0, 0), y = D2::seed(0, 1);
  EXPECT_TRUE(isfinite(pow(x, 0)) && isfinite(pow(x, 1)) && isfinite(pow(x, 2.5)) && isfinite(hypot(x, y)));
  EXPECT_TRUE(isfinite(abs(x)) && isfinite(pow(x, D2::seed(2, 1))));
  EXPECT_EQ(pow(x, 1).d[0], 1);
  EXPECT_EQ(pow(x, 0).v, 1);
}

TEST(Dual, tells_what_is_not_finite)
{
  const double infinity = std::numeric_limits<double>::infinity();
  D2 x = 3.5;
  EXPECT_TRUE(isfinite(x) && !isnan(x));
  x.d[1] = infinity;
  EXPECT_TRUE(!isfinite(x) && !isnan(x));
  x.d[0] = infinity - infinity;
  EXPECT_TRUE(!isfinite(x) && isnan(x));
  EXPECT_FALSE(isfinite(D2(infinity)));
}

TEST(Dual, works_inside_eigen)
{
  const Matrix3<double> A = (Matrix3<double>() << 2, -0.5, 0.3, 0.7, 3, 0.2, -0.4, 0.6, 1.5).finished();
  const Matrix3<double> B = (Matrix3<double>() << 0.3, 1.5, -1, 0.4, 0.2, 0.9, 2, -0.7, 0.8).finished();
  const D2 t = D2::seed(0, 1);
  const Matrix3<D2> M = A + t * B;
  const Matrix3<double> inverse = A.inverse(), d_inverse = -inverse * B * inverse;
  EXPECT_LT((derivative(M.inverse().eval(), 1) - d_inverse).norm(), 1e-14);
  EXPECT_LT((value(M.inverse().eval()) - inverse).norm(), 1e-15);
  EXPECT_EQ(derivative(M, 0).norm(), 0);
  EXPECT_NEAR(M.determinant().d[1], A.determinant() * (inverse * B).trace(), 1e-13);
  EXPECT_NEAR(M.norm().d[1], A.cwiseProduct(B).sum() / A.norm(), 1e-14);
  const Matrix3<D2> product = 2 * A * M * B - M / 3;
  EXPECT_LT((derivative(product, 1) - (2 * A * B * B - B / 3)).norm(), 1e-14);
}

TEST(Dual, parameters_become_the_scalar_of_the_computation)
{
  const D2 p = D2::seed(3.5, 1);
  EXPECT_EQ(as_scalar<double>(p), 3.5);
  EXPECT_EQ(as_scalar<D2>(p).d[1], 1);
  EXPECT_EQ(as_scalar<D2>(3.5).d[1], 0);
  EXPECT_EQ(as_scalar<double>(3.5), 3.5);
}

} // namespace
