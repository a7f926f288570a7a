/// Manufactured solutions (manufactured.hpp). Rates of the norms over the reference volume: k + 1 in L2,
/// k in H1 at order k.
#include "manufactured.hpp"
#include "solids.hpp"

#include "tribogel/kinematics/axisymmetric.hpp"
#include "tribogel/kinematics/solid.hpp"

namespace tribogel::test
{

namespace
{

constexpr double a = 4.5, height = 3;
using Plane = std::array<double, 2>;
using Field = AxisymmetricTorsion::Field<double>;

/// Unknowns (u_R, L phi, u_Z) and their gradients. On the axis u_R is odd in R, the others even. u_R and u_Z
/// come from a stream function, so that the volume changes in second order only: with K/G = 20 more would
/// mean pressures far above G, under which the dead load has no unique solution.
Field exact_field(const Plane &X)
{
  using D = Dual<2>;
  const D R = D::seed(X[0], 0), s = D::seed(X[1], 1) / height, q = R * R / (a * a);
  const D g = 0.4 * sin(1.7 * s + 0.5), slope = 0.4 * 1.7 / height * cos(1.7 * s + 0.5);
  const D u[3] = {-0.5 * R * (1 - 0.4 * q) * slope, 0.9 * (0.7 + 0.6 * q) * sin(1.3 * s - 0.4),
                  (1 - 0.8 * q) * g};
  Field field;
  for (int i = 0; i < 3; ++i) {
    field.u[i] = u[i].v;
    field.grad[i] = u[i].d;
  }
  return field;
}

template <class Errors> void judge(const Errors &e, const Errors &before, double ratio, int order)
{
  std::printf("L2 %.3e H1 %.3e", e.L2, e.H1);
  if (before.L2 > 0) {
    const double rates[2] = {std::log(before.L2 / e.L2) / std::log(ratio),
                             std::log(before.H1 / e.H1) / std::log(ratio)};
    std::printf(" rates %.3f %.3f", rates[0], rates[1]);
    EXPECT_GT(rates[0], order + 1 - 0.15);
    EXPECT_GT(rates[1], order - 0.1);
  }
  std::printf("\n");
}

/// K/G = 20.
const Viscoelastic<double> gel{{{0.75, 0.45, 0.18}, {1.3, 2, 5}, 28}, {}};

template <int order> void expect_rates(double distortion)
{
  Manufactured<AxisymmetricTorsion>::Errors before;
  for (int elements : {6, 12, 24}) {
    Scene scene = cylinder(a, height, gel, order, elements);
    scene.schedule = schedule_from_twists({1}, {0}, {0});
    Problem problem;
    ASSERT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene), 0);
    if (distortion > 0) {
      distort(problem.system.mesh, a, height, a / elements, distortion);
      ASSERT_EQ(Bulk::Create(problem.system.mesh, problem.system.scene, problem.system.bulk), 0);
    }
    const Manufactured<AxisymmetricTorsion> is{{scene.twist_length()}, exact_field};
    const auto e = is.errors_of<order>(problem);
    std::printf("order %d distortion %.2f elements %2d: ", order, distortion, elements);
    judge(e, before, 2, order);
    before = e;
  }
}

/// In a block, with gradients up to 0.1 in all shears; the volume changes in second order only.
Solid::Field<double> solid_field(const std::array<double, 3> &X)
{
  using D = Dual<3>;
  const D x = D::seed(X[0], 0), y = D::seed(X[1], 1), z = D::seed(X[2], 2);
  const D u[3] = {0.11 * sin(0.9 * y - 0.7 * z + 0.3), 0.13 * sin(0.8 * z + 0.6 * x),
                  0.12 * cos(0.7 * x + 0.8 * y)};
  Solid::Field<double> field;
  for (int i = 0; i < 3; ++i) {
    field.u[i] = u[i].v;
    field.grad[i] = u[i].d;
  }
  return field;
}

/// A block whose inside is bent smoothly, so that cells become parallelepipeds under refinement.
void bend(Mesh &mesh)
{
  for (Node &node : mesh.nodes) {
    const double pi = std::numbers::pi, bump = 0.12 * std::sin(pi * node.X[0] / 2) *
                                               std::sin(pi * node.X[1] / 2) *
                                               std::sin(pi * node.X[2] / height);
    node.X[0] += bump * std::cos(1.3 * node.X[1]);
    node.X[1] -= bump;
    node.X[2] += bump * std::sin(2 * node.X[0]);
  }
}

template <int order> void expect_solid_rates(const std::vector<int> &cells)
{
  Manufactured<Solid>::Errors before;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const int n = cells[k];
    const Box box{{even(0, 2, n), even(0, 2, n), even(-height, 0, n)},
                  {Side::wall, Side::wall, Side::wall, Side::wall, Side::bottom_plate, Side::top_plate}};
    Scene scene = solid_cylinder(1, height, gel, order, n);
    scene.schedule = schedule_from_twists({1}, {0}, {0});
    Problem problem;
    ASSERT_EQ(problem.SetUp(PETSC_COMM_WORLD, scene, box.mesh()), 0);
    bend(problem.system.mesh);
    ASSERT_EQ(Bulk::Create(problem.system.mesh, problem.system.scene, problem.system.bulk), 0);
    const auto e = Manufactured<Solid>{{}, solid_field}.errors_of<order>(problem);
    std::printf("solid, order %d cells %2d^3: ", order, n);
    judge(e, before, k ? static_cast<double>(n) / cells[k - 1] : 1, order);
    before = e;
  }
}

} // namespace

TEST(manufactured, LinearElementsConvergeAtOrderTwo)
{
  expect_rates<1>(0);
  expect_rates<1>(0.15);
}

TEST(manufactured, QuadraticElementsConvergeAtOrderThree)
{
  expect_rates<2>(0);
  expect_rates<2>(0.15);
}

TEST(manufactured, LinearHexahedraConvergeAtOrderTwo)
{
  expect_solid_rates<1>({4, 8, 12});
}

TEST(manufactured, QuadraticHexahedraConvergeAtOrderThree)
{
  expect_solid_rates<2>({2, 4, 6});
}

} // namespace tribogel::test
