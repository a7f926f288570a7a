/// The top plate's phases.
#include "options/option_groups.hpp"
#include "options/option_reader.hpp"
#include "options/sizes.hpp"
#include "support/parse.hpp"

namespace tribogel
{

namespace
{

std::vector<OptionGroup> declare_schedule()
{
  return {
      {"Schedule (phases of the top plate; the bottom plate is fixed)",
       {{.name = "-schedule_end_times",
         .kind = OptionKind::reals,
         .fallback = "27,3600,4500,5400,6300",
         .unit = "s",
         .meaning = "end of each phase, counted from t = 0",
         .source = "paper",
         .range = positive,
         .rule = "increasing"},
        {.name = "-schedule_approach",
         .kind = OptionKind::reals,
         .fallback = "0.79",
         .unit = "mm",
         .meaning =
             "travel of the top plate since t = 0 at each phase's end, -initial_gap included; linear between",
         .source = "assumed",
         .range = any_real,
         .rule = "one for each phase or one for all, less than the height of what stands between the plates"},
        {.name = "-schedule_rates",
         .kind = OptionKind::reals,
         .fallback = "0,0,0.01,0.1,1",
         .unit = "rad/s",
         .meaning = "rate of the top plate in each phase, about +z",
         .source = "paper",
         .range = any_real,
         .rule = "one for each phase or one for all; of this and -schedule_twists the later counts"},
        {.name = "-schedule_twists",
         .kind = OptionKind::reals,
         .fallback = "",
         .unit = "rad",
         .meaning = "instead of rates: angle of the top plate reached at each phase's end",
         .source = "own",
         .range = any_real,
         .rule = "one for each phase or one for all; of this and -schedule_rates the later counts"},
        {.name = "-schedule_kind",
         .kind = OptionKind::choice,
         .fallback = "transient",
         .meaning = "transient: the whole history; steady: for each phase the relaxed state at its rate and "
                    "approach",
         .source = "paper",
         .choices = {"transient", "steady"}},
        {.name = "-phase_end_tolerance",
         .kind = OptionKind::real,
         .fallback = "0",
         .unit = "%",
         .meaning = "what is left of a phase is one step once N and T, going on as fast as now, would change "
                    "by less than "
                    "this part of their largest values; 0: never",
         .source = "own",
         .range = {0, 100}}}}};
}

/// A list with one number for each phase; a single one holds for all. `text` is the whole list.
std::vector<double> read_per_phase(const OptionReader &reader, const Option &option, std::size_t phases,
                                   std::string &text)
{
  std::vector<double> values = reader.reals(option);
  text = reader.text(option);
  if (values.size() != 1) {
    reader.expect_equal_lengths(option, OptionReader::declared("-schedule_end_times"),
                                ", or one number for all phases");
    return values;
  }
  const std::string one = text;
  for (std::size_t k = 1; k < phases; ++k) text += "," + one;
  return std::vector<double>(phases, values[0]);
}

void read_phases(const OptionReader &reader, SceneInput &input)
{
  const Option &end_times = OptionReader::declared("-schedule_end_times");
  const std::vector<double> ends = reader.reals(end_times);
  for (std::size_t k = 1; k < ends.size(); ++k)
    if (!(ends[k] > ends[k - 1]))
      refuse(end_times.name, reader.text(end_times),
             to_text(ends[k]) + " after " + to_text(ends[k - 1]) + "; allowed: " + end_times.allowed());
  std::string approach_text, turning_text;
  const std::vector<double> approach =
      read_per_phase(reader, OptionReader::declared("-schedule_approach"), ends.size(), approach_text);
  input.options.emplace_back("schedule_approach", approach_text);

  const Option &rates = OptionReader::declared("-schedule_rates"),
               &twists = OptionReader::declared("-schedule_twists");
  const bool by_twists = reader.is_given(twists.name);
  if (by_twists && reader.is_given(rates.name))
    refuse(twists.name, reader.text(twists),
           "allowed: not together with -schedule_rates = " + reader.text(rates));
  const Option &turning = by_twists ? twists : rates;
  const std::vector<double> values = read_per_phase(reader, turning, ends.size(), turning_text);
  input.scene.schedule =
      by_twists ? schedule_from_twists(ends, approach, values) : schedule_from_rates(ends, approach, values);
  input.options.emplace_back(turning.name.substr(1), turning_text);
  if (input.mesh_file.empty()) check_approach(input);
}

/// A steady state forgets how it was reached, except where friction holds gels at rest.
void read_schedule_kind(const OptionReader &reader, SceneInput &input)
{
  Scene &scene = input.scene;
  if (reader.choice("-schedule_kind") == "transient") return;
  if (scene.loads_turn())
    refuse("-schedule_kind", "steady",
           "allowed: transient with -top_offset, -top_tilt or -mesh_file, whose specimens may be other than "
           "round: each "
           "turn loads the gels anew");
  scene.schedule_kind = ScheduleKind::steady;
  if (!scene.has_contact()) return;
  const bool holds = scene.friction.law() && scene.friction.law()->holds_at_rest();
  if (holds && scene.friction.has_memory() && scene.model == Model::solid)
    refuse("-schedule_kind", "steady",
           "in space gels rest at the axis, where steady friction that does not rise with the speed has no "
           "value; allowed: transient, or a law with b < a");
  for (std::size_t k = 0; k < scene.schedule.size(); ++k)
    if (holds && scene.schedule[k].rate == 0)
      refuse("-schedule_kind", "steady",
             "phase " + std::to_string(k + 1) +
                 " is at rest, where static friction depends on the way there; allowed: transient, phases "
                 "that turn, or a law that vanishes at rest");
}

void read_phase_end_tolerance(const OptionReader &reader, Scene &scene)
{
  scene.phase_end_tolerance = reader.real("-phase_end_tolerance");
  if (scene.loads_turn() && scene.phase_end_tolerance > 0)
    refuse("-phase_end_tolerance", to_text(scene.phase_end_tolerance),
           "allowed: 0 with -top_offset, -top_tilt or -mesh_file, where a phase cannot end in one long step");
}

void read_schedule(const OptionReader &reader, SceneInput &input)
{
  read_phases(reader, input);
  read_schedule_kind(reader, input);
  read_phase_end_tolerance(reader, input.scene);
}

} // namespace

OptionSubject schedule_options()
{
  return {declare_schedule, read_schedule};
}

} // namespace tribogel
