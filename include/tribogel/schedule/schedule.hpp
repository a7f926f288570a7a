/// The rheometer's schedule: a list of phases, in each of which the top plate travels linearly in time to a
/// given approach while it turns at a constant rate.
#pragma once

#include <cstddef>
#include <vector>

namespace tribogel
{

struct Phase {
  double start_time, end_time;         ///< [s]
  double start_approach, end_approach; ///< travel of the top plate towards the bottom one since t = 0 [mm]
  double start_rotation;               ///< angle of the top plate at the start of the phase [rad]
  double rate;                         ///< of the top plate about +z [rad/s]

  double duration() const { return end_time - start_time; }                                       ///< [s]
  double approach_rate() const { return (end_approach - start_approach) / duration(); }           ///< [mm/s]
  double approach(double t) const { return start_approach + approach_rate() * (t - start_time); } ///< [mm]
  double rotation(double t) const { return start_rotation + rate * (t - start_time); }            ///< [rad]
  double end_rotation() const { return rotation(end_time); }                                      ///< [rad]
};

using Schedule = std::vector<Phase>;

/// Phases from the users' lists: absolute end times [s], total approach at each end [mm], rate in each phase
/// [rad/s]. The lists have equal lengths.
inline Schedule schedule_from_rates(const std::vector<double> &end_times, const std::vector<double> &approach,
                                    const std::vector<double> &rates)
{
  Schedule schedule;
  Phase last{0, 0, 0, 0, 0, 0};
  for (std::size_t k = 0; k < end_times.size(); ++k) {
    const double rotation = k ? last.end_rotation() : 0;
    last = Phase{last.end_time, end_times[k], last.end_approach, approach[k], rotation, rates[k]};
    schedule.push_back(last);
  }
  return schedule;
}

/// The same with the angle reached at each phase's end [rad]; within a phase the plate turns uniformly.
inline Schedule schedule_from_twists(const std::vector<double> &end_times,
                                     const std::vector<double> &approach, const std::vector<double> &twists)
{
  std::vector<double> rates;
  for (std::size_t k = 0; k < end_times.size(); ++k)
    rates.push_back((twists[k] - (k ? twists[k - 1] : 0)) / (end_times[k] - (k ? end_times[k - 1] : 0)));
  return schedule_from_rates(end_times, approach, rates);
}

} // namespace tribogel
