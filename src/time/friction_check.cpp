/// Is the friction law asked what it can answer? Looked at after each accepted step, if the law gives cause.
#include "support/petsc_arrays.hpp"
#include "time/stepper.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tribogel
{

namespace
{

struct FrictionCheck {
  double lowest = 0;    ///< coefficient, if negative
  double at_radius = 0; ///< of that node, now [mm]
  double at_speed = 0;  ///< its speed [mm/s]
  double fastest = 0;   ///< sliding speed [mm/s]
  double growth =
      0; ///< in which a disturbance of the sliding grows e-fold, the longest time; 0: none grows [s]
  double critical = 0; ///< with memory: stiffness below which steady sliding is unstable [MPa/mm]
};

/// Tangential stiffness of the gels in series, sheared as a whole: the softest way in which all nodes can
/// slide [MPa/mm].
double shear_stiffness(const Scene &scene)
{
  double compliance = 0;
  for (const Specimen *gel : scene.gels())
    compliance += gel->height / gel->material.equilibrium.shear_modulus();
  return 1 / compliance;
}

/// Without inertia k dx = -tau'(v) dv at a node that slides: where tau falls, dx grows with the time -tau'/k.
/// A law with memory rises at once, and falls at its rate of forgetting r: with springs softer than -tau' r,
/// tau' that of steady sliding (Ruina 1983).
FrictionCheck look(const Scene &scene, const ContactResults &results)
{
  FrictionCheck found;
  const double stiffness = shear_stiffness(scene);
  for (const SurfaceResults &surface : results.surfaces)
    for (std::size_t a = 0; a < surface.nodes.size(); ++a) {
      const NodeResult &node = surface.nodes[a];
      if (!node.carries || node.status != ContactStatus::slip || !(node.pressure > 0)) continue;
      const double v = node.velocity.norm(), mu = scene.friction.coefficient(v, node.pressure);
      found.fastest = std::max(found.fastest, v);
      const double fall = -scene.friction.slope(v, node.pressure);
      if (scene.friction.has_memory())
        found.critical = std::max(found.critical, fall * scene.friction.law()->memory_rate(v));
      else
        found.growth = std::max(found.growth, fall / stiffness);
      if (mu < found.lowest) {
        found.lowest = mu;
        found.at_speed = v;
        found.at_radius = surface.slave[a].current[0];
      }
    }
  return found;
}

// What there is to say: a text of its own each, so that none can run into another.

std::string about_negative_friction(const FrictionCheck &found, double time)
{
  std::ostringstream text;
  text << "the friction coefficient is " << found.lowest << " at t = " << time
       << " s, r = " << found.at_radius << " mm, where the gels slide at " << found.at_speed
       << " mm/s: the law is used beyond the speeds it is good for";
  return text.str();
}

std::string about_speed(const FrictionCheck &found, double time, double highest)
{
  std::ostringstream text;
  text << "t = " << time << " s: the gels slide at up to " << found.fastest
       << " mm/s, faster than -friction_speed_range, which ends at " << highest << " mm/s";
  return text.str();
}

std::string about_end_of_law(const FrictionLaw &law, const FrictionCheck &found, double time)
{
  std::ostringstream text;
  text << "t = " << time << " s: the gels slide at up to " << found.fastest << " mm/s; the law "
       << law.declaration().name << " ends at " << law.highest_speed() << " mm/s";
  return text.str();
}

std::string about_instability(const FrictionCheck &found, double time)
{
  std::ostringstream text;
  text << "t = " << time
       << " s: friction falls with the speed where the gels slide: steady sliding is unstable, a "
       << "disturbance grows e-fold in " << found.growth
       << " s, and steps longer than that do not show it. N and T are those of undisturbed sliding, but such "
          "an "
          "interface sticks and slips for itself";
  return text.str();
}

std::string about_critical_stiffness(const FrictionCheck &found, double time, double stiffness)
{
  std::ostringstream text;
  text << "t = " << time
       << " s: friction in steady sliding falls with the speed, which needs a stiffness of more than "
       << found.critical << " MPa/mm to be stable; sheared as a whole the gels have " << stiffness
       << " MPa/mm: such an interface sticks and slips for itself";
  return text.str();
}

std::string about_weakening(const FrictionCheck &found, double time, double step)
{
  std::ostringstream text;
  text << "t = " << time << " s: friction falls with the speed " << found.growth / step
       << " times faster than the gels' stiffness can hold over a step of " << step
       << " s: the sliding state is not unique and what follows is one of several. Such an interface sticks "
          "and slips "
          "for itself; a law with a rising branch at the speeds in question, lower rates or a stiffer "
          "specimen avoid "
          "it";
  return text.str();
}

std::string about_early_end(int phase, double time, double left)
{
  std::ostringstream text;
  text << "phase " << phase + 1 << ": N and T have stopped changing at t = " << time << " s; the other "
       << left << " s are one step";
  return text.str();
}

} // namespace

PetscErrorCode Stepper::CheckFriction()
{
  LocalVector U, Udot;
  ConstArray u, rate;
  ContactResults results;
  PetscFunctionBeginUser;
  const FrictionLaw *law = scene.friction.law();
  const double highest = law ? law->highest_speed() : 0;
  const bool asks = law && (law->may_fall() || std::isfinite(highest) || scene.friction_speeds);
  if (!contact || !contact->between_gels() || !asks) PetscFunctionReturn(0);
  PetscCall(U.Get(mesh.dm));
  PetscCall(Udot.Get(mesh.dm));
  PetscCall(LocalState(U, Udot));
  PetscCall(u.Get(U));
  PetscCall(rate.Get(Udot));
  PetscCall(contact->Results(plates_now(), u, rate, results, friction_now()));

  const FrictionCheck found = look(scene, results);
  const bool turned = state.time == phase().end_time && phase().rate != scene.bottom_plate_rate;
  if (found.lowest < 0) stop.give_up(about_negative_friction(found, state.time));
  if (found.fastest > highest) stop.give_up(about_end_of_law(*law, found, state.time));
  if (scene.friction_speeds && found.fastest > (*scene.friction_speeds)[1] && !told.beyond_speeds) {
    told.beyond_speeds = true;
    PetscCall(Notify(about_speed(found, state.time, (*scene.friction_speeds)[1])));
  }
  if (found.growth > state.step && !told.not_unique) {
    told.not_unique = true;
    PetscCall(Notify(about_weakening(found, state.time, state.step)));
  } else if (found.growth > 0 && turned && !told.not_unique && !told.unstable) {
    told.unstable = true;
    PetscCall(Notify(about_instability(found, state.time)));
  }
  if (found.critical > shear_stiffness(scene) && turned && !told.unstable) {
    told.unstable = true;
    PetscCall(Notify(about_critical_stiffness(found, state.time, shear_stiffness(scene))));
  }
  PetscFunctionReturn(0);
}

/// Once N and T would change by less than asked for even if they went on as fast as now, the rest of a phase
/// at constant approach is one step.
PetscErrorCode Stepper::EndPhaseEarly()
{
  PetscFunctionBeginUser;
  const Phase &now = phase();
  const double left = now.end_time - state.time;
  if (!(scene.phase_end_tolerance > 0) || left <= 0 || now.approach_rate() != 0 || state.steps_in_phase < 3)
    PetscFunctionReturn(0);
  for (int k = 0; k < 2; ++k)
    if (std::abs(state.load_rates[k]) * left > scene.phase_end_tolerance / 100 * state.largest[k])
      PetscFunctionReturn(0);
  PetscCall(TSSetTimeStep(ts, left));
  if (told.ended_early != state.phase) PetscCall(Notify(about_early_end(state.phase, state.time, left)));
  told.ended_early = state.phase;
  PetscFunctionReturn(0);
}

PetscErrorCode Stepper::Notify(const std::string &text)
{
  PetscFunctionBeginUser;
  for (Observer *observer : watching) PetscCall(observer->Notice(*watched, text));
  PetscFunctionReturn(0);
}

} // namespace tribogel
