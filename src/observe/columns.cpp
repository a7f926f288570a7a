#include "observe/columns.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace tribogel
{

namespace
{

using R = const HistoryRow &;
using L = const ProfileLine &;

constexpr Column<HistoryRow> of_a_step[] = {
    {"time_s", "end of the step, since the start", [](R r) -> Cell { return r.time; }, true},
    {"phase", "of the schedule, counted from 1; a row at a phase's end belongs to the phase that ends",
     [](R r) -> Cell { return static_cast<long>(r.phase); }, true},
    {"approach_mm", "travel of the top plate since the start, initial gap included",
     [](R r) -> Cell { return r.approach; }, true},
    {"rotation_rad", "angle by which the top plate has turned", [](R r) -> Cell { return r.rotation; }, true},
    {"rate_rad_per_s", "at which it turns", [](R r) -> Cell { return r.rate; }, true},
    {"normal_force_N", "N, reaction of the top plate, positive in compression",
     [](R r) -> Cell { return r.measurement.normal_force; }, true},
    {"torque_Nmm", "T, of the top plate, positive when it opposes a rotation about +z",
     [](R r) -> Cell { return r.measurement.torque; }, true},
    {"contact_radius_mm", "largest radius at which the gels touch",
     [](R r) -> Cell { return r.measurement.contact_radius; }, true},
    {"mu_apparent",
     "coefficient by eq. (3.13) of the paper, from N, T and the law, as if the pressure were uniform",
     [](R r) -> Cell { return r.measurement.mu_apparent; }, true},
    {"mu_gong", "coefficient by eq. (2.3), 4 T / (3 R N) on a disc",
     [](R r) -> Cell { return r.measurement.mu_gong; }, true},
    {"mu_mean", "mean of |traction| / pressure over the touching points, unweighted: depends on the mesh",
     [](R r) -> Cell { return r.measurement.mu_mean; }, true},
    {"mu_area_weighted", "the same, weighted by area",
     [](R r) -> Cell { return r.measurement.mu_area_weighted; }, true},
    {"mu_pressure_weighted", "the same, weighted by pressure: friction force over normal force",
     [](R r) -> Cell { return r.measurement.mu_pressure_weighted; }, true},
    {"newton_iterations", "of the step that was accepted",
     [](R r) -> Cell { return static_cast<long>(r.report.newton_iterations); }},
    {"linear_iterations", "of that step",
     [](R r) -> Cell { return static_cast<long>(r.report.linear_iterations); }},
    {"step_s", "length of the step", [](R r) -> Cell { return r.step; }},
    {"contact_force_N", "N from the contact's tractions",
     [](R r) -> Cell { return r.measurement.contact_force; }},
    {"contact_torque_Nmm", "T from the contact's tractions",
     [](R r) -> Cell { return r.measurement.contact_torque; }},
    {"force_mismatch_N", "plate less contact", [](R r) -> Cell { return r.measurement.force_mismatch(); }},
    {"torque_mismatch_Nmm", "plate less contact",
     [](R r) -> Cell { return r.measurement.torque_mismatch(); }},
    {"work_of_plates_Nmm", "done on the gels since the start", [](R r) -> Cell { return r.energy.work; }},
    {"stored_energy_Nmm", "in the gels' springs", [](R r) -> Cell { return r.energy.stored; }},
    {"viscous_dissipation_Nmm", "heat in the gels since the start",
     [](R r) -> Cell { return r.energy.viscous; }},
    {"frictional_dissipation_Nmm", "heat between the gels since the start",
     [](R r) -> Cell { return r.energy.friction; }},
    {"transverse_force_x_N", "on the top plate, in the fixed frame",
     [](R r) -> Cell { return r.measurement.transverse_force[0]; }, true},
    {"transverse_force_y_N", "on the top plate, in the fixed frame",
     [](R r) -> Cell { return r.measurement.transverse_force[1]; }, true},
    {"bending_moment_x_Nmm", "about the point where the top plate's face meets its axis",
     [](R r) -> Cell { return r.measurement.bending_moment[0]; }, true},
    {"bending_moment_y_Nmm", "about the same point",
     [](R r) -> Cell { return r.measurement.bending_moment[1]; }, true}};

constexpr Column<ProfileLine> of_a_node[] = {
    {"time_s", "the phase's end", [](L l) -> Cell { return l.end.time; }},
    {"phase", "counted from 1", [](L l) -> Cell { return static_cast<long>(l.end.phase); }},
    {"surface", "top or bottom: whose node it is", [](L l) -> Cell { return l.row.surface; }},
    {"reference_r_mm", "undeformed radius about the axis of its own plate",
     [](L l) -> Cell { return l.row.reference_r; }},
    {"reference_theta_rad", "undeformed angle", [](L l) -> Cell { return l.row.reference_theta; }},
    {"reference_z_mm", "undeformed height; 0 is the bottom gel's face",
     [](L l) -> Cell { return l.row.reference_z; }},
    {"r_mm", "radius now", [](L l) -> Cell { return l.row.r; }},
    {"theta_rad", "angle now, in space", [](L l) -> Cell { return l.row.theta; }},
    {"z_mm", "height now", [](L l) -> Cell { return l.row.z; }},
    {"pressure_MPa", "per current area; nan at the bottom gel's nodes, as all that follows",
     [](L l) -> Cell { return l.row.pressure; }},
    {"traction_radial_MPa", "on the top gel", [](L l) -> Cell { return l.row.traction_radial; }},
    {"traction_circumferential_MPa", "on the top gel",
     [](L l) -> Cell { return l.row.traction_circumferential; }},
    {"sliding_velocity_mm_per_s", "of the top gel's face over the bottom gel's",
     [](L l) -> Cell { return l.row.sliding_velocity; }},
    {"mu", "|traction| / pressure", [](L l) -> Cell { return l.row.mu; }},
    {"status", "open, stick or slip", [](L l) -> Cell { return l.row.status; }},
    {"part", "face, or wall: the side wall beside it that may roll onto the other gel",
     [](L l) -> Cell { return l.row.part; }}};

} // namespace

std::span<const Column<HistoryRow>> history_columns()
{
  return of_a_step;
}

std::span<const Column<ProfileLine>> profile_columns()
{
  return of_a_node;
}

std::string text_of(const Cell &cell)
{
  if (const auto *word = std::get_if<const char *>(&cell)) return *word;
  if (const auto *count = std::get_if<long>(&cell)) return std::to_string(*count);
  const double x = std::get<double>(cell);
  if (std::isnan(x)) return "nan";
  std::array<char, 40> buffer;
  std::snprintf(buffer.data(), buffer.size(), "%.17g", x);
  return buffer.data();
}

namespace
{

template <class Row> std::string as_text(const char *file, std::span<const Column<Row>> columns)
{
  std::string text = std::string(file) + "\n";
  for (const auto &column : columns) {
    std::array<char, 40> name;
    std::snprintf(name.data(), name.size(), "  %-30s", column.name);
    text += std::string(name.data()) + column.meaning + "\n";
  }
  return text;
}

template <class Row> std::string as_markdown(const char *title, std::span<const Column<Row>> columns)
{
  std::string text = "\n## " + std::string(title) + "\n\n| column | meaning |\n|---|---|\n";
  for (const auto &column : columns) {
    text += "| `" + std::string(column.name) + "` | ";
    for (const char *c = column.meaning; *c; ++c) text += *c == '|' ? std::string("\\|") : std::string(1, *c);
    text += " |\n";
  }
  return text;
}

constexpr const char *of_history = "history.csv: a row for each accepted step";
constexpr const char *of_profile = "profile.csv: the contact surfaces' nodes at each phase's end";

} // namespace

std::string columns_text()
{
  return as_text(of_history, history_columns()) + "\n" + as_text(of_profile, profile_columns());
}

std::string columns_markdown()
{
  return as_markdown(of_history, history_columns()) + as_markdown(of_profile, profile_columns());
}

} // namespace tribogel
