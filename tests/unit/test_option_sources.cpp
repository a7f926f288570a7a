// Where options come from: words, files and the environment, what is taken, what is refused and what counts.
// No PETSc.
#include "options/option_order.hpp"
#include "options/petsc_limits.hpp"
#include "support/command_line.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

using namespace tribogel;

namespace
{

/// The text of the refusal; empty if there was none.
template <class F> std::string refusal(F &&work)
{
  try {
    work();
  } catch (const UserError &error) {
    return error.text;
  }
  return {};
}

bool contains(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}

struct TemporaryFile {
  std::string path;
  TemporaryFile(const std::string &name, const std::string &content)
      : path((std::filesystem::temp_directory_path() / (std::to_string(getpid()) + name)).string())
  {
    std::ofstream(path, std::ios::binary) << content;
  }
  ~TemporaryFile() { std::filesystem::remove(path); }
};

/// What comes of these words on the command line, files read.
std::vector<GivenOption> options_of(std::vector<std::string> words, const std::string &environment = "",
                                    const std::vector<std::string> &unasked_files = {})
{
  words.insert(words.begin(), "tribogel");
  return all_options(read_command_line(words), environment, unasked_files);
}

void check_options_file(const std::string &path)
{
  options_of({"-options_file", path});
}

/// "-a=1 -b " for a readable comparison.
std::string listed(const std::vector<GivenOption> &options)
{
  std::string text;
  for (const GivenOption &option : options) text += option.name + "=" + option.value + " ";
  return text;
}

std::string in_file(const std::string &content)
{
  const TemporaryFile file("in_file.opts", content);
  return listed(options_of({"-options_file", file.path}));
}

std::string refusal_of_file(const std::string &content)
{
  const TemporaryFile file("refused.opts", content);
  return refusal([&] { check_options_file(file.path); });
}

} // namespace

TEST(CommandLine, tells_names_from_negative_values)
{
  for (const char *word : {"-a", "--long", "-info", "-top_radius", "-e4", "-nanny"})
    EXPECT_TRUE(is_option_name(word)) << word;
  for (const char *word : {"a", "-", "--", "-3", "-.5", "-3e4", "-1,2", "-inf", "-nan", "", "8e-4"})
    EXPECT_FALSE(is_option_name(word)) << word;
}

TEST(CommandLine, keeps_names_and_values_apart_and_in_their_order)
{
  const CommandLine line = read_command_line({"tribogel", "-options_file", "a.opts", "-initial_gap", "-.5",
                                              "-overwrite", "-Top_Radius", "3", "-options_file", "b.opts"});
  EXPECT_EQ(listed(line.options),
            "-options_file=a.opts -initial_gap=-.5 -overwrite= -Top_Radius=3 -options_file=b.opts ");
  EXPECT_EQ(line.help, HelpRequest::none);
}

TEST(CommandLine, follows_prefixes)
{
  EXPECT_EQ(
      listed(options_of({"-prefix_push", "top_", "-radius", "3", "-prefix_pop", "-bottom_radius", "5"})),
      "-top_radius=3 -bottom_radius=5 ");
  const TemporaryFile file("prefix.opts",
                           "-radius 3\n-prefix_push max\n-well_viscosities 1,2\n-prefix_pop\n");
  EXPECT_EQ(listed(options_of({"-prefix_push", "top_", "-options_file", file.path, "-PREFIX_POP", "-a"})),
            "-top_radius=3 -top_maxwell_viscosities=1,2 -a= ");
  EXPECT_TRUE(contains(refusal([] { options_of({"-prefix_pop"}); }), "after a -prefix_push"));
  EXPECT_TRUE(contains(refusal([] { options_of({"-prefix_push"}); }), "-prefix_push: value missing"));
  EXPECT_TRUE(contains(refusal_of_file("-prefix_push top_\n-radius 3\n"), "do not balance"));
}

