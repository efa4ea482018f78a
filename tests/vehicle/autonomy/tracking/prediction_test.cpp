// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/prediction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/autonomy/tracking/race.hpp"

namespace pitwall::tracking {
namespace {

using testing::Car;
using testing::kRadius_m;
using testing::round_track;

world::Opponent known(const testing::TruePose& p) {
  world::Opponent car{.id = 4, .x_m = p.x_m, .y_m = p.y_m, .yaw_rad = p.yaw_rad};
  car.speed_mps = p.speed_mps, car.accel_mps2 = 0.0;
  car.yaw_rate_rad_per_s = p.speed_mps / (kRadius_m - 4.0);
  for (std::size_t i = 0; i < 4; ++i) car.covariance[5 * i] = 1e-4;
  return car;
}

// With a map a car goes on round the bend for as long as it is asked for.
TEST(Prediction, FollowsTheRoad) {
  const Car car{.s_m = 1500.0, .n_m = 4.0, .speed_mps = 70.0};
  for (const double ahead_s : {0.0, 0.3, 1.0, 4.0}) {
    const auto there = predict(Params{}, known(car.at(0.0)), &round_track(), from_seconds(ahead_s));
    ASSERT_TRUE(there);
    EXPECT_LT(testing::distance_m(*there, car.at(ahead_s)), 0.01) << ahead_s;
    EXPECT_NEAR(there->n_m, 4.0, 0.01);
    EXPECT_NEAR(there->yaw_rate_rad_per_s, 70.0 / (kRadius_m - 4.0), 1e-3);
    EXPECT_EQ(there->id, 4U);
  }
}

// Without a map it turns on as it does, until that is forgotten.
TEST(Prediction, TurnsOnAPlane) {
  const Car car{.s_m = 1500.0, .n_m = 4.0, .speed_mps = 70.0};
  const auto there = predict(Params{}, known(car.at(0.0)), nullptr, from_seconds(0.5));
  ASSERT_TRUE(there);
  EXPECT_LT(testing::distance_m(*there, car.at(0.5)), 0.3);
  EXPECT_TRUE(std::isnan(there->s_m));
}

TEST(Prediction, NoTimeChangesNothing) {
  world::Opponent car = known(Car{.s_m = 300.0, .n_m = -2.0}.at(0.0));
  car.covariance = {4.0, 0.5,  0.1,  0.2,  0.5, 3.0, 0.05, 0.1,
                    0.1, 0.05, 0.01, 0.02, 0.2, 0.1, 0.02, 1.0};
  for (const world::TrackMap* track :
       {&round_track(), static_cast<const world::TrackMap*>(nullptr)}) {
    const auto there = predict(Params{}, car, track, Duration{});
    ASSERT_TRUE(there);
    EXPECT_NEAR(there->x_m, car.x_m, 1e-6);
    EXPECT_NEAR(there->y_m, car.y_m, 1e-6);
    for (std::size_t i = 0; i < 16; ++i)
      EXPECT_NEAR(there->covariance[i], car.covariance[i], 1e-9) << i;
  }
}

TEST(Prediction, CovarianceGrows) {
  const world::Opponent car = known(Car{.s_m = 300.0}.at(0.0));
  double before_m2 = 0.0;
  for (int k = 0; k <= 10; ++k) {
    const auto there = predict(Params{}, car, &round_track(), milliseconds(500) * k);
    ASSERT_TRUE(there);
    const double now_m2 = there->covariance[0] + there->covariance[5];
    EXPECT_GT(now_m2, before_m2);
    before_m2 = now_m2;
  }
}

TEST(Prediction, RefusesWhatItCannotPredict) {
  const world::Opponent car = known(Car{}.at(0.0));
  EXPECT_FALSE(predict(Params{}, car, nullptr, milliseconds(-1)));
  EXPECT_FALSE(predict(Params{}, car, nullptr, milliseconds(5001)));
  for (double world::Opponent::*value :
       {&world::Opponent::x_m, &world::Opponent::yaw_rad, &world::Opponent::accel_mps2}) {
    world::Opponent bad = car;
    bad.*value = kUnset;
    EXPECT_FALSE(predict(Params{}, bad, &round_track(), seconds(1)));
  }
  world::Opponent bad = car;
  bad.covariance[7] = kUnset;
  EXPECT_FALSE(predict(Params{}, bad, &round_track(), seconds(1)));
}

}  // namespace
}  // namespace pitwall::tracking
