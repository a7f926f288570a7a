/// Limits, orders and errors of sequences that are known exactly, and of such that cannot be trusted.
#include "tribogel/math/extrapolation.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <utility>

namespace tribogel
{
namespace
{

std::vector<Level> power(const std::vector<double> &elements, double limit, double slope, double order)
{
  std::vector<Level> levels;
  for (const double n : elements) levels.push_back({1 / n, limit + slope * std::pow(n, -order)});
  return levels;
}

void expect_found(const std::vector<double> &elements, double limit, double slope, double order)
{
  const std::vector<Level> levels = power(elements, limit, slope, order);
  const Extrapolation found = extrapolate(levels);
  EXPECT_EQ(found.verdict, Convergence::confirmed);
  EXPECT_NEAR(found.order, order, 1e-7);
  EXPECT_NEAR(found.limit, limit, 1e-9 * std::abs(limit));
  EXPECT_NEAR(found.error, 1.25 * std::abs(levels.back().value - limit), 1e-8 * std::abs(limit));
}

TEST(Extrapolation, FindsLimitAndOrderOfExactSequences)
{
  expect_found({8, 16, 32}, 3.7, 2.1, 1);
  expect_found({8, 16, 32}, 3.7, 2.1, 2);
  expect_found({8, 12, 16}, 290.3, -75, 1.37);
  expect_found({5, 11, 13}, -0.42, 0.9, 0.61);
  expect_found({8, 12, 16, 24}, 290.3, 75, 1.37);
  expect_found({8, 12, 16, 24}, -11.3, 4.3, 2);
}

TEST(Extrapolation, TakesLevelsInAnyOrderAndAnyUnitOfSize)
{
  std::vector<Level> levels = power({8, 12, 16}, 290.3, -75, 1.37);
  const Extrapolation found = extrapolate(levels);
  for (Level &level : levels) level.size *= 48;
  std::swap(levels[0], levels[2]);
  EXPECT_NEAR(extrapolate(levels).error, found.error, 1e-9 * found.error);
}

TEST(Extrapolation, WidensTheErrorByNoise)
{
  for (const double noise : {0.004, -0.004}) {
    std::vector<Level> levels = power({8, 12, 16, 24, 32}, 7.3, 5.1, 1.6);
    for (std::size_t k = 0; k < levels.size(); ++k) levels[k].value += k % 2 ? -noise : noise;
    const Extrapolation noisy = extrapolate(levels);
    const double finest = levels.back().value;
    EXPECT_EQ(noisy.verdict, Convergence::confirmed);
    EXPECT_GT(noisy.error, 1.25 * std::abs(finest - noisy.limit) + 0.5 * std::abs(noise));
    EXPECT_LT(std::abs(finest - 7.3), noisy.error);
  }
}

Extrapolation halved(std::initializer_list<double> values, double scale = 0)
{
  std::vector<Level> levels;
  double size = 1;
  for (const double value : values) {
    levels.push_back({size, value});
    size /= 2;
  }
  return extrapolate(levels, scale);
}

TEST(Extrapolation, DoesNotTrustThreeLevelsOutOfOrder)
{
  const Extrapolation back = halved({5.0, 5.4, 5.3}), slow = halved({5.0, 5.1, 5.2}),
                      away = halved({5.0, 5.1, 5.3});
  EXPECT_EQ(back.verdict, Convergence::oscillates);
  EXPECT_NEAR(back.error, 1.2, 1e-12);
  EXPECT_EQ(slow.verdict, Convergence::slow);
  EXPECT_GT(slow.error, 0.6 * (1 - 1e-12));
  EXPECT_EQ(away.verdict, Convergence::slow);
  EXPECT_GT(away.error, 0.9 * (1 - 1e-12));
}

TEST(Extrapolation, TakesScatterOfManyLevelsForAnError)
{
  const Extrapolation found = halved({5.0, 5.4, 5.3, 5.35, 5.32});
  EXPECT_GT(found.error, 0.02);
  EXPECT_LT(found.error, 0.3);
}

/// Of exact sequences of an order too good, the error that is left is overestimated, never under.
TEST(Extrapolation, ReplacesAnOrderTooGoodByTwo)
{
  const Extrapolation three = halved({5.0, 5.32, 5.33}); // ratio 32: order 5
  EXPECT_EQ(three.verdict, Convergence::fast);
  EXPECT_NEAR(three.order, 5, 1e-7);
  EXPECT_NEAR(three.error, 3 * 0.33, 1e-9);
  const std::vector<Level> levels = power({3, 5, 7, 13, 17}, -11.3, 4.3, 2.9);
  const Extrapolation five = extrapolate(levels);
  EXPECT_EQ(five.verdict, Convergence::fast);
  EXPECT_NEAR(five.order, 2.9, 1e-6);
  EXPECT_GT(five.error, 1.25 * std::abs(levels.back().value + 11.3));
}

TEST(Extrapolation, KnowsCoincidingAndMissingLevels)
{
  EXPECT_EQ(halved({5.0}).verdict, Convergence::unknown);
  EXPECT_TRUE(std::isnan(halved({5.0}).error));
  EXPECT_TRUE(std::isnan(halved({}).error));
  EXPECT_NEAR(halved({5.0, 5.2}).error, 0.6, 1e-12);
  EXPECT_EQ(halved({5.0, 5.2}).verdict, Convergence::few_levels);
  EXPECT_EQ(halved({5.0, 5.0, 5.0}).verdict, Convergence::settled);
  EXPECT_EQ(halved({5.0, 5.0, 5.0}).error, 0);
  EXPECT_EQ(halved({5.0, 5.0 + 2e-10, 5.0 + 1e-10}).verdict, Convergence::settled);
  EXPECT_EQ(halved({1e-12, -2e-12, 3e-12}, 11).verdict, Convergence::settled);
  const Extrapolation twice = halved({5.0, 5.3, 5.3}); // the last two alike: no order
  EXPECT_TRUE(std::isfinite(twice.error));
  EXPECT_GE(twice.error, 0);
}

TEST(Extrapolation, OfAKnownOrderNeedsTwoLevels)
{
  const double order = 0.5;
  const Level coarse{4, 7 + 0.3 * 2}, fine{1, 7 + 0.3};
  for (const auto &[judged, other] : {std::pair{fine, coarse}, std::pair{coarse, fine}}) {
    const Extrapolation found = extrapolate_with(order, judged, other);
    EXPECT_NEAR(found.limit, 7, 1e-14);
    EXPECT_NEAR(found.error, 3 * (judged.value - 7), 1e-14);
  }
  EXPECT_EQ(extrapolate_with(order, fine, {4, fine.value}).verdict, Convergence::settled);
}

std::vector<std::string> split(const std::string &text, char at)
{
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);) {
    const std::size_t first = part.find_first_not_of(' '), last = part.find_last_not_of(' ');
    parts.push_back(first == std::string::npos ? "" : part.substr(first, last - first + 1));
  }
  return parts;
}