TEST(CommandLine, refuses_stray_words)
{
  const auto stray = [](std::vector<std::string> words) {
    words.insert(words.begin(), "tribogel");
    return refusal([&] { read_command_line(words); });
  };
  EXPECT_TRUE(contains(stray({"scene.opts"}), "scene.opts"));
  EXPECT_TRUE(contains(stray({"-friction_coefficients", "0", "8e-4"}), "8e-4"));
  EXPECT_TRUE(contains(stray({"-friction_coefficients", "0", "8e-4"}), "-friction_coefficients = 0"));
  EXPECT_TRUE(contains(refusal([] { options_of({"-options_file"}); }), "-options_file: value missing"));
  EXPECT_EQ(stray({"-overwrite", "-top_radius", "9"}), "");
}

TEST(CommandLine, takes_out_help_and_version)
{
  EXPECT_EQ(read_command_line({"tribogel", "-help"}).help, HelpRequest::table);
  EXPECT_EQ(read_command_line({"tribogel", "-top_radius", "3", "-h"}).help, HelpRequest::table);
  EXPECT_EQ(read_command_line({"tribogel", "-help", "petsc"}).help, HelpRequest::petsc);
  EXPECT_EQ(read_command_line({"tribogel", "-help", "markdown"}).help, HelpRequest::markdown);
  EXPECT_EQ(read_command_line({"tribogel", "-help", "columns"}).help, HelpRequest::columns);
  const CommandLine line = read_command_line({"tribogel", "-version", "-overwrite"});
  EXPECT_EQ(line.help, HelpRequest::version);
  EXPECT_EQ(listed(line.options), "-overwrite= ");
  EXPECT_TRUE(contains(refusal([] {
                         read_command_line({"tribogel", "-help", "me"});
                       }),
                       "petsc, columns or markdown"));
}

TEST(CommandLine, judges_PETSC_OPTIONS)
{
  EXPECT_EQ(listed(options_of({}, " -a 1  -b\n-c\t-2.5 ")), "-a=1 -b= -c=-2.5 ");
  EXPECT_TRUE(contains(refusal([] { options_of({}, "-a 1 2"); }), "2: stray"));
  EXPECT_TRUE(contains(refusal([] { options_of({}, "word"); }), "PETSC_OPTIONS"));
  EXPECT_TRUE(contains(refusal([] { options_of({}, "-help"); }), "command line only"));
}

TEST(OptionsFile, takes_comments_bare_names_and_values)
{
  const TemporaryFile file("good.opts", "# head\n\n  -overwrite\n-top_radius 9 # mm\n\t-initial_gap\t-.5\n");
  EXPECT_EQ(refusal([&] { check_options_file(file.path); }), "");
}

TEST(OptionsFile, refuses_with_file_line_and_option)
{
  const TemporaryFile blanks("blanks.opts", "# head\n-friction_coefficients 0 8e-4\n");
  const std::string text = refusal([&] { check_options_file(blanks.path); });
  EXPECT_TRUE(contains(text, blanks.path + " line 2")) << text;
  EXPECT_TRUE(contains(text, "-friction_coefficients = 0")) << text;
  EXPECT_TRUE(contains(text, "8e-4: stray")) << text;
  const TemporaryFile bare("bare.opts", "top_radius 9\n");
  EXPECT_TRUE(contains(refusal([&] { check_options_file(bare.path); }), "top_radius"));
  for (const char control : {'\0', '\x1b', '\x7f'}) {
    const TemporaryFile damaged("damaged.opts",
                                std::string("-top_height 4\n-top_radius 9") + control + "5\n");
    EXPECT_TRUE(contains(refusal([&] { check_options_file(damaged.path); }), damaged.path + ": line 2"));
  }
  const TemporaryFile empty_name("name.opts", "-options_file\n");
  EXPECT_TRUE(contains(refusal([&] { check_options_file(empty_name.path); }), "value missing"));
}

