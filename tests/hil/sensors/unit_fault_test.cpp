// A fault does this to a unit, for its time, and nothing else. Each acts on unit 0 between 1 s
// and 2 s of 3 s.
// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/unit_fault.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/hil/sensors/sensor_log.hpp"

namespace pitwall::sensors {
namespace {

plant::Truth somewhere() { return standing_at(5, 5, 1); }

Log with_fault(const Params& p, const UnitFault& fault) {
  const plant::Truth t = somewhere();
  State state = make_state(p, 3, Instant{});
  Log log;
  run(p, state, t, 0, 1000, log);
  state.fault[0] = fault;
  run(p, state, t, 1000, 2000, log);
  state.fault[0] = {};
  run(p, state, t, 2000, 3000, log);
  return log;
}

bool faulty(Instant at) { return at >= Instant{} + seconds(1) && at < Instant{} + seconds(2); }

bool is_touched(const world::GnssPosition& s) { return s.unit == 0 && faulty(s.at); }

// Metres by which each position of `bad` lies off that of `good`.
struct Offset {
  double east_m, north_m, up_m;
};
Offset offset_of(const world::GnssPosition& bad, const world::GnssPosition& good) {
  return {(bad.longitude_deg - good.longitude_deg) * kMetresPerDegreeEast,
          (bad.latitude_deg - good.latitude_deg) * kMetresPerDegreeNorth,
          bad.height_m - good.height_m};
}

TEST(UnitFault, OutageOfOneUnitChangesNothingElse) {
  const Params p = noisy();
  const Log good = with_fault(p, {}), bad = with_fault(p, {.stream = {.outage = true}});
  for (const int unit : {0, 1}) {
    std::vector<world::GnssPosition> expected;
    for (const auto& s : of_unit(good.positions, unit))
      if (unit == 1 || !faulty(s.at)) expected.push_back(s);
    const auto got = of_unit(bad.positions, unit);
    ASSERT_EQ(got.size(), expected.size());
    for (std::size_t i = 0; i < got.size(); ++i) {
      EXPECT_EQ(got[i].at, expected[i].at);
      EXPECT_EQ(got[i].latitude_deg, expected[i].latitude_deg);
    }
  }
  for (const auto& s : of_unit(bad.imu, 0)) EXPECT_FALSE(faulty(s.at));
  for (const auto& s : of_unit(bad.attitudes, 0)) EXPECT_FALSE(faulty(s.at));
  EXPECT_EQ(of_unit(bad.imu, 1).size(), of_unit(good.imu, 1).size());
}

// No fault of a unit touches a draw: outside of its time every sample is bit for bit the same.
TEST(UnitFault, WhatComesAfterIsWhatWouldHaveCome) {
  const Params p = noisy();
  const Log good = with_fault(p, {});
  for (const UnitFault& fault : {UnitFault{.solution = {.fix = Fix::kSingle}},
                                 {.solution = {.fix = Fix::kNone}},
                                 {.solution = {.noise_scale = 5.0}},
                                 {.stream = {.heading_outage = true}},
                                 {.stream = {.gaps = 0.7}},
                                 {.stream = {.not_a_number = true}},
                                 {.imu = {.frozen = true}},
                                 {.imu = {.outage = true}}}) {
    const Log bad = with_fault(p, fault);
    std::size_t i = good.imu.size() - 200, k = bad.imu.size() - 200;
    for (; i < good.imu.size(); ++i, ++k)
      ASSERT_EQ(good.imu[i].rate_rad_per_s, bad.imu[k].rate_rad_per_s);
    for (std::size_t back = 1; back <= 30; ++back) {
      const auto& a = good.positions[good.positions.size() - back];
      const auto& b = bad.positions[bad.positions.size() - back];
      ASSERT_EQ(a.latitude_deg, b.latitude_deg);
      ASSERT_EQ(a.at, b.at);
    }
    ASSERT_EQ(good.headings.back().heading_rad, bad.headings.back().heading_rad);
  }
}

TEST(UnitFault, AnOffsetIsSilent) {
  const Params p = noisy();
  const Log good = with_fault(p, {});
  const Log bad = with_fault(
      p,
      {.solution = {.east_m = 0.3, .north_m = -0.2, .up_m = 0.7, .ahead_m = 2.0, .left_m = 1.0}});
  const double east = 0.3 + 2.0 * std::cos(1.0) - std::sin(1.0);
  const double north = -0.2 + 2.0 * std::sin(1.0) + std::cos(1.0);
  ASSERT_EQ(good.positions.size(), bad.positions.size());
  int moved = 0;
  for (std::size_t i = 0; i < good.positions.size(); ++i) {
    const Offset off = offset_of(bad.positions[i], good.positions[i]);
    const double expected = is_touched(bad.positions[i]) ? 1.0 : 0.0;
    EXPECT_NEAR(off.east_m, expected * east, 2e-3);
    EXPECT_NEAR(off.north_m, expected * north, 2e-3);
    EXPECT_NEAR(off.up_m, expected * 0.7, 2e-3);
    moved += expected > 0.0 ? 1 : 0;
    EXPECT_EQ(bad.positions[i].latitude_sigma_m, good.positions[i].latitude_sigma_m);
    EXPECT_EQ(bad.positions[i].position_type, world::kPositionNarrowInt);
  }
  EXPECT_GT(moved, 15);
}

TEST(UnitFault, ADegradedFixSaysSo) {
  const Params p = noisy();
  for (const auto& [fix, type] : {std::pair{Fix::kRtkFloat, world::kPositionNarrowFloat},
                                  std::pair{Fix::kSingle, world::kPositionSingle}})
    for (const auto& s : of_unit(with_fault(p, {.solution = {.fix = fix}}).positions, 0)) {
      EXPECT_EQ(s.position_type, faulty(s.at) ? type : world::kPositionNarrowInt);
      EXPECT_EQ(s.latitude_sigma_m > 0.1, faulty(s.at));
    }
  for (const SolutionFault& f : {SolutionFault{.sigma_scale = 30.0}, {.added_sigma_m = 0.4}})
    for (const auto& s : of_unit(with_fault(p, {.solution = f}).positions, 0)) {
      EXPECT_EQ(s.latitude_sigma_m > 0.1, faulty(s.at));
      EXPECT_EQ(s.position_type, world::kPositionNarrowInt);
    }
}

TEST(UnitFault, AFloatSolutionIsAsGoodAsItIsSaidToBe) {
  const UnitFault fault{.solution = {.fix = Fix::kRtkFloat, .float_sigma_m = 0.4}};
  for (const auto& s : of_unit(with_fault(noisy(), fault).positions, 0))
    if (faulty(s.at)) {
      EXPECT_NEAR(s.latitude_sigma_m, 0.4, 0.1);
    }
}

TEST(UnitFault, ALiarKeepsItsDeviation) {
  const Params p = noisy();
  const Log good = with_fault(p, {});
  const Log bad = with_fault(p, {.solution = {.noise_scale = 100.0}});
  double largest_m = 0.0;
  for (std::size_t i = 0; i < good.positions.size(); ++i) {
    EXPECT_EQ(bad.positions[i].latitude_sigma_m, good.positions[i].latitude_sigma_m);
    if (!is_touched(bad.positions[i])) continue;
    const Offset off = offset_of(bad.positions[i], good.positions[i]);
    largest_m = std::max(largest_m, std::hypot(off.east_m, off.north_m));
  }
  EXPECT_GT(largest_m, 0.3);
}

TEST(UnitFault, LostCorrectionsGrowOld) {
  const UnitFault fault{.solution = {.added_sigma_m = 0.1, .added_age_s = 20.0}};
  for (const auto& s : of_unit(with_fault(noisy(), fault).positions, 0))
    EXPECT_EQ(s.differential_age_s > 20.0, faulty(s.at));
}

TEST(UnitFault, NoFixIsSentAsTheReceiverSendsIt) {
  const Log log = with_fault(noisy(), {.solution = {.fix = Fix::kNone}});
  for (const auto& s : of_unit(log.positions, 0)) {
    EXPECT_EQ(s.solution_status == world::kSolutionComputed, !faulty(s.at));
    EXPECT_EQ(s.latitude_deg == 0.0, faulty(s.at));
  }
  EXPECT_EQ(of_unit(log.imu, 0).size(), of_unit(with_fault(noisy(), {}).imu, 0).size());
}

TEST(UnitFault, AFrozenPositionIsRepeatedWithLiveTimes) {
  const auto positions =
      of_unit(with_fault(noisy(), {.stream = {.position_frozen = true}}).positions, 0);
  for (std::size_t i = 1; i < positions.size(); ++i) {
    EXPECT_EQ(positions[i].latitude_deg == positions[i - 1].latitude_deg, faulty(positions[i].at));
    EXPECT_GT(positions[i].at, positions[i - 1].at);
  }
}

TEST(UnitFault, AFrozenClockStampsLivePositions) {
  const auto positions =
      of_unit(with_fault(noisy(), {.stream = {.stamp_frozen = true}}).positions, 0);
  int same = 0;
  for (std::size_t i = 1; i < positions.size(); ++i) {
    EXPECT_NE(positions[i].latitude_deg, positions[i - 1].latitude_deg);
    same += positions[i].at == positions[i - 1].at ? 1 : 0;
  }
  EXPECT_EQ(same, 20);
}

TEST(UnitFault, AWrongClockShiftsEverythingOfTheSatellites) {
  const Log good = with_fault(noisy(), {});
  for (const Duration shift : {milliseconds(300), Duration{} - milliseconds(300)}) {
    const Log bad = with_fault(noisy(), {.stream = {.stamp_shift = shift}});
    int shifted = 0;
    for (std::size_t i = 0; i < good.velocities.size(); ++i) {
      const bool touched = good.velocities[i].unit == 0 && faulty(good.velocities[i].at);
      EXPECT_EQ(bad.velocities[i].at - good.velocities[i].at, touched ? shift : Duration{});
      shifted += touched ? 1 : 0;
    }
    EXPECT_EQ(shifted, 20);
    for (std::size_t i = 0; i < good.imu.size(); ++i) EXPECT_EQ(bad.imu[i].at, good.imu[i].at);
  }
}

TEST(UnitFault, ALateUnitIsLateInOrder) {
  const Params p = quiet();
  const Log log = with_fault(p, {.stream = {.added_latency = milliseconds(400)}});
  std::vector<world::GnssPosition> mine;
  for (std::size_t i = 0; i < log.positions.size(); ++i) {
    const auto& s = log.positions[i];
    if (s.unit != 0) continue;
    if (is_touched(s)) {
      EXPECT_EQ(log.position_arrivals[i] - s.at, p.position.latency + milliseconds(400));
    }
    if (!mine.empty()) {
      EXPECT_GT(s.at, mine.back().at);
    }
    mine.push_back(s);
  }
  EXPECT_EQ(log.overflows, 0U);
}

TEST(UnitFault, GapsAreOfTheirShare) {
  const Params p = noisy();
  State state = make_state(p, 3, Instant{});
  state.fault[0].stream.gaps = 0.3;
  Log log;
  run(p, state, somewhere(), 0, 60'000, log);
  EXPECT_NEAR(static_cast<double>(of_unit(log.positions, 0).size()), 0.7 * 1200, 50);
  EXPECT_NEAR(static_cast<double>(of_unit(log.positions, 1).size()), 1200, 2);
}

TEST(UnitFault, NonsenseIsSentAsItIs) {
  for (const auto& s :
       of_unit(with_fault(noisy(), {.stream = {.not_a_number = true}}).positions, 0))
    EXPECT_EQ(std::isnan(s.latitude_deg), faulty(s.at));
  const Log log = with_fault(noisy(), {.stream = {.negative_sigma = true}});
  for (const auto& s : of_unit(log.positions, 0)) EXPECT_EQ(s.latitude_sigma_m < 0.0, faulty(s.at));
  for (const auto& s : of_unit(log.headings, 0)) EXPECT_EQ(s.heading_sigma_rad < 0.0, faulty(s.at));
}

TEST(UnitFault, VelocityAndHeadingAreWrongAlone) {
  const Log good = with_fault(quiet(), {});
  const Log bad =
      with_fault(quiet(), {.solution = {.ahead_mps = 1.0, .left_mps = 2.0, .heading_rad = 0.5}});
  for (std::size_t i = 0; i < good.velocities.size(); ++i)
    if (good.velocities[i].unit == 0 && faulty(good.velocities[i].at)) {
      EXPECT_NEAR(bad.velocities[i].horizontal_mps, std::sqrt(5.0), 1e-9);
    }
  for (std::size_t i = 0; i < good.headings.size(); ++i) {
    const bool touched = good.headings[i].unit == 0 && faulty(good.headings[i].at);
    EXPECT_NEAR(wrap_pi(bad.headings[i].heading_rad - good.headings[i].heading_rad),
                touched ? 0.5 : 0.0, 1e-9);
  }
  for (std::size_t i = 0; i < good.positions.size(); ++i)
    EXPECT_EQ(bad.positions[i].latitude_deg, good.positions[i].latitude_deg);
}

TEST(UnitFault, HeadingAndImuFailAlone) {
  const Log log =
      with_fault(noisy(), {.stream = {.heading_outage = true}, .imu = {.outage = true}});
  for (const auto& s : of_unit(log.imu, 0)) EXPECT_FALSE(faulty(s.at));
  for (const auto& s : of_unit(log.headings, 0)) EXPECT_FALSE(faulty(s.at));
  EXPECT_EQ(of_unit(log.positions, 0).size(), of_unit(with_fault(noisy(), {}).positions, 0).size());
}

TEST(UnitFault, TheInertialUnitIsWrongAsToldTo) {
  const plant::Truth t = somewhere();
  const UnitFault fault{.imu = {.yaw_rate_bias_rad_per_s = 0.05,
                                .ahead_bias_mps2 = 0.4,
                                .left_bias_mps2 = -0.3,
                                .gyro_scale = 1.1}};
  for (const auto& s : with_fault(quiet(), fault).imu) {
    const bool touched = s.unit == 0 && faulty(s.at);
    EXPECT_NEAR(s.rate_rad_per_s[2],
                touched ? 1.1 * t.rate_rad_per_s[2] + 0.05 : t.rate_rad_per_s[2], 1e-12);
    EXPECT_NEAR(s.specific_force_mps2[0] - t.specific_force_mps2[0], touched ? 0.4 : 0.0, 1e-12);
    EXPECT_NEAR(s.specific_force_mps2[1] - t.specific_force_mps2[1], touched ? -0.3 : 0.0, 1e-12);
  }
}

TEST(UnitFault, AFrozenInertialUnitRepeatsItsReading) {
  const auto imu = of_unit(with_fault(noisy(), {.imu = {.frozen = true}}).imu, 0);
  for (std::size_t i = 1; i < imu.size(); ++i) {
    EXPECT_EQ(imu[i].rate_rad_per_s == imu[i - 1].rate_rad_per_s, faulty(imu[i].at));
    EXPECT_GT(imu[i].at, imu[i - 1].at);
  }
  for (const auto& s : of_unit(with_fault(noisy(), {.imu = {.not_a_number = true}}).imu, 0))
    EXPECT_EQ(std::isnan(s.rate_rad_per_s[2]), faulty(s.at));
}

}  // namespace
}  // namespace pitwall::sensors