void expect_same(double found, const std::string &text, double tolerance)
{
  const double expected = std::stod(text);
  if (std::isnan(expected))
    EXPECT_TRUE(std::isnan(found)) << found;
  else
    EXPECT_NEAR(found, expected, tolerance);
}

/// The table that the tools are held to as well.
TEST(Extrapolation, IsThatOfTheTools)
{
  std::ifstream file(TRIBOGEL_EXTRAPOLATION_CASES);
  int cases = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    SCOPED_TRACE(line);
    const std::vector<std::string> cells = split(line, '|');
    ASSERT_EQ(cells.size(), 7);
    const std::vector<std::string> sizes = split(cells[0], ','), values = split(cells[1], ',');
    ASSERT_EQ(sizes.size(), values.size());
    std::vector<Level> levels;
    for (std::size_t k = 0; k < sizes.size(); ++k)
      levels.push_back({std::stod(sizes[k]), std::stod(values[k])});
    const Extrapolation found = extrapolate(levels, std::stod(cells[2]));
    EXPECT_EQ(convergence_names[static_cast<int>(found.verdict)], cells[3]);
    expect_same(found.limit, cells[4], 1e-6);
    expect_same(found.error, cells[5], 1e-6 * (1 + found.error));
    expect_same(found.order, cells[6], 1e-6);
    ++cases;
  }
  EXPECT_EQ(cases, 16);
}

/// The paper scene, order 2, 6 to 24 elements (steady N, limit 290.4435): meshes of whole numbers of edges
/// scatter.
TEST(Extrapolation, CoversTheLimitOfTheRheometer)
{
  const std::vector<Level> levels{
      {4, 290.90838}, {8.0 / 3, 290.75905}, {2, 290.53840}, {4.0 / 3, 290.47397}, {1, 290.42075}};
  const Extrapolation found = extrapolate(levels);
  EXPECT_GT(found.error, std::abs(290.42075 - 290.4435));
  EXPECT_LT(found.error, 1);
}

} // namespace
} // namespace tribogel
