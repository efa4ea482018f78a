// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/sample_gate.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/vehicle/autonomy/localization/drive.hpp"

namespace pitwall::localization {
namespace {

using testing::recommended;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

world::ImuSample imu(double rate_rad_per_s, double x_mps2, double y_mps2) {
  return {.rate_rad_per_s = {0.0, 0.0, rate_rad_per_s},
          .specific_force_mps2 = {x_mps2, y_mps2, 9.8}};
}

world::GnssVelocity velocity(double speed_mps, double track_rad) {
  return {.solution_status = world::kSolutionComputed,
          .velocity_type = world::kPositionNarrowInt,
          .horizontal_mps = speed_mps,
          .track_over_ground_rad = track_rad};
}

// The same law for every number of a sample: ordinary passes, absurd is implausible, not a number
// is not finite; and both signs are treated alike where both occur.
TEST(SampleGate, AnImuMaySayWhatACarCanDo) {
  for (const double rate : {0.0, 0.3, -3.0, 19.9})
    for (const double force : {0.0, 25.0, -40.0, 499.0})
      EXPECT_EQ(contents(imu(rate, force, -force)), Gate::kAccepted) << rate << " " << force;
  for (const double absurd : {1e3, -1e3, 1e300, -1e300}) {
    EXPECT_EQ(contents(imu(absurd, 0.0, 0.0)), Gate::kImplausible);
    EXPECT_EQ(contents(imu(0.0, absurd, 0.0)), Gate::kImplausible);
    EXPECT_EQ(contents(imu(0.0, 0.0, absurd)), Gate::kImplausible);
  }
  for (const double no_number : {kUnset, kInfinity, -kInfinity}) {
    EXPECT_EQ(contents(imu(no_number, 0.0, 0.0)), Gate::kNotFinite);
    EXPECT_EQ(contents(imu(0.0, no_number, 0.0)), Gate::kNotFinite);
    EXPECT_EQ(contents(imu(0.0, 0.0, no_number)), Gate::kNotFinite);
  }
}

TEST(SampleGate, AVelocityIsASpeedAndADirection) {
  for (double speed = 0.0; speed <= 150.0; speed += 7.5)
    EXPECT_EQ(contents(velocity(speed, 6.2)), Gate::kAccepted) << speed;
  EXPECT_EQ(contents(velocity(-0.001, 0.0)), Gate::kImplausible);
  EXPECT_EQ(contents(velocity(150.1, 0.0)), Gate::kImplausible);
  EXPECT_EQ(contents(velocity(10.0, -13.0)), Gate::kImplausible);
  EXPECT_EQ(contents(velocity(kUnset, 0.0)), Gate::kNotFinite);
  world::GnssVelocity unsolved = velocity(10.0, 0.0);
  unsolved.solution_status = 1;
  EXPECT_EQ(contents(unsolved), Gate::kNotSolved);
}

TEST(SampleGate, AHeadingIsAsGoodAsItsSigma) {
  const Params params = recommended();
  const auto heading = [&](double sigma_rad, double heading_rad) {
    return contents(params, {.solution_status = world::kSolutionComputed,
                             .position_type = world::kPositionNarrowInt,
                             .heading_rad = heading_rad,
                             .heading_sigma_rad = sigma_rad});
  };
  EXPECT_EQ(heading(0.0, 3.0), Gate::kAccepted);
  EXPECT_EQ(heading(params.heading_sigma_max_rad, 3.0), Gate::kAccepted);
  EXPECT_EQ(heading(params.heading_sigma_max_rad * 1.001, 3.0), Gate::kTooUncertain);
  EXPECT_EQ(heading(-0.001, 3.0), Gate::kImplausible);
  EXPECT_EQ(heading(0.001, 100.0), Gate::kImplausible);
  EXPECT_EQ(heading(kUnset, 3.0), Gate::kNotFinite);
}

TEST(SampleGate, APositionIsOnTheEarthAndSureEnough) {
  const Params params = recommended();
  const Datum datum = Datum::at(36.0, -115.0, 600.0).value();
  const auto position = [&](double latitude_deg, double sigma_m) {
    return contents(params, datum,
                    {.solution_status = world::kSolutionComputed,
                     .position_type = world::kPositionNarrowInt,
                     .latitude_deg = latitude_deg,
                     .longitude_deg = -115.0,
                     .height_m = 600.0,
                     .latitude_sigma_m = sigma_m,
                     .longitude_sigma_m = 0.01});
  };
  EXPECT_EQ(position(36.0, 0.01), Gate::kAccepted);
  EXPECT_EQ(position(36.0, params.position_sigma_max_m), Gate::kAccepted);
  EXPECT_EQ(position(36.0, params.position_sigma_max_m * 1.001), Gate::kTooUncertain);
  EXPECT_EQ(position(36.0, -0.01), Gate::kImplausible);
  EXPECT_EQ(position(136.0, 0.01), Gate::kNotFinite);
}

}  // namespace
}  // namespace pitwall::localization
