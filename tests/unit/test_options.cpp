// Reading option texts: what is taken, what is refused and in which words. No PETSc.
#include "scene/command_line.hpp"
#include "scene/help.hpp"
#include "scene/nearest_name.hpp"
#include "scene/option_table.hpp"
#include "scene/parse.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

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
    std::ofstream(path) << content;
  }
  ~TemporaryFile() { std::filesystem::remove(path); }
};

} // namespace

TEST(Parse, takes_the_ways_people_write_numbers)
{
  EXPECT_EQ(*parse_real("8e-4").value, 8e-4);
  EXPECT_EQ(*parse_real("+2.5").value, 2.5);
  EXPECT_EQ(*parse_real("-.5E+2").value, -50);
  EXPECT_EQ(*parse_real("7.").value, 7);
  EXPECT_EQ(*parse_real("0.79").value, 0.79);
  EXPECT_EQ(*parse_integer("-12").value, -12);
  EXPECT_EQ(*parse_reals("0,8e-4,-3").value, (std::vector<double>{0, 8e-4, -3}));
  EXPECT_EQ(*parse_reals("27").value, std::vector<double>{27});
}

TEST(Parse, refuses_what_is_not_one_finite_number)
{
  for (const char *text :
       {"",         " ",    "3 ",    " 3",     "0 8e-4", "3x", "x3",  "3,4", "nan", "NaN", "-nan",  "inf", "-inf",
        "infinity", "0x10", "1e400", "-1e400", "1e-400", "1e", "--3", "+-3", "++3", ".",   "1.2.3", "3\n", "1d3"}) {
    const Parsed<double> parsed = parse_real(text);
    EXPECT_FALSE(parsed.value) << "'" << text << "'";
    EXPECT_FALSE(parsed.error.empty()) << "'" << text << "'";
  }
}

TEST(Parse, refuses_integers_that_are_not_whole_or_overflow)
{
  for (const char *text : {"", "1.0", "1e3", "99999999999999999999", "0x10", "7 8", "seven"})
    EXPECT_FALSE(parse_integer(text).value) << text;
}

TEST(Parse, refuses_malformed_lists)
{
  for (const char *text : {"", ",", "0,,1", "0,1,", ",0,1", "0, 1", "0 8e-4", "0;1", "0,nan", "0,1e999", "1,2x"}) {
    const auto parsed = parse_reals(text);
    EXPECT_FALSE(parsed.value) << "'" << text << "'";
    EXPECT_FALSE(parsed.error.empty()) << "'" << text << "'";
  }
  EXPECT_TRUE(contains(parse_reals("5,,7").error, "number 2"));
  EXPECT_TRUE(contains(parse_reals("5 7").error, "comma"));
}

TEST(Parse, flags_are_bare_true_or_false)
{
  EXPECT_TRUE(*parse_flag("").value);
  EXPECT_TRUE(*parse_flag("true").value);
  EXPECT_FALSE(*parse_flag("false").value);
  for (const char *text : {"yes", "1", "True ", "out"}) EXPECT_FALSE(parse_flag(text).value) << text;
}

TEST(Parse, text_of_a_number_reads_back)
{
  for (double x : {8e-4, 2000000., -12.5, 1. / 3, 1e300, 4.4}) EXPECT_EQ(*parse_real(to_text(x)).value, x);
  EXPECT_EQ(to_text(2e6), "2000000");
  EXPECT_EQ(to_text(0.79), "0.79");
}

TEST(NearestName, counts_edits_and_swaps)
{
  EXPECT_EQ(edit_distance("friction", "friction"), 0);
  EXPECT_EQ(edit_distance("Friction", "fRiction"), 0);
  EXPECT_EQ(edit_distance("fricton", "friction"), 1);
  EXPECT_EQ(edit_distance("firction", "friction"), 1);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("", "abcd"), 4);
  EXPECT_EQ(edit_distance("abcd", ""), 4);
}

TEST(NearestName, finds_the_misspelt_one_and_nothing_far_away)
{
  const std::vector<std::string> names{"-top_radius", "-top_height", "-bottom_radius"};
  EXPECT_EQ(nearest_name("-top_raduis", names, 2), "-top_radius");
  EXPECT_EQ(nearest_name("-botom_radius", names, 2), "-bottom_radius");
  EXPECT_EQ(nearest_name("-snes_monitor", names, 3), "");
}

TEST(OptionTable, is_complete_and_consistent)
{
  std::set<std::string> names;
  for (const OptionGroup &group : option_table())
    for (const Option &option : group.options) {
      EXPECT_TRUE(is_option_name(option.name)) << option.name;
      EXPECT_TRUE(names.insert(option.name).second) << option.name << " twice";
      EXPECT_FALSE(option.meaning.empty()) << option.name;
      EXPECT_TRUE(option.source == "paper" || option.source == "assumed" || option.source == "own") << option.name;
      EXPECT_EQ(option.kind == OptionKind::choice, !option.choices.empty()) << option.name;
      const bool is_number =
          option.kind == OptionKind::real || option.kind == OptionKind::reals || option.kind == OptionKind::integer;
      EXPECT_EQ(is_number, !option.unit.empty()) << option.name;
      EXPECT_EQ(find_option(option.name), &option);
    }
  EXPECT_GT(names.size(), 35u);
  EXPECT_EQ(find_option("-plate_contac"), nullptr);
}

