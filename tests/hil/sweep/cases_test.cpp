// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>
#include <utility>

#include "tests/hil/sweep/plan_text.hpp"

namespace pitwall::sweep {
namespace {

Cases cases_of(const std::string& text) {
  auto plan = read_plan(text, "p.yaml");
  EXPECT_TRUE(plan) << (plan ? "" : to_string(plan.error()));
  return Cases{*std::move(plan)};
}

std::string text_of(const Case& of) {
  std::string text;
  for (const yaml::Setting& setting : of.settings) text += setting.path + "=" + setting.value + " ";
  return text;
}

TEST(SweepCases, DrawnOnesLieInTheirRangesAndFillThem) {
  const Cases cases = cases_of(drawn_plan());
  ASSERT_EQ(cases.size(), 40U);
  double least = 9.0, most = 0.0;
  std::set<std::string> winds, seeds;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case of = cases.at(i);
    ASSERT_EQ(of.settings.size(), 3U);
    const double friction = std::strtod(of.settings[0].value.c_str(), nullptr);
    least = std::min(least, friction), most = std::max(most, friction);
    winds.insert(of.settings[1].value);
    EXPECT_EQ(of.settings[2].path, "seed");
    seeds.insert(of.settings[2].value);
  }
  EXPECT_GE(least, 0.5);
  EXPECT_LE(most, 1.5);
  EXPECT_LT(least, 0.6);
  EXPECT_GT(most, 1.4);
  EXPECT_EQ(winds, (std::set<std::string>{"0", "8"}));
  EXPECT_EQ(seeds.size(), cases.size());
}

TEST(SweepCases, ACaseDependsOnItsNumberAndThePlanAlone) {
  const Cases cases = cases_of(drawn_plan()), again = cases_of(drawn_plan());
  const Cases longer = cases_of(spoilt(drawn_plan(), "cases: 40", "cases: 4000"));
  const Cases other = cases_of(spoilt(drawn_plan(), "seed: 3", "seed: 4"));
  for (const std::size_t i : {0U, 7U, 39U}) {
    EXPECT_EQ(text_of(cases.at(i)), text_of(again.at(i)));
    EXPECT_EQ(text_of(cases.at(i)), text_of(longer.at(i)));
    EXPECT_NE(text_of(cases.at(i)), text_of(other.at(i)));
  }
}

TEST(SweepCases, AllAreEveryCombinationOnceForEachRepeat) {
  const std::string text = listed_plan("all\nrepeats: 2", {3, 2, 4});
  const Cases cases = cases_of(text);
  ASSERT_EQ(cases.size(), 48U);
  std::multiset<std::string> combinations;
  std::set<std::string> whole;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    Case of = cases.at(i);
    whole.insert(text_of(of));
    of.settings.pop_back();  // the seed
    combinations.insert(text_of(of));
  }
  EXPECT_EQ(whole.size(), 48U) << "repeats differ by their seed";
  for (const std::string& one : combinations) EXPECT_EQ(combinations.count(one), 2U) << one;
}

TEST(SweepCases, OfPairsEveryTwoValuesMeetInFewCases) {
  for (const std::vector<int>& counts : std::vector<std::vector<int>>{
           {3, 3, 3, 3}, {2, 2, 2, 2, 2, 2, 2, 2}, {10, 4, 3, 2}, {5, 5}, {7}, {1, 1, 1}}) {
    const Cases cases = cases_of(listed_plan("pairs", counts));
    std::set<std::pair<std::string, std::string>> met;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const Case of = cases.at(i);
      for (std::size_t a = 0; a < counts.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
          met.insert({of.settings[a].value, of.settings[b].value});
    }
    std::size_t pairs = 0, all = 1;
    std::vector<int> sorted = counts;
    std::ranges::sort(sorted, std::ranges::greater{});
    const auto least = static_cast<std::size_t>(sorted[0] * (sorted.size() > 1 ? sorted[1] : 1));
    for (std::size_t a = 0; a < counts.size(); ++a) {
      all *= static_cast<std::size_t>(counts[a]);
      for (std::size_t b = 0; b < a; ++b) pairs += static_cast<std::size_t>(counts[a] * counts[b]);
    }
    EXPECT_EQ(met.size(), pairs);
    EXPECT_GE(cases.size(), least);
    EXPECT_LE(cases.size(), std::min(all, 2 * least + 4));
  }
}

TEST(SweepCases, ASeedThatIsAParameterStandsOnce) {
  const Cases cases =
      cases_of(spoilt(drawn_plan(), "perturb.wind_mps, values: [0, 8]", "seed, values: [1, 2]"));
  for (std::size_t i = 0; i < cases.size(); ++i) ASSERT_EQ(cases.at(i).settings.size(), 2U);
}

}  // namespace
}  // namespace pitwall::sweep