TEST(OptionsFile, refuses_missing_files_directories_and_circles)
{
  EXPECT_TRUE(contains(refusal([] { check_options_file("no/such.opts"); }), "-options_file = no/such.opts"));
  EXPECT_TRUE(contains(refusal([] { check_options_file("/"); }), "directory"));
  TemporaryFile circle("circle.opts", "");
  std::ofstream(circle.path) << "-options_file " << circle.path << "\n";
  EXPECT_TRUE(contains(refusal([&] { check_options_file(circle.path); }), "circle"));
}

TEST(OptionsFile, ends_lines_as_any_system_does)
{
  const std::string expected = "-top_radius=8 -top_height=3 ";
  for (const std::string end : {"\n", "\r\n", "\r", "\n\r"}) // the last: a line between that is empty
    for (const std::string mark : {"", "\xEF\xBB\xBF"}) {
      EXPECT_EQ(in_file(mark + "# mine" + end + "-top_radius 8 # mm" + end + "-top_height 3"), expected);
      EXPECT_EQ(in_file(mark + "-top_radius 8" + end + end + "-top_height\t3" + end), expected);
    }
  EXPECT_TRUE(contains(refusal_of_file("# a\r# b\r\n\r\n-top_radius 8 9\r"), " line 4 "));
}

/// What another program may take for the end of a line, in a comment too: the rest would be read or not.
TEST(OptionsFile, refuses_line_ends_that_are_not_everybodys)
{
  const std::vector<std::pair<std::string, std::string>> ends{
      {"\v", "a vertical tab (U+000B)"},
      {"\f", "a form feed (U+000C)"},
      {"\xC2\x85", "a next-line character (U+0085)"},
      {"\xE2\x80\xA8", "a line separator (U+2028)"},
      {"\xE2\x80\xA9", "a paragraph separator (U+2029)"}};
  for (const auto &[end, words] : ends)
    for (const std::string before : {"# mine", "-top_height 3"}) {
      const std::string text = refusal_of_file("\n" + before + end + "-top_radius 8\n");
      EXPECT_TRUE(contains(text, ": line 2 holds " + words)) << text;
    }
}

TEST(OptionsFile, refuses_other_encodings_by_their_names)
{
  const std::string text = "-top_radius 8\n";
  std::string little, big;
  for (char c : text) {
    little += {c, '\0'};
    big += {'\0', c};
  }
  for (const std::string &content : {"\xFF\xFE" + little, "\xFE\xFF" + big})
    EXPECT_TRUE(
        contains(refusal_of_file(content), "is UTF-16; allowed: a text file of options, saved as UTF-8"));
  for (const std::string &content : {little, big})
    EXPECT_TRUE(contains(refusal_of_file(content), "line 1 is no text, it holds a byte 0"));
  EXPECT_EQ(in_file("# Gr\xF6\xDF"
                    "e\n" +
                    text),
            "-top_radius=8 "); // Latin-1 in a remark does no harm
  EXPECT_TRUE(contains(refusal_of_file("-output_directory Gr\xF6\xDF\n"), "a byte 0xF6, which is no UTF-8"));
}

