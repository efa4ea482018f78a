// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/perception/detection_table.hpp"

#include <gtest/gtest.h>

#include "hil/scenario/lidar_error_file.hpp"

namespace pitwall::perception_bench {
namespace {

DetectorRow some_row() {
  DetectorRow row{"held back", "pillar network", {}};
  row.score.sweeps = 200, row.score.false_cars = 5;
  row.score.by_range[0] = {.cars = 50, .found = 49, .squares_m2 = 0.49, .yaw_squares_rad2 = 0.0049};
  row.score.by_range[1] = {.cars = 80, .found = 60, .squares_m2 = 15.0, .yaw_squares_rad2 = 0.6};
  return row;
}

TEST(DetectionTable, TheBenchReadsTheErrorsAsTheyWereMeasured) {
  const auto errors = scenario::read_lidar_errors(error_file(some_row()), "e.yaml");
  ASSERT_TRUE(errors) << to_string(errors.error());
  EXPECT_EQ(errors->false_per_sweep, 0.025);
  ASSERT_EQ(errors->rows.size(), 2U) << "no car was further away";
  EXPECT_EQ(errors->rows[0].to_m, 20.0);
  EXPECT_NEAR(errors->rows[0].found_share, 0.98, 1e-6);
  EXPECT_NEAR(errors->rows[0].position_rms_m, 0.1, 1e-6);
  EXPECT_NEAR(errors->rows[0].yaw_rms_rad, 0.01, 1e-5);
  EXPECT_NEAR(errors->rows[1].found_share, 0.75, 1e-6);
  EXPECT_NEAR(errors->rows[1].position_rms_m, 0.5, 1e-6);
}

TEST(DetectionTable, AGateIsMissedWhereTheFigureIsWorse) {
  cost::CostGates held, missed;
  DetectorRow good = some_row();
  good.score.false_cars = 2;
  good.score.by_range[1] = {.cars = 80, .found = 80, .squares_m2 = 0.8, .yaw_squares_rad2 = 0.1};
  good.score.by_range[3] = {.cars = 20, .found = 19, .squares_m2 = 1.0, .yaw_squares_rad2 = 0.1};
  add_gates(good.score, held);
  EXPECT_TRUE(held.held()) << held.text();
  add_gates(some_row().score, missed);
  EXPECT_FALSE(missed.held());
}

TEST(DetectionTable, DecoysMayLookLikeACarInTwoOfAHundredSweeps) {
  cost::CostGates held, missed;
  DetectionScore score{.sweeps = 100, .false_cars = 2};
  add_decoy_gate(score, held);
  EXPECT_TRUE(held.held()) << held.text();
  score.false_cars = 3;
  add_decoy_gate(score, missed);
  EXPECT_FALSE(missed.held()) << missed.text();
}

}  // namespace
}  // namespace pitwall::perception_bench
