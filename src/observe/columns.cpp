#include "observe/columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace tribogel
{

namespace
{

/// One step on the way to a number: a member, what a member function returns, or an entry of an array.
template <auto Step, class Object> constexpr decltype(auto) take(Object &object)
{
  if constexpr (std::is_member_function_pointer_v<decltype(Step)>)
    return (object.*Step)();
  else if constexpr (std::is_member_pointer_v<decltype(Step)>)
    return (object.*Step);
  else
    return (object[Step]);
}

template <auto First, auto... Rest, class Object> constexpr decltype(auto) at(Object &object)
{
  if constexpr (sizeof...(Rest) == 0)
    return take<First>(object);
  else
    return at<Rest...>(take<First>(object));
}

/// What a column says of itself.
struct Description {
  const char *name, *meaning;
  bool in_summary = false;
  ConsoleStyle console = {};
};

/// The column of the number at the end of this way through a row.
template <class Row, auto... Way> constexpr Column<Row> column(const Description &of)
{
  using Number = decltype(at<Way...>(std::declval<Row &>()));
  using Whole = std::is_integral<std::remove_cvref_t<Number>>;
  Column<Row> result{of.name, of.meaning, [](const Row &row) -> Cell {
                       if constexpr (Whole::value)
                         return static_cast<long>(at<Way...>(row));
                       else
                         return at<Way...>(row);
                     }};
  if constexpr (std::is_lvalue_reference_v<Number>)
    result.set = [](Row &row, double x) {
      at<Way...>(row) = static_cast<std::remove_reference_t<Number>>(x);
    };
  result.in_summary = of.in_summary;
  result.console = of.console;
  return result;
}

using Step = HistoryRow;

template <auto... Way> constexpr auto of_step = column<Step, Way...>;
template <auto... Way> constexpr auto measured = column<Step, &Step::measurement, Way...>;
template <auto... Way> constexpr auto energy = column<Step, &Step::energy, Way...>;
template <auto... Way> constexpr auto reported = column<Step, &Step::report, Way...>;

using M = Measurement;
using E = EnergyBalance;
using S = StepReport;
constexpr bool in_summary = true;

constexpr Column<HistoryRow> of_a_step[] = {
    of_step<&Step::time>({"time_s", "end of the step, since the start", in_summary, {"time s", 10, 6}}),
    of_step<&Step::phase>(
        {"phase",
         "of the schedule, counted from 1; a row at a phase's end belongs to the phase that ends",
         in_summary,
         {"phase", 5}}),
    of_step<&Step::approach>(
        {"approach_mm", "travel of the top plate since the start, initial gap included", in_summary}),
    of_step<&Step::rotation>({"rotation_rad", "angle by which the top plate has turned", in_summary}),
    of_step<&Step::rate>({"rate_rad_per_s", "at which it turns", in_summary, {"rate rad/s", 12, 6}}),
    measured<&M::normal_force>({"normal_force_N",
                                "N, reaction of the top plate, positive in compression",
                                in_summary,
                                {"N  N", 12, 7}}),
    measured<&M::torque>({"torque_Nmm",
                          "T, of the top plate, positive when it opposes a rotation about +z",
                          in_summary,
                          {"T  N mm", 14, 7}}),
    measured<&M::contact_radius>(
        {"contact_radius_mm", "largest radius at which the gels touch", in_summary, {"radius mm", 12, 6}}),
    measured<&M::mu_apparent>(
        {"mu_apparent",
         "coefficient by eq. (3.13) of the paper, from N, T and the law, as if the pressure were uniform",
         in_summary,
         {"mu apparent", 13, 6}}),
    measured<&M::mu_gong>({"mu_gong", "coefficient by eq. (2.3), 4 T / (3 R N) on a disc", in_summary}),
    measured<&M::mu_mean>(
        {"mu_mean", "mean of |traction| / pressure over the touching points, unweighted: depends on the mesh",
         in_summary}),
    measured<&M::mu_area_weighted>({"mu_area_weighted", "the same, weighted by area", in_summary}),
    measured<&M::mu_pressure_weighted>({"mu_pressure_weighted",
                                        "the same, weighted by pressure: friction force over normal force",
                                        in_summary,
                                        {"mu weighted", 13, 6}}),
    reported<&S::newton_iterations>({"newton_iterations", "of the step that was accepted"}),
    reported<&S::linear_iterations>({"linear_iterations", "of that step"}),
    of_step<&Step::step>({"step_s", "length of the step"}),
    measured<&M::contact_force>({"contact_force_N", "N from the contact's tractions"}),
    measured<&M::contact_torque>({"contact_torque_Nmm", "T from the contact's tractions"}),
    measured<&M::force_mismatch>({"force_mismatch_N", "plate less contact"}),
    measured<&M::torque_mismatch>({"torque_mismatch_Nmm", "plate less contact"}),
    energy<&E::work>({"work_of_plates_Nmm", "done on the gels since the start"}),
    energy<&E::stored>({"stored_energy_Nmm", "in the gels' springs"}),
    energy<&E::viscous>({"viscous_dissipation_Nmm", "heat in the gels since the start"}),
    energy<&E::friction>({"frictional_dissipation_Nmm", "heat between the gels since the start"}),
    measured<&M::transverse_force, 0>(
        {"transverse_force_x_N", "on the top plate, in the fixed frame", in_summary}),
    measured<&M::transverse_force, 1>(
        {"transverse_force_y_N", "on the top plate, in the fixed frame", in_summary}),
    measured<&M::bending_moment, 0>(
        {"bending_moment_x_Nmm", "about the point where the top plate's face meets its axis", in_summary}),
    measured<&M::bending_moment, 1>({"bending_moment_y_Nmm", "about the same point", in_summary})};

constexpr Column<HistoryRow> of_the_record[] = {
    measured<&M::friction_power>({"friction_power_Nmm_per_s", "what the sliding nodes turn into heat"}),
    reported<&S::ends_phase>({"ends_phase", "1: the step is the last of its phase"})};

constexpr Column<PhaseEnd> of_a_phase_end[] = {
    column<PhaseEnd, &PhaseEnd::centre_displacement>(
        {"bottom_surface_centre_displacement_mm", "of the bottom gel's face, down, at the axis"}),
    column<PhaseEnd, &PhaseEnd::rim_displacement>(
        {"bottom_surface_rim_displacement_mm", "the same at the contact radius"})};

using L = const ProfileLine &;

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

std::span<const Column<HistoryRow>> kept_columns()
{
  return of_the_record;
}

std::span<const Column<PhaseEnd>> phase_end_columns()
{
  return of_a_phase_end;
}

std::span<const Column<ProfileLine>> profile_columns()
{
  return of_a_node;
}

const Column<HistoryRow> &history_column(const std::string &name)
{
  const auto found = std::find_if(std::begin(of_a_step), std::end(of_a_step),
                                  [&](const Column<HistoryRow> &column) { return column.name == name; });
  if (found == std::end(of_a_step)) throw std::logic_error("history.csv has no column " + name);
  return *found;
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

double number_of(const Cell &cell)
{
  if (const auto *count = std::get_if<long>(&cell)) return static_cast<double>(*count);
  const auto *real = std::get_if<double>(&cell);
  return real ? *real : undefined;
}

std::string console_heading(const Column<HistoryRow> &column)
{
  std::array<char, 40> text;
  std::snprintf(text.data(), text.size(), "%*s", column.console.width, column.console.heading);
  return text.data();
}

std::string console_text(const Column<HistoryRow> &column, const HistoryRow &row)
{
  const auto &[heading, width, digits] = column.console;
  const Cell cell = column.value(row);
  std::array<char, 40> text;
  if (const auto *count = std::get_if<long>(&cell))
    std::snprintf(text.data(), text.size(), "%*ld", width, *count);
  else
    std::snprintf(text.data(), text.size(), "%*.*g", width, digits, number_of(cell));
  return text.data();
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