TEST(OptionsFile, refuses_characters_that_are_not_what_they_look_like)
{
  const std::string blank = "\xC2\xA0"; // no-break
  const std::string after_name = refusal_of_file("\n-top_radius" + blank + "8\n");
  EXPECT_TRUE(after_name.starts_with("-top_radius<U+00A0>8: ")) << after_name;
  EXPECT_TRUE(contains(after_name, "no-break space (U+00A0)") && contains(after_name, " line 2"))
      << after_name;
  const std::string after_value = refusal_of_file("\n-top_radius 8" + blank + "\n");
  EXPECT_TRUE(after_value.starts_with("-top_radius = 8<U+00A0>: ")) << after_value;
  EXPECT_TRUE(contains(after_value, "no-break space (U+00A0)") && contains(after_value, " line 2"))
      << after_value;
  EXPECT_TRUE(contains(refusal_of_file("\xE2\x80\x93top_radius 8\n"), "begins with an en dash (U+2013)"));
  EXPECT_TRUE(contains(refusal_of_file("-top_radius=8\n"), "allowed: -top_radius 8, with a blank"));
  EXPECT_TRUE(
      contains(refusal_of_file("-top_radius 8\n\xEF\xBB\xBF-top_height 3\n"), "byte-order mark (U+FEFF)"));
  EXPECT_EQ(in_file("-output_directory Gr\xC3\xB6\xC3\x9F"
                    "e\n"),
            "-output_directory=Gr\xC3\xB6\xC3\x9F"
            "e ");
}

TEST(OptionsFile, takes_quoted_words)
{
  EXPECT_EQ(in_file("-output_directory \"my run\"\n-top_radius \"8\"\n"),
            "-output_directory=my run -top_radius=8 ");
  EXPECT_TRUE(contains(refusal_of_file("-output_directory \"my run\n"), "quotation mark"));
  EXPECT_TRUE(contains(refusal_of_file("-plate_contact \"\"\n"), "-plate_contact: value missing"));
}

TEST(OptionsFile, is_read_where_it_is_named)
{
  const TemporaryFile inner("inner.opts", "-b 2\n"),
      outer("outer.opts", "-a 1\n-Options_File " + inner.path + "\n-c 3\n");
  const TemporaryFile unasked("unasked.opts", "-z 9\n");
  const auto options = options_of({"-x", "-options_file", outer.path, "-y"}, "-w 0", {unasked.path});
  EXPECT_EQ(listed(options), "-z=9 -w=0 -x= -a=1 -b=2 -c=3 -y= ");
  EXPECT_EQ(options[0].place(), "in options file " + unasked.path + " line 1");
  EXPECT_EQ(options[1].place(), "in PETSC_OPTIONS");
  EXPECT_EQ(options[2].place(), "on the command line");
  EXPECT_EQ(options[5].place(), "in options file " + outer.path + " line 3");
  EXPECT_TRUE(options[0].unasked && options[1].unasked && !options[2].unasked && !options[4].unasked);
  EXPECT_TRUE(contains(refusal([] {
                         options_of({"-options_file", "a.yaml"});
                       }),
                       "-options_file = a.yaml: YAML"));
  EXPECT_TRUE(contains(refusal([] { options_of({"-options_string_yaml", "a: 1"}); }), "YAML"));
}

TEST(OptionOrder, of_two_ways_to_say_one_thing_the_later_counts)
{
  const auto left = [](const std::vector<std::string> &words, const std::string &environment = "") {
    std::vector<GivenOption> options = options_of(words, environment);
    const std::vector<std::string> notes = keep_later(options);
    EXPECT_LE(notes.size(), 1u);
    return listed(options) + (notes.empty() ? "" : "| " + notes[0]);
  };
  const TemporaryFile rates("rates.opts", "-schedule_rates 0,1\n");
  const std::string file = left({"-options_file", rates.path, "-schedule_twists", "0,2", "-overwrite"});
  EXPECT_TRUE(file.starts_with("-schedule_twists=0,2 -overwrite= | -schedule_rates = 0,1 (in options file "))
      << file;
  EXPECT_TRUE(contains(file, " line 1) gives way to -schedule_twists = 0,2 (on the command line)")) << file;
  const std::string turned = left({"-schedule_twists", "0,2", "-options_file", rates.path});
  EXPECT_TRUE(
      turned.starts_with("-schedule_rates=0,1 | -schedule_twists = 0,2 (on the command line) gives way"))
      << turned;
  EXPECT_TRUE(left({"-schedule_rates", "0"}, "-SCHEDULE_TWISTS 1")
                  .starts_with("-schedule_rates=0 | -SCHEDULE_TWISTS"));
  EXPECT_TRUE(left({"-schedule_rates", "1", "-schedule_twists", "2", "-schedule_rates", "3"})
                  .starts_with("-schedule_rates=1 -schedule_rates=3 | -schedule_twists = 2"));
  EXPECT_TRUE(
      left({"-ts_atol", "1e-3", "-time_tolerance", "1"}).starts_with("-time_tolerance=1 | -ts_atol = 1e-3"));
  EXPECT_EQ(left({"-schedule_rates", "1", "-schedule_rates", "3"}), "-schedule_rates=1 -schedule_rates=3 ");
}