TEST(OptionTable, help_names_every_option)
{
  const std::string text = help_text(), page = help_markdown();
  for (const OptionGroup &group : option_table())
    for (const Option &option : group.options) {
      EXPECT_TRUE(contains(text, option.name + "  (")) << option.name;
      EXPECT_TRUE(contains(page, "`" + option.name + "`")) << option.name;
    }
}

TEST(OptionTable, says_what_is_allowed)
{
  EXPECT_EQ(find_option("-top_height")->allowed(), "a real number > 0 [mm]");
  EXPECT_EQ(find_option("-element_order")->allowed(), "a whole number 1 to 2");
  EXPECT_EQ(find_option("-specimens")->allowed(), "both or bottom");
  EXPECT_EQ(find_option("-top_maxwell_viscosities")->allowed(), "2 real numbers > 0 separated by commas [MPa s]");
  EXPECT_FALSE(positive.contains(0));
  EXPECT_TRUE(non_negative.contains(0));
  EXPECT_FALSE(non_negative.contains(std::numeric_limits<double>::quiet_NaN()));
}

TEST(CommandLine, tells_names_from_negative_values)
{
  for (const char *word : {"-a", "--long", "-info", "-top_radius", "-e4", "-nanny"})
    EXPECT_TRUE(is_option_name(word)) << word;
  for (const char *word : {"a", "-", "--", "-3", "-.5", "-3e4", "-1,2", "-inf", "-nan", "", "8e-4"})
    EXPECT_FALSE(is_option_name(word)) << word;
}

TEST(CommandLine, keeps_names_values_and_files_apart)
{
  const CommandLine line = read_command_line({"tribogel", "-options_file", "a.opts", "-initial_gap", "-.5",
                                              "-overwrite", "-Top_Radius", "3", "-options_file", "b.opts"});
  EXPECT_EQ(line.options_files, (std::vector<std::string>{"a.opts", "b.opts"}));
  EXPECT_EQ(line.names, (std::set<std::string>{"initial_gap", "overwrite", "top_radius"}));
  EXPECT_EQ(line.words.size(), 10u);
  EXPECT_EQ(line.help, HelpRequest::none);
}

TEST(CommandLine, follows_prefixes)
{
  const CommandLine line =
      read_command_line({"tribogel", "-prefix_push", "top_", "-radius", "3", "-prefix_pop", "-bottom_radius", "5"});
  EXPECT_EQ(line.names, (std::set<std::string>{"top_radius", "bottom_radius"}));
  EXPECT_NE(refusal([] { read_command_line({"tribogel", "-prefix_pop"}); }), "");
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
  EXPECT_TRUE(contains(stray({"-options_file"}), "-options_file"));
  EXPECT_EQ(stray({"-overwrite", "-top_radius", "9"}), "");
}

TEST(CommandLine, takes_out_help_and_version)
{
  EXPECT_EQ(read_command_line({"tribogel", "-help"}).help, HelpRequest::table);
  EXPECT_EQ(read_command_line({"tribogel", "-top_radius", "3", "-h"}).help, HelpRequest::table);
  EXPECT_EQ(read_command_line({"tribogel", "-help", "petsc"}).help, HelpRequest::petsc);
  EXPECT_EQ(read_command_line({"tribogel", "-help", "markdown"}).help, HelpRequest::markdown);
  const CommandLine line = read_command_line({"tribogel", "-version", "-overwrite"});
  EXPECT_EQ(line.help, HelpRequest::version);
  EXPECT_EQ(line.words, (std::vector<std::string>{"tribogel", "-overwrite"}));
  EXPECT_TRUE(contains(refusal([] { read_command_line({"tribogel", "-help", "me"}); }), "petsc or markdown"));
}

TEST(CommandLine, judges_PETSC_OPTIONS)
{
  EXPECT_EQ(refusal([] { check_environment_options(" -a 1  -b -c -2.5 "); }), "");
  EXPECT_TRUE(contains(refusal([] { check_environment_options("-a 1 2"); }), "2: stray"));
  EXPECT_TRUE(contains(refusal([] { check_environment_options("word"); }), "PETSC_OPTIONS"));
  EXPECT_TRUE(contains(refusal([] { check_environment_options("-help"); }), "command line only"));
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
    const TemporaryFile damaged("damaged.opts", std::string("-top_height 4\n-top_radius 9") + control + "5\n");
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
