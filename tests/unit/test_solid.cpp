/// The element in space: its forces and tangent against dual numbers, to round-off.
#include "material_samples.hpp"

#include "tribogel/element/mean_dilatation.hpp"
#include "tribogel/kinematics/solid.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>

using namespace tribogel;

namespace
{

template <int order> struct Brick {
  using Element = MeanDilatation<Solid, order>;
  using CellType = typename Element::CellType;
  template <class T> using Vector = typename Element::template Vector<T>;

  CellType cell;
  Vector<double> U;

  /// All nodes moved at random, midside ones too; displacements of up to a tenth of the edge.
  explicit Brick(unsigned seed)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> in(-1, 1);
    std::array<std::array<double, 3>, Element::nodes> X;
    constexpr double size[3] = {1.3, 0.9, 1.1};
    for (int a = 0; a < Element::nodes; ++a)
      for (int j = 0, rest = a; j < 3; ++j, rest /= order + 1)
        X[a][j] = size[j] * (static_cast<double>(rest % (order + 1)) / order + 0.08 * in(random));
    EXPECT_TRUE(cell.set(X));
    for (int k = 0; k < Element::dofs; ++k) U[k] = 0.1 * in(random);
  }
};

template <int order> void expect_exact_tangent(const Viscoelastic<double> &material, const StepWeights step)
{
  using D = Dual<1>;
  using B = Brick<order>;
  using Element = typename B::Element;
  const B brick(5);
  const int size = material.history_size();
  std::vector<double> history;
  for (int q = 0; q < Element::points; ++q) {
    const std::vector<double> some = samples::history(material, 17 + q);
    history.insert(history.end(), some.begin(), some.end());
  }
  ASSERT_EQ(static_cast<int>(history.size()), size * Element::points);
  const std::vector<D> lifted(history.begin(), history.end());
  const auto evaluation = std::make_unique<typename Element::template Evaluation<double>>();
  const auto moved = std::make_unique<typename Element::template Evaluation<D>>();
  const auto K = std::make_unique<typename Element::Matrix>();
  ASSERT_EQ(evaluation->set({}, brick.cell, material, brick.U, history.data(), step, nullptr, true),
            PointStatus::ok);
  const auto R = Element::template forces<double>({}, brick.cell, *evaluation);
  Element::tangent({}, brick.cell, *evaluation, *K);
  const double scale = K->cwiseAbs().maxCoeff();
  EXPECT_LT((*K - K->transpose()).cwiseAbs().maxCoeff(), 1e-14 * scale);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> in(-1, 1);
  for (int repeat = 0; repeat < 3; ++repeat) {
    typename B::template Vector<double> w;
    typename B::template Vector<D> U;
    for (int k = 0; k < Element::dofs; ++k) {
      w[k] = in(random);
      U[k] = D(brick.U[k]);
      U[k].d[0] = w[k];
    }
    ASSERT_EQ(moved->set({}, brick.cell, material.cast<D>(), U, lifted.data(), step, nullptr, false),
              PointStatus::ok);
    const auto exact = Element::template forces<D>({}, brick.cell, *moved);
    const typename B::template Vector<double> product = *K * w;
    double worst = 0;
    for (int k = 0; k < Element::dofs; ++k) {
      worst = std::max(worst, std::abs(product[k] - exact[k].d[0]));
      EXPECT_NEAR(R[k], exact[k].v, 1e-12 * scale);
    }
    EXPECT_LT(worst, 1e-12 * scale * Element::dofs);
    EXPECT_GT(product.norm(), 1e-3 * scale);
  }
}

} // namespace

TEST(Solid, TangentIsTheDerivativeOfTheForces)
{
  for (const auto &material : {samples::paper(), samples::odd(), samples::hyperelastic()})
    for (double step : {0.0, 0.37}) {
      expect_exact_tangent<1>(material, {step});
      expect_exact_tangent<2>(material, {step});
    }
}

/// The linear field x = F X has the deformation F at every point of a distorted cell.
TEST(Solid, LinearFieldsAreReproduced)
{
  const Brick<2> brick(9);
  Matrix3<double> H;
  H << 0.2, 0.1, -0.3, 0.05, -0.1, 0.2, 0.15, -0.2, 0.1;
  for (const auto &p : brick.cell.point) {
    Solid::Field<double> field{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) field.grad[i][j] = H(i, j);
    EXPECT_LT((Solid{}.deformation(p.X, field) - Matrix3<double>::Identity() - H).norm(), 1e-15);
    double sum[4] = {};
    for (int k = 0; k < 4; ++k)
      for (double N : p.shape[k]) sum[k] += N;
    EXPECT_NEAR(sum[0], 1, 1e-14);
    for (int k = 1; k < 4; ++k) EXPECT_NEAR(sum[k], 0, 1e-13);
  }
}
