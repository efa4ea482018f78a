// SPDX-License-Identifier: Apache-2.0
#include "hil/faults/sensor_faults.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

namespace pitwall::faults {
namespace {

constexpr double kValue = 0.5;  // legal for every kind

struct Effect {
  std::array<sensors::UnitFault, world::kGnssUnits> unit;
  std::array<sensors::WheelFault, world::kCorners> wheel;
};

Effect effect_of(std::initializer_list<BenchFault> rows, Instant now) {
  sensors::State receivers;
  sensors::WheelState wheels;
  for (const BenchFault& row : rows) apply_sensor_fault(row, now, receivers, wheels);
  return {receivers.fault, wheels.fault};
}

// Field by field through their bytes would see padding; the text of all numbers does not.
std::string print(const sensors::UnitFault& f) {
  std::string text;
  const auto add = [&text](auto... values) {
    ((text += std::to_string(static_cast<double>(values)) + ' '), ...);
  };
  const auto& s = f.solution;
  add(static_cast<int>(s.fix), s.float_sigma_m, s.sigma_scale, s.noise_scale, s.added_sigma_m,
      s.added_age_s, s.east_m, s.north_m, s.up_m, s.ahead_m, s.left_m, s.ahead_mps, s.left_mps,
      s.heading_rad);
  const auto& t = f.stream;
  add(t.outage, t.heading_outage, t.position_frozen, t.stamp_frozen, t.stamp_shift.ns,
      t.added_latency.ns, t.gaps, t.not_a_number, t.negative_sigma);
  const auto& i = f.imu;
  add(i.outage, i.frozen, i.not_a_number, i.yaw_rate_bias_rad_per_s, i.ahead_bias_mps2,
      i.left_bias_mps2, i.gyro_scale);
  return text;
}

TEST(SensorFaults, EveryKindDoesSomethingOfItsOwnToItsUnitOnly) {
  std::vector<std::string> seen{print({})};
  int kinds = 0;
  for (const auto& row : faults::kBenchFaults) {
    if (!is_sensor_fault(row.kind)) continue;
    ++kinds;
    EXPECT_TRUE(is_sensor_value(row.kind, kValue)) << row.name;
    const bool of_wheel = parts_of(row.kind) == world::kCorners;
    EXPECT_EQ(of_wheel, row.acts_on == BenchPart::kWheels) << row.name;
    const BenchFault fault{.kind = row.kind, .unit = 1, .value = kValue};
    const Effect e = effect_of({fault}, Instant{} + milliseconds(50));
    EXPECT_EQ(print(e.unit[0]), print({})) << row.name;
    if (of_wheel) {
      EXPECT_NE(e.wheel[1].trouble, sensors::WheelTrouble::kNone) << row.name;
      EXPECT_EQ(e.wheel[0].trouble, sensors::WheelTrouble::kNone) << row.name;
      continue;
    }
    for (const std::string& other : seen) EXPECT_NE(print(e.unit[1]), other) << row.name;
    seen.push_back(print(e.unit[1]));
  }
  EXPECT_GE(kinds, 38);
}

TEST(SensorFaults, RowsAddUp) {
  const Instant now = Instant{} + seconds(3);
  const Effect e = effect_of({{.kind = BenchFaultKind::kGnssPositionJump, .value = 0.3},
                              {.kind = BenchFaultKind::kGnssPositionJumpNorth, .value = -0.4},
                              {.kind = BenchFaultKind::kGnssPositionJump, .value = 0.2},
                              {.kind = BenchFaultKind::kGnssPositionDrift, .value = 0.1},
                              {.kind = BenchFaultKind::kGnssPositionJumpLeft, .value = 1.0}},
                             now);
  EXPECT_NEAR(e.unit[0].solution.east_m, 0.5, 1e-12);
  EXPECT_NEAR(e.unit[0].solution.north_m, -0.4, 1e-12);
  EXPECT_NEAR(e.unit[0].solution.left_m, 1.3, 1e-12);
}

TEST(SensorFaults, WhatGrowsGrowsFromItsStart) {
  const Instant start = Instant{} + seconds(10);
  const auto solution = [&](BenchFaultKind kind, double after_s) {
    return effect_of({{.kind = kind, .start = start, .value = 2.0}}, start + from_seconds(after_s))
        .unit[0]
        .solution;
  };
  EXPECT_EQ(solution(BenchFaultKind::kGnssPositionDriftAhead, 0.0).ahead_m, 0.0);
  EXPECT_NEAR(solution(BenchFaultKind::kGnssPositionDriftAhead, 4.0).ahead_m, 8.0, 1e-12);
  EXPECT_NEAR(solution(BenchFaultKind::kGnssCorrectionsLost, 4.0).added_sigma_m, 8.0, 1e-12);
  EXPECT_NEAR(solution(BenchFaultKind::kGnssCorrectionsLost, 4.0).added_age_s, 4.0, 1e-12);
  EXPECT_NEAR(solution(BenchFaultKind::kGnssRtkFloat, 0.0).float_sigma_m, 0.4, 1e-12);
  EXPECT_NEAR(solution(BenchFaultKind::kGnssRtkFloat, 2.0).float_sigma_m, 0.4 / 2.71828, 1e-5);
  EXPECT_GT(solution(BenchFaultKind::kGnssRtkFloat, 99.0).float_sigma_m, 0.0);
}

TEST(SensorFaults, RefuseValuesThatTheModelCannotTake) {
  for (const double wrong : {0.0, -1.0}) {
    EXPECT_FALSE(is_sensor_value(BenchFaultKind::kGnssVarianceSpike, wrong));
    EXPECT_FALSE(is_sensor_value(BenchFaultKind::kGnssRtkFloat, wrong));
    EXPECT_FALSE(is_sensor_value(BenchFaultKind::kGnssGaps, wrong));
    EXPECT_FALSE(is_sensor_value(BenchFaultKind::kGnssLatency, wrong));
  }
  EXPECT_FALSE(is_sensor_value(BenchFaultKind::kGnssGaps, 1.1));
  EXPECT_FALSE(is_sensor_value(BenchFaultKind::kGnssLatency, 2.1));
  EXPECT_TRUE(is_sensor_value(BenchFaultKind::kImuBias, -0.1));
}

}  // namespace
}  // namespace pitwall::faults
