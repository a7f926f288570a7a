// Reading option texts: what is taken, what is refused and in which words. No PETSc.
#include "options/help.hpp"
#include "options/nearest_name.hpp"
#include "options/option_table.hpp"
#include "support/command_line.hpp"
#include "support/parse.hpp"

#include <gtest/gtest.h>

#include <set>

using namespace tribogel;

namespace
{

bool contains(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}

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
  for (const char *text : {"",    " ",    "3 ",  " 3",   "0 8e-4",   "3x",    "x3",    "3,4",    "nan",
                           "NaN", "-nan", "inf", "-inf", "infinity", "0x10",  "1e400", "-1e400", "1e-400",
                           "1e",  "--3",  "+-3", "++3",  ".",        "1.2.3", "3\n",   "1d3"}) {
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
  for (const char *text :
       {"", ",", "0,,1", "0,1,", ",0,1", "0, 1", "0 8e-4", "0;1", "0,nan", "0,1e999", "1,2x"}) {
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
      EXPECT_TRUE(option.source == "paper" || option.source == "assumed" || option.source == "own")
          << option.name;
      EXPECT_EQ(option.kind == OptionKind::choice, !option.choices.empty()) << option.name;
      const bool is_number = option.kind == OptionKind::real || option.kind == OptionKind::reals ||
                             option.kind == OptionKind::integer;
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
  EXPECT_EQ(find_option("-top_maxwell_viscosities")->allowed(),
            "2 real numbers > 0 separated by commas [MPa s]");
  EXPECT_FALSE(positive.contains(0));
  EXPECT_TRUE(non_negative.contains(0));
  EXPECT_FALSE(non_negative.contains(std::numeric_limits<double>::quiet_NaN()));
}
