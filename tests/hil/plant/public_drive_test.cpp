// The plant against a recorded drive of the real car: its steering angle and speed go in, its yaw
// rate is compared. Nothing was fitted to this drive but the brakes, which take no part here.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hil/plant/plant.hpp"
#include "tests/support/public_data.hpp"

namespace pitwall::plant {
namespace {

constexpr double kUnderWay_mps = 5.0;
constexpr int kStepsPerRow = 40;  // 25 Hz

struct Row {
  double speed_mps, road_wheel_rad, yaw_rate_rad_per_s;
};

std::vector<Row> recorded_drive() {
  const auto path = recordings::path_of(recordings::kDrive);
  std::vector<Row> rows;
  for (const std::vector<double>& v : recordings::gzipped_table(path, ','))
    if (v.size() >= 8) rows.push_back({v[3], v[6], v[7]});
  return rows;
}

// Speed and steering are those of the recording; sliding and yaw are the plant's own.
void impose(const Params& p, const Row& row, State& s) {
  s.motion.vx_mps = row.speed_mps;
  s.motion.steering_motor_rad = row.road_wheel_rad * p.steering.ratio;
  for (std::size_t i = 0; i < world::kCorners; ++i) {
    s.motion.wheel_rad_per_s[i] = row.speed_mps / (i < 2 ? p.front : p.rear).radius_m;
    s.locked[i] = row.speed_mps == 0.0;
  }
}

struct Score {
  double plant_error = 0.0, kinematic_error = 0.0, variance = 0.0;
};

Score replay(const std::vector<Row>& rows) {
  Params p;
  p.steering.delay_s = 0.0;
  const double wheelbase_m = p.chassis.front_axle_m + p.chassis.rear_axle_m;
  State s = rolling(p, standing(p, 0, 0, 0), rows.front().speed_mps, 0);
  double mean = 0.0, count = 0.0;
  for (const Row& row : rows)
    if (row.speed_mps > kUnderWay_mps) mean += row.yaw_rate_rad_per_s, count += 1.0;
  mean /= count;
  Score score;
  for (const Row& row : rows) {
    for (int i = 0; i < kStepsPerRow; ++i) {
      impose(p, row, s);
      s = step(p, s, {.steering_motor_rad = s.motion.steering_motor_rad, .ignition = true}, {},
               0.001);
    }
    if (row.speed_mps <= kUnderWay_mps) continue;
    const double kinematic = row.speed_mps * std::tan(row.road_wheel_rad) / wheelbase_m;
    score.plant_error += std::pow(s.motion.yaw_rate_rad_per_s - row.yaw_rate_rad_per_s, 2);
    score.kinematic_error += std::pow(kinematic - row.yaw_rate_rad_per_s, 2);
    score.variance += std::pow(row.yaw_rate_rad_per_s - mean, 2);
  }
  return score;
}

TEST(PublicDrive, YawRateFollowsTheRealCar) {
  if (!recordings::is_here(recordings::kDrive))
    GTEST_SKIP() << recordings::how_to_get(recordings::kDrive);
  const auto rows = recorded_drive();
  ASSERT_GT(rows.size(), 10'000U);
  const Score score = replay(rows);
  const double explained = 1.0 - score.plant_error / score.variance;
  EXPECT_GE(explained, 0.94);
  EXPECT_LT(score.plant_error, 0.7 * score.kinematic_error);  // a kinematic model is no match
}

}  // namespace
}  // namespace pitwall::plant
