/// Where a run writes, how often, and when it stops.
#include "options/option_groups.hpp"
#include "options/option_reader.hpp"

#include <filesystem>

namespace tribogel
{

namespace
{

std::vector<OptionGroup> declare_output()
{
  return {
      {"Output",
       {{.name = "-output_directory",
         .kind = OptionKind::path,
         .fallback = "tribogel-output",
         .meaning = "made if need be, parents included",
         .source = "own",
         .rule = "a directory that holds no run, unless -overwrite",
         .may_change = true},
        {.name = "-overwrite",
         .kind = OptionKind::flag,
         .fallback = "false",
         .meaning = "replace the files of a run that is there; other files stay",
         .source = "own",
         .rule = "not together with -restart",
         .may_change = true},
        {.name = "-checkpoint_every",
         .kind = OptionKind::real,
         .fallback = "600",
         .unit = "s",
         .meaning = "wall time between checkpoints; 0: after each step. There is one at each phase's end in "
                    "any case",
         .source = "own",
         .range = non_negative,
         .may_change = true},
        {.name = "-restart",
         .kind = OptionKind::path,
         .fallback = "",
         .meaning =
             "continue the run in this directory with its options; those of the solver and of the output may"
             " change",
         .source = "own",
         .rule = "the directory of a run that has written a checkpoint",
         .may_change = true},
        {.name = "-error_estimate",
         .kind = OptionKind::flag,
         .fallback = "false",
         .meaning =
             "after the run others of the same scene, on coarser meshes and with shorter steps, and from them"
             " the errors of N and T at each phase's end; they take about twice the run's time",
         .source = "own",
         .may_change = true},
        {.name = "-wall_time",
         .kind = OptionKind::real,
         .fallback = "",
         .unit = "s",
         .meaning = "stop with a checkpoint and status 4 before the program has run for longer than this",
         .source = "own",
         .range = positive,
         .may_change = true}}}};
}

/// A run that goes on does so where it is.
void read_output(const OptionReader &reader, SceneInput &input)
{
  OutputSettings &output = input.output;
  const Option &directory = OptionReader::declared("-output_directory"),
               &restart = OptionReader::declared("-restart");
  output.directory = reader.path(directory);
  output.overwrite = reader.flag("-overwrite");
  output.error_estimate = reader.flag("-error_estimate");
  output.checkpoint_every = reader.real("-checkpoint_every");
  if (reader.is_given("-wall_time")) output.wall_time = reader.real("-wall_time");
  if (!reader.is_given(restart.name)) return;
  const std::string where = reader.path(restart);
  const auto plain = [](const std::string &path) {
    return std::filesystem::path(path + "/").lexically_normal();
  };
  if (output.overwrite) refuse("-overwrite", "true", "allowed: not together with -restart = " + where);
  if (reader.is_given(directory.name) && plain(output.directory) != plain(where))
    refuse(directory.name, output.directory, "allowed: with -restart nothing, or its directory " + where);
  output.directory = where;
  output.restart = true;
  input.options.emplace_back("output_directory", where);
}

} // namespace

OptionSubject output_options()
{
  return {declare_output, read_output};
}

} // namespace tribogel