TEST(OptionOrder, tells_what_is_given_twice_in_one_place_and_what_comes_unasked)
{
  const auto notes = [](const std::vector<std::string> &words, const std::string &environment = "") {
    std::string text;
    for (const std::string &note : notes_on_sources(options_of(words, environment))) text += note + "\n";
    return text;
  };
  EXPECT_EQ(notes({"-top_radius", "8", "-Top_Radius", "9"}),
            "-top_radius = 8 (on the command line) gives way to -Top_Radius = 9 (on the command line), which "
            "comes later\n");
  EXPECT_EQ(notes({"-top_radius", "8", "-top_radius", "8"}), "");
  const TemporaryFile file("radius.opts", "-top_radius 8\n");
  EXPECT_EQ(notes({"-options_file", file.path, "-top_radius", "9"}), ""); // that is what files are for
  EXPECT_EQ(notes({}, "-top_radius 8 -ksp_type gmres"),
            "-top_radius = 8 (in PETSC_OPTIONS) counts: it is read without being named\n");
  EXPECT_EQ(notes({"-top_radius", "9"}, "-top_radius 8"), "");
}

TEST(PetscLimits, refuse_by_name_what_would_break_a_promise)
{
  const auto text = [](const std::string &name, const std::string &value) {
    return refusal([&] { check_petsc_option(name, value); });
  };
  EXPECT_EQ(text("-ts_max_time", "5"),
            "-ts_max_time = 5: the schedule ends the run; allowed: nothing; use -schedule_end_times");
  EXPECT_TRUE(contains(text("-ts_adapt_type", "glee"), "-ts_adapt_type = glee: "))
      << text("-ts_adapt_type", "glee");
  EXPECT_TRUE(contains(text("-ts_adapt_type", "glee"), "allowed: basic or dsp or none"));
  EXPECT_TRUE(contains(text("-ts_exact_final_time", "stepover"), "allowed: matchstep"));
  EXPECT_TRUE(contains(text("-snes_convergence_test", "skip"), "-snes_rtol"));
  EXPECT_TRUE(contains(text("-SNES_TYPE", "ksponly"), "newtonls or newtontr"));
  EXPECT_TRUE(contains(text("-snes_error_if_not_converged", ""), "shorter one")); // bare: true
  for (const char *value : {"nan", "inf", "1", "-1e-3", "x"})
    EXPECT_NE(text("-snes_rtol", value), "") << value;
  for (const char *value : {"nan", "inf", "0", "2", "1e999"}) EXPECT_NE(text("-ts_atol", value), "") << value;
  for (const auto &[name, value] :
       std::vector<std::pair<std::string, std::string>>{{"-ts_exact_final_time", "matchstep"},
                                                        {"-ts_adapt_type", "none"},
                                                        {"-ts_adapt_type", "dsp"},
                                                        {"-snes_rtol", "1e-9"},
                                                        {"-snes_rtol", "0"},
                                                        {"-ts_atol", "1e-4"},
                                                        {"-snes_type", "newtontr"},
                                                        {"-snes_fd", "false"},
                                                        {"-ts_dt", "nan"},
                                                        {"-snes_max_it", "3"}})
    EXPECT_EQ(text(name, value), "") << name;
}
