// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "protocol/vocabulary/random.hpp"

namespace pitwall::sweep {
namespace {

using Function = std::function<Margins(const Point&)>;

std::vector<Evaluated> found(const SearchPlan& plan, const Function& function) {
  return search(plan, [&](std::span<const Point> points) {
    std::vector<Margins> margins;
    for (const Point& point : points) margins.push_back(function(point));
    return margins;
  });
}

bool is_broken(const std::vector<Evaluated>& points) {
  for (const Evaluated& point : points)
    for (const double margin : point.margins)
      if (margin < 0.0) return true;
  return false;
}

// A ball about a drawn point, of the share `share` of the box in two parameters.
Function ball(const Point& at, double share) {
  const double radius = std::sqrt(share / 3.14159);
  return [at, radius](const Point& point) {
    double squares = 0.0;
    for (std::size_t k = 0; k < at.size(); ++k) squares += std::pow(point[k] - at[k], 2);
    return Margins{std::sqrt(squares) - radius};
  };
}

TEST(Search, FindsWhatChanceAloneWouldMiss) {
  // Chance finds one of a thousand in 200 draws in 18 of 100 tries.
  int finds = 0;
  Random random{5};
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Point at{random.between(0.05, 0.95), random.between(0.05, 0.95)};
    finds += is_broken(found({.parameters = 2, .seed = seed}, ball(at, 0.001)));
  }
  EXPECT_GE(finds, 48);
}

TEST(Search, AMarginOfALargeUnitHidesNoOther) {
  int finds = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Function small = ball({0.8, 0.3}, 0.001);
    finds += is_broken(found({.parameters = 2, .seed = seed}, [&](const Point& point) {
      return Margins{1'000.0 + 500.0 * point[0], small(point)[0]};
    }));
  }
  EXPECT_GE(finds, 18);
}

TEST(Search, EndsWithTheBatchThatFoundItAndElseAfterAllEvaluations) {
  EXPECT_EQ(
      found({.parameters = 2, .evaluations = 73}, [](const Point&) { return Margins{1.0}; }).size(),
      73U);
  EXPECT_EQ(found({.parameters = 2}, [](const Point&) { return Margins{-1.0}; }).size(), kBatch);
}

TEST(Search, TheSameSeedGivesTheSamePointsAllWithinTheBox) {
  const Function function = ball({0.99, 0.01}, 0.0001);
  const auto first = found({.parameters = 2, .seed = 9}, function),
             again = found({.parameters = 2, .seed = 9}, function);
  ASSERT_EQ(first.size(), again.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].at, again[i].at);
    for (const double x : first[i].at) EXPECT_TRUE(x >= 0.0 && x <= 1.0);
  }
}

TEST(Search, APointWithoutMarginsIsPassedOver) {
  const auto points = found({.parameters = 1, .evaluations = 40}, [](const Point& point) {
    return point[0] < 0.5 ? Margins{} : Margins{NAN};
  });
  EXPECT_EQ(points.size(), 40U);
}

}  // namespace
}  // namespace pitwall::sweep
