// The plant against a recorded drive of the real car: its steering angle and speed go in, its yaw
// rate is compared. The car is that of the file with the drive's understeer; the recorded steering
// leads by some 0.3 s (public_plant_file_test.cpp), for the kinematic model as for the plant.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hil/plant/plant.hpp"
#include "tests/hil/plant/free_wheels.hpp"
#include "tests/hil/plant/shipped.hpp"
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
  roll_freely(p, s);
}

struct Score {
  double plant_error = 0.0, kinematic_error = 0.0, variance = 0.0;
};

// The speed of each row with the steering of a little before.
std::vector<Row> recorded_drive_in_time() {
  constexpr std::size_t kLead = 7;  // rows
  const std::vector<Row> recorded = recorded_drive();
  std::vector<Row> rows = recorded;
  for (std::size_t i = kLead; i < rows.size(); ++i)
    rows[i].road_wheel_rad = recorded[i - kLead].road_wheel_rad;
  return rows;
}

Score replay(const std::vector<Row>& rows, Params p) {
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
  const auto rows = recorded_drive_in_time();
  ASSERT_GT(rows.size(), 10'000U);
  const Score score = replay(rows, testing::shipped_car("av21_putnam").params);
  const double explained = 1.0 - score.plant_error / score.variance;
  EXPECT_GE(explained, 0.94);
  EXPECT_LT(score.plant_error, 0.7 * score.kinematic_error);  // a kinematic model is no match
}

}  // namespace
}  // namespace pitwall::plant
