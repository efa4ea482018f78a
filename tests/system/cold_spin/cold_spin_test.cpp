// A short cut of `./pitwall long spin`: a few seeds of it, both chains.
// SPDX-License-Identifier: Apache-2.0
#include "tests/system/cold_spin/cold_spin.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "protocol/json/json_value.hpp"

namespace pitwall::testing {
namespace {

// Of ten seeds the one that draws the least grip.
TEST(ColdSpin, WithTheLeastGripThePublishedChainIsLostAndOursIsNot) {
  std::uint64_t worst = 1;
  for (std::uint64_t seed = 2; seed <= 10; ++seed)
    if (drawn_loss(seed) > drawn_loss(worst)) worst = seed;
  const std::vector<SpinRun> runs = run_spins(
      {{worst, Chain::kOurs, base_speed_mph()}, {worst, Chain::kPaper, base_speed_mph()}}, 2);
  for (const SpinRun& run : runs) std::printf("%s\n", row_of(run).c_str());
  EXPECT_EQ(fault_of(runs), "");
}

TEST(ColdSpin, TheLossIsDrawnFromItsWholeRangeAndByTheSeedAlone) {
  double least = 1.0, most = 0.0, sum = 0.0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const double loss = drawn_loss(seed);
    EXPECT_EQ(loss, drawn_loss(seed));
    least = std::min(least, loss), most = std::max(most, loss), sum += loss / 100.0;
  }
  EXPECT_GE(least, kLossLeast);
  EXPECT_LT(least, kLossLeast + 0.01);
  EXPECT_LT(most, kLossMost);
  EXPECT_GT(most, kLossMost - 0.01);
  EXPECT_NEAR(sum, 0.35, 0.02);
}

// A judge that sees nothing would pass everything.
TEST(ColdSpin, TheGatesAreNotMetByWhateverHappens) {
  const auto runs = [](bool ours_spins, bool paper_spins, bool raised = true) {
    std::vector<SpinRun> all;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      SpinRun ours, paper;
      ours.of.seed = paper.of.seed = seed;
      paper.of.chain = Chain::kPaper;
      ours.raised = raised, paper.raised = true, paper.spun = paper_spins;
      all.insert(all.end(), {ours, paper});
    }
    all[0].left = ours_spins;
    return all;
  };
  EXPECT_EQ(fault_of(runs(false, true)), "");
  EXPECT_NE(fault_of(runs(true, true)), "");
  EXPECT_NE(fault_of(runs(false, false)), "");
  EXPECT_NE(fault_of(runs(false, true, false)), "");
  EXPECT_NE(fault_of({}), "");
  auto most = runs(false, true);
  most[1].spun = false;
  EXPECT_EQ(fault_of(most), "") << "nine of ten";
  most[3].spun = false;
  EXPECT_NE(fault_of(most), "") << "eight of ten";
}

TEST(ColdSpin, TheFiguresAreJson) {
  SpinRun run;
  run.of = {7, Chain::kPaper, 135.0};
  const std::vector<SpinRun> runs{run};
  const auto json = json::JsonValue::parse(to_json(runs), "figures");
  ASSERT_TRUE(json) << to_string(json.error());
  const json::JsonValue& each = json->items("each")[0];
  EXPECT_EQ(each.number("seed"), 7.0);
  EXPECT_EQ(each.number("base_mph"), 135.0);
  EXPECT_EQ(each.text("chain"), "paper");
}

}  // namespace
}  // namespace pitwall::testing
