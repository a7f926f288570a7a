/// Hertz's contact, C5: for the measured force N
///
///     a^3 = 3 N R/(4 E*),   p = 3 N/(2 pi a^2) sqrt(1 - r^2/a^2),   approach = a^2/R,   1/E* = 2 (1 - nu^2)/E.
///
/// The contact radius is taken from the second moment of the pressure, int p r^2 = (2/5) a^2 N, which varies smoothly
/// with the state; the outermost node under pressure is known to a facet only. Errors depend on where in its facet the
/// edge lies, so they are root mean squares over four loads.
///
/// The approach of finite blocks of width L is a^2/R + c N/L (1 + O(a^2/L^2)) (c: the displacement that a point force
/// leaves out by having no half-space behind L), with the same c for similar blocks: two widths and two unknowns give
/// the factor of a^2/R.
#include "hertz.hpp"

namespace tribogel::test
{

namespace
{

constexpr double parts[4] = {0.72, 0.83, 0.91, 1}; // of the contact radius, the loads

/// Relative errors. `nodal` is the largest difference to the ellipse within 0.9 a, over the peak; `edge` the distance
/// from a to the outermost node under pressure, over the facet there.
struct Errors {
  double radius = 0, centre = 0, pressure = 0, nodal = 0, edge = 0;
  PetscInt unknowns = 0, newton = 0;
  double force = 0; ///< at the last load [N]
};

void add_load(const HertzScene &is, const Recorder &recorder, const ContactGeometry &geometry, Errors &sum)
{
  const Measurement &m = recorder.rows.back().measurement;
  const Hertz hertz(is, m.normal_force);
  double force = 0, moment = 0, difference = 0, square = 0, centre = 0, nodal = 0;
  const double facet = is.a / 4 * std::pow(0.5, is.level);
  for (std::size_t n = 0; n < geometry.nodes.size(); ++n) {
    if (!geometry.nodes[n].carries) continue;
    const ProfileRow &row = recorder.last_profile[n];
    const double D = geometry.nodes[n].D, p = row.pressure, error = p - hertz.pressure(row.r);
    force += D * p;
    moment += D * p * row.r * row.r;
    difference += D * error * error;
    square += D * std::pow(hertz.pressure(row.r), 2);
    if (centre == 0) centre = error / hertz.pressure(row.r);
    if (row.r < 0.9 * hertz.radius) nodal = std::max(nodal, std::abs(error) / hertz.peak);
  }
  EXPECT_NEAR(force / hertz.N, 1, 1e-7);
  sum.radius += std::pow(std::sqrt(2.5 * moment / force) / hertz.radius - 1, 2) / 4;
  sum.centre += centre * centre / 4;
  sum.pressure += difference / square / 4;
  sum.nodal = std::max(sum.nodal, nodal);
  sum.edge = std::max(sum.edge, std::abs(m.contact_radius - hertz.radius) / facet);
  sum.force = m.normal_force;
}

Errors errors_of(const HertzScene &is)
{
  std::vector<double> times, approach;
  for (double part : parts) {
    times.push_back(static_cast<double>(times.size() + 1));
    approach.push_back(is.approach(part) * 1.06); // what finite blocks give way less
  }
  const SolverOptions options(fixed_steps(1, 1e-10));
  Problem problem;
  Recorder recorder("");
  Errors sum;
  recorder.on_row = [&](const HistoryRow &row) {
    sum.newton += row.report.newton_iterations;
    if (row.time > 0) add_load(is, recorder, problem.contact->model().reference(), sum);
  };
  run(is.scene(schedule_from_rates(times, approach, std::vector<double>(4, 0))), is.blocks(), problem, recorder);
  sum.unknowns = problem.mesh.unknowns;
  for (double *square : {&sum.radius, &sum.centre, &sum.pressure}) *square = std::sqrt(*square);
  return sum;
}

Errors print_errors(const HertzScene &is)
{
  const Errors e = errors_of(is);
  std::printf(
      "order %d a/h %3d unknowns %6d newton %2d: errors of radius %.2e, centre %.2e, pressure %.2e, nodal %.2e; "
      "edge %.2f\n",
      is.order, 4 << is.level, static_cast<int>(e.unknowns), static_cast<int>(e.newton), e.radius, e.centre, e.pressure,
      e.nodal, e.edge);
  std::fflush(stdout);
  return e;
}

} // namespace

TEST(hertz, RadiusAndPressure)
{
  for (int order : {1, 2})
    for (int level : {0, 1, 2}) print_errors({order, level});
}

TEST(hertz, DISABLED_Table)
{
  for (int order : {1, 2})
    for (int level : {0, 1, 2, 3}) print_errors({order, level});
}

} // namespace tribogel::test
