// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/speed_table.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace pitwall::speed_bench {
namespace {

SpeedRow good() {
  SpeedRow row;
  row.track = "LVMS", row.world = "nominal", row.law = control_bench::kOurs;
  row.steady.add(0.3);
  row.driving.add(0.9);
  row.overshoot_mps = 0.5;
  row.brakings = row.slow_downs = 3;
  row.shifts = row.crossings = 14;
  return row;
}

TEST(SpeedTable, AtItsBoundsEveryGateIsHeld) {
  EXPECT_TRUE(all_held({good()}));
  EXPECT_FALSE(all_held({})) << "nothing was measured";
}

TEST(SpeedTable, EachGateFailsByItsOwnFigureAndSaysWhere) {
  const std::vector<std::function<void(SpeedRow&)>> worse{
      [](SpeedRow& r) { r.steady.add(0.31); }, [](SpeedRow& r) { r.overshoot_mps = 0.51; },
      [](SpeedRow& r) { ++r.brakings; }, [](SpeedRow& r) { ++r.shifts; },
      [](SpeedRow& r) { r.refusals = 1; }};
  for (std::size_t i = 0; i < worse.size(); ++i) {
    SpeedRow row = good();
    worse[i](row);
    row.world = "another car";
    const std::vector<Gate> gates = gates_of({good(), row});
    for (std::size_t k = 0; k < gates.size(); ++k)
      EXPECT_EQ(gates[k].held, k != i) << i << ' ' << k;
    EXPECT_NE(gates[i].worst.find("another car"), std::string::npos);
  }
}

TEST(SpeedTable, APedalAtAHeldSpeedAMissedShiftAndAnEarlyEndFail) {
  SpeedRow row = good();
  row.steady_brakings = 1, row.brakings = 1;
  EXPECT_FALSE(all_held({row}));
  row = good();
  row.missed_shifts = 1, row.shifts = 2;
  EXPECT_FALSE(all_held({row}));
  row = good();
  row.end = "wall";
  EXPECT_FALSE(all_held({row}));
  row = good();
  row.overshoot_mps = kUnset;
  EXPECT_FALSE(all_held({row})) << "never measured";
}

TEST(SpeedTable, ThePapersRowIsShownAndNotJudged) {
  SpeedRow paper = good();
  paper.law = control_bench::kPaper, paper.overshoot_mps = 2.0;
  EXPECT_TRUE(all_held({good(), paper}));
  EXPECT_NE(to_text({good(), paper}).find("paper_lqr"), std::string::npos);
  EXPECT_NE(to_json({good(), paper}).find("\"law\": \"paper_lqr\""), std::string::npos);
}

}  // namespace
}  // namespace pitwall::speed_bench
