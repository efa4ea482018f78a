// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/perception/detection_score.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace pitwall::perception_bench {
namespace {

using perception::CarBox;
using sensors::TrueBox;

TrueBox car_at(double x_m, double y_m, std::size_t returns = 50) {
  return {.x_m = x_m, .y_m = y_m, .yaw_rad = 0.1, .returns = returns};
}
CarBox box_at(double x_m, double y_m, double yaw_rad = 0.1) {
  return {.x_m = x_m, .y_m = y_m, .yaw_rad = yaw_rad};
}

DetectionScore score_of(const std::vector<TrueBox>& cars, const std::vector<CarBox>& boxes) {
  DetectionScore sums;
  score(cars, boxes, sums);
  return sums;
}

TEST(DetectionScore, CountsByDistance) {
  const auto sums =
      score_of({car_at(10, 0), car_at(-35, 0), car_at(50, 0)}, {box_at(10.3, 0.4), box_at(50, 1)});
  EXPECT_EQ(sums.by_range[0].cars, 1U);
  EXPECT_EQ(sums.by_range[0].found, 1U);
  EXPECT_NEAR(sums.by_range[0].position_rms_m(), 0.5, 1e-12);
  EXPECT_EQ(sums.by_range[1].found, 0U);
  EXPECT_EQ(sums.by_range[1].cars, 1U);
  EXPECT_NEAR(sums.between(0.0, 60.0).found_share(), 2.0 / 3.0, 1e-12);
  EXPECT_EQ(sums.false_cars, 0U);
}

TEST(DetectionScore, EachBoxIsOfOneCarAtMost) {
  const auto sums = score_of({car_at(10, 0), car_at(10, 2)}, {box_at(10, 0.9)});
  EXPECT_EQ(sums.by_range[0].found, 1U);
  EXPECT_NEAR(sums.by_range[0].worst_m, 0.9, 1e-12) << "the nearest of the two";
  EXPECT_EQ(score_of({car_at(10, 0)}, {box_at(10, 0), box_at(10.5, 0)}).false_cars, 1U);
}

TEST(DetectionScore, ACarWithHardlyAReturnIsNotAskedFor) {
  const auto sums = score_of({car_at(10, 0, 4)}, {box_at(10, 0)});
  EXPECT_EQ(sums.by_range[0].cars, 0U);
  EXPECT_EQ(sums.by_range[0].found, 0U);
  EXPECT_EQ(sums.false_cars, 0U) << "nor is its detection false";
  EXPECT_EQ(score_of({}, {box_at(30, 0)}).false_cars, 1U);
}

TEST(DetectionScore, FrontAndBackMayBeExchanged) {
  const auto sums = score_of({car_at(10, 0)}, {box_at(10, 0, 0.15 - std::numbers::pi)});
  EXPECT_NEAR(sums.by_range[0].yaw_rms_rad(), 0.05, 1e-12);
}

TEST(DetectionScore, SumsAreThoseOfAllSweeps) {
  DetectionScore all;
  for (int i = 0; i < 4; ++i) all.add(score_of({car_at(10, 0)}, {box_at(10, 0), box_at(90, 0)}));
  EXPECT_EQ(all.sweeps, 4U);
  EXPECT_EQ(all.by_range[0].cars, 4U);
  EXPECT_NEAR(all.false_per_sweep(), 1.0, 1e-12);
}

}  // namespace
}  // namespace pitwall::perception_bench
