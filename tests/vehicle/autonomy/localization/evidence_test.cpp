// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/evidence.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/vehicle/autonomy/localization/drive.hpp"

namespace pitwall::localization {
namespace {

using testing::recommended;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const Datum& datum() {
  static const Datum made = Datum::at(36.0, -115.0, 600.0).value();
  return made;
}

template <class Sample>
Gate gate_of(const Sample& sample) {
  const Params params = recommended();
  return judge(evidence_of(params, datum(), sample), params.checks, {}).gate;
}

world::ImuSample imu(double rate_rad_per_s, double x_mps2, double y_mps2) {
  return {.rate_rad_per_s = {0.0, 0.0, rate_rad_per_s},
          .specific_force_mps2 = {x_mps2, y_mps2, 9.8}};
}

world::GnssVelocity velocity(double speed_mps, double track_rad) {
  return {.solution_status = world::kSolutionComputed,
          .velocity_type = world::kPositionNarrowInt,
          .horizontal_mps = speed_mps,
          .track_over_ground_rad = track_rad,
          .vertical_mps = 0.0};
}

world::GnssHeading heading(double sigma_rad, double heading_rad) {
  return {.solution_status = world::kSolutionComputed,
          .position_type = world::kPositionNarrowInt,
          .heading_rad = heading_rad,
          .heading_sigma_rad = sigma_rad};
}

world::GnssPosition position(double latitude_deg, double sigma_m) {
  return {.solution_status = world::kSolutionComputed,
          .position_type = world::kPositionNarrowInt,
          .latitude_deg = latitude_deg,
          .longitude_deg = -115.0,
          .height_m = 600.0,
          .latitude_sigma_m = sigma_m,
          .longitude_sigma_m = 0.01,
          .height_sigma_m = 0.02};
}

// The same law for every number of a sample: ordinary passes, absurd is implausible, not a number
// is not finite; and both signs are treated alike where both occur.
TEST(Evidence, AnImuMaySayWhatACarCanDo) {
  for (const double rate : {0.0, 0.3, -3.0, 19.9})
    for (const double force : {0.0, 25.0, -40.0, 499.0})
      EXPECT_EQ(gate_of(imu(rate, force, -force)), Gate::kAccepted) << rate << " " << force;
  for (const double absurd : {1e3, -1e3, 1e300, -1e300}) {
    EXPECT_EQ(gate_of(imu(absurd, 0.0, 0.0)), Gate::kImplausible);
    EXPECT_EQ(gate_of(imu(0.0, absurd, 0.0)), Gate::kImplausible);
    EXPECT_EQ(gate_of(imu(0.0, 0.0, absurd)), Gate::kImplausible);
  }
  for (const double no_number : {kUnset, kInfinity, -kInfinity}) {
    EXPECT_EQ(gate_of(imu(no_number, 0.0, 0.0)), Gate::kNotFinite);
    EXPECT_EQ(gate_of(imu(0.0, no_number, 0.0)), Gate::kNotFinite);
    EXPECT_EQ(gate_of(imu(0.0, 0.0, no_number)), Gate::kNotFinite);
  }
}

TEST(Evidence, AVelocityIsASpeedAndADirection) {
  for (double speed = 0.0; speed <= 150.0; speed += 7.5)
    EXPECT_EQ(gate_of(velocity(speed, 6.2)), Gate::kAccepted) << speed;
  EXPECT_EQ(gate_of(velocity(-0.001, 0.0)), Gate::kImplausible);
  EXPECT_EQ(gate_of(velocity(150.1, 0.0)), Gate::kImplausible);
  EXPECT_EQ(gate_of(velocity(10.0, -13.0)), Gate::kImplausible);
  EXPECT_EQ(gate_of(velocity(kUnset, 0.0)), Gate::kNotFinite);
  world::GnssVelocity v = velocity(10.0, 0.0);
  v.sigma_mps = -0.01;
  EXPECT_EQ(gate_of(v), Gate::kNegativeVariance);
  v.sigma_mps = 3.0;
  EXPECT_EQ(gate_of(v), Gate::kTooUncertain);
  v.solution_status = 1;
  EXPECT_EQ(gate_of(v), Gate::kNotSolved);
}

TEST(Evidence, AHeadingIsAsGoodAsItsSigmaAndItsBaseline) {
  const double most_rad = recommended().heading_sigma_max_rad;
  EXPECT_EQ(gate_of(heading(0.0, 3.0)), Gate::kAccepted);
  EXPECT_EQ(gate_of(heading(most_rad, 3.0)), Gate::kAccepted);
  EXPECT_EQ(gate_of(heading(most_rad * 1.001, 3.0)), Gate::kTooUncertain);
  EXPECT_EQ(gate_of(heading(-0.001, 3.0)), Gate::kNegativeVariance);
  EXPECT_EQ(gate_of(heading(0.001, 100.0)), Gate::kImplausible);
  EXPECT_EQ(gate_of(heading(kUnset, 3.0)), Gate::kNotFinite);
  for (const std::uint8_t unit : {std::uint8_t{0}, std::uint8_t{1}}) {
    for (const double error_m : {-0.2, 0.0, 0.2}) {
      world::GnssHeading h = heading(0.001, 3.0);
      h.unit = unit;
      h.baseline_m = recommended().units[unit].baseline_m + error_m;
      EXPECT_EQ(gate_of(h), error_m == 0.0 ? Gate::kAccepted : Gate::kWrongBaseline);
    }
  }
}

TEST(Evidence, APositionIsOnTheEarthAndSureEnough) {
  const double most_m = recommended().position_sigma_max_m;
  EXPECT_EQ(gate_of(position(36.0, 0.01)), Gate::kAccepted);
  EXPECT_EQ(gate_of(position(36.0, most_m)), Gate::kAccepted);
  EXPECT_EQ(gate_of(position(36.0, most_m * 1.001)), Gate::kTooUncertain);
  EXPECT_EQ(gate_of(position(36.0, -0.01)), Gate::kNegativeVariance);
  EXPECT_EQ(gate_of(position(136.0, 0.01)), Gate::kImplausible);
  EXPECT_EQ(gate_of(position(kUnset, 0.01)), Gate::kNotFinite);
  world::GnssPosition without_height = position(36.0, 0.01);
  without_height.height_m = kUnset;
  EXPECT_EQ(gate_of(without_height), Gate::kNotFinite) << "and no height is made up";
  world::GnssPosition old = position(36.0, 0.01);
  old.differential_age_s = 30.0;
  EXPECT_EQ(gate_of(old), Gate::kOldCorrections);
}

TEST(Evidence, AnAttitudeCountsWhenItsStatusIsGood) {
  using enum world::InsStatus;
  for (const auto status : {kInactive, kAligning, kHighVariance, kGood, kFree}) {
    const world::InsAttitude a{.status = status,
                               .roll_rad = 0.0,
                               .pitch_rad = 0.0,
                               .heading_rad = 1.0,
                               .roll_sigma_rad = 0.001,
                               .pitch_sigma_rad = 0.001,
                               .heading_sigma_rad = 0.002};
    EXPECT_EQ(gate_of(a), status == kGood ? Gate::kAccepted : Gate::kNotSolved);
  }
}

TEST(Evidence, TypesAreRankedByHowGoodTheyCanBe) {
  EXPECT_EQ(rank_of(world::kPositionNone), 0.0);
  EXPECT_EQ(rank_of(world::kPositionSingle), 1.0);
  EXPECT_EQ(rank_of(world::kPositionNarrowFloat), 2.0);
  EXPECT_EQ(rank_of(world::kPositionNarrowInt), 3.0);
  EXPECT_EQ(rank_of(4'000'000'000U), 1.0) << "what is not known is not trusted far";
}

}  // namespace
}  // namespace pitwall::localization
