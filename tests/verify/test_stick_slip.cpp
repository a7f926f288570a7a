/// High friction, mu = 0.5 at any speed, on the paper's rheometer with elastic gels: pressed while they
/// stick, turned from rest through partial slip to full slip, and back to full slip the other way, in steps
/// that the program chooses. In full slip each node carries mu times its pressure against its sliding
/// velocity, hence
///
///     T = mu sum_a A_a p_a r_a cos(angle of the sliding velocity from the circle)
///
/// with the nodes' current areas, exactly for the discrete operator. Elastic gels forget the way: full slip
/// backwards has the same torque with the other sign.
#include "scenes.hpp"
#include "solver_options.hpp"
#include "tribogel/friction/polynomial.hpp"

#include <algorithm>
#include <cmath>

namespace tribogel::test
{

namespace
{

constexpr double mu = 0.5;

Scene turned_and_back(int order)
{
  Scene scene = paper_scene(4, order);
  scene.top.material = scene.bottom.material = hyperelastic_gel();
  scene.friction = PolynomialFriction<double>{{mu}, {0}};
  scene.time.rule = TimeRule::exponential_euler; // one solve a step: its iterations are counted
  scene.schedule = schedule_from_rates({27, 727, 2127}, {0.79, 0.79, 0.79}, {0, 0.01, -0.01});
  return scene;
}

/// The torque of full slip from the nodes' pressures, and the same as if all slid along the circle.
struct SlipTorque {
  double exact = 0, circumferential = 0;
  int slipping = 0, others = 0;
};

SlipTorque slip_torque(const Problem &problem, const std::vector<ProfileRow> &profile)
{
  SlipTorque sum;
  const std::vector<SurfaceNode> &nodes = problem.system.mesh.slave.node;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const NodeResult node = problem.system.contact->lower_face().result(static_cast<int>(a));
    const double R = nodes[a].X[0];
    if (!node.carries || R == 0) continue;
    const auto row = std::find_if(profile.begin(), profile.end(), [&](const ProfileRow &at) {
      return at.surface == std::string("top") && at.reference_z == 0 && at.reference_r == R;
    });
    EXPECT_NE(row, profile.end());
    ++(node.status == ContactStatus::slip ? sum.slipping : sum.others);
    const double limit = mu * node.pressure * node.area * row->r;
    sum.circumferential += limit;
    sum.exact += limit * node.velocity[1] / node.velocity.norm();
  }
  return sum;
}

/// Forth and back T is monotone up to full slip, where it overshoots a little (0.06 % at order 2, 0.35 % at
/// order 1).
void check_branches(const std::vector<HistoryRow> &rows, double full)
{
  double before = 0;
  for (const HistoryRow &row : rows) {
    EXPECT_LE(row.report.newton_iterations, 6) << row.time;
    const double direction = row.phase == 3 ? -1 : 1, torque = row.measurement.torque;
    if (row.phase == 1) {
      EXPECT_EQ(torque, 0) << row.time;
    } else if (direction * before < 0.98 * full) {
      EXPECT_GT(direction * (torque - before), 0) << row.time;
    }
    EXPECT_LT(std::abs(torque), 1.005 * full) << row.time;
    before = torque;
  }
}

} // namespace

TEST(stick_slip, FromRestToFullSlipAndBack)
{
  for (int order : {1, 2}) {
    const SolverOptions options(OptionList{{"-ts_atol", "1e-3"}, {"-snes_rtol", "1e-10"}});
    Problem problem;
    Recorder recorder("");
    run(turned_and_back(order), problem, recorder);
    ASSERT_EQ(recorder.phases.size(), 3u);
    const double forth = recorder.phases[1].measurement.torque, back = recorder.phases[2].measurement.torque;
    const SlipTorque full = slip_torque(problem, recorder.last_profile);
    EXPECT_GE(full.slipping, 4);
    EXPECT_EQ(full.others, 0);
    EXPECT_NEAR(full.exact / back, 1, 1e-10);
    EXPECT_NEAR(full.circumferential / -back, 1, 1e-5);
    EXPECT_NEAR(back / forth, -1, 1e-6);
    check_branches(recorder.rows, forth);
  }
}

} // namespace tribogel::test
