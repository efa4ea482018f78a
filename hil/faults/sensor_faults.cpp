// SPDX-License-Identifier: Apache-2.0
#include "hil/faults/sensor_faults.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::faults {
namespace {

using enum BenchFaultKind;

// A float solution that has converged is as good as this; the integers are fixed at the end.
constexpr double kFloatFrom_m = 0.4, kFloatTo_m = 0.03;

// Of the solution; true if that is what the kind is about.
bool spoil_solution(BenchFaultKind kind, double value, double lasted_s, sensors::SolutionFault& f) {
  switch (kind) {
    case kGnssNoSolution:
      return f.fix = sensors::Fix::kNone, true;
    case kGnssSingle:
      return f.fix = sensors::Fix::kSingle, true;
    case kGnssRtkLost:
      return f.fix = sensors::Fix::kRtkFloat, true;
    case kGnssRtkFloat:
      f.fix = sensors::Fix::kRtkFloat;
      f.float_sigma_m = std::max(kFloatTo_m, kFloatFrom_m * std::exp(-lasted_s / value));
      return true;
    case kGnssCorrectionsLost:
      f.added_sigma_m += value * lasted_s;
      f.added_age_s += lasted_s;
      return true;
    case kGnssVarianceSpike:
      return f.sigma_scale *= value, true;
    case kGnssNoise:
      return f.noise_scale *= value, true;
    case kGnssVelocityWrong:
      return f.ahead_mps += value, true;
    case kGnssVelocityWrongLeft:
      return f.left_mps += value, true;
    case kGnssHeadingFlip:
      return f.heading_rad += std::numbers::pi, true;
    case kGnssHeadingOffset:
      return f.heading_rad += value, true;
    default:
      return false;
  }
}

bool move_position(BenchFaultKind kind, double value, double lasted_s, sensors::SolutionFault& f) {
  switch (kind) {
    case kGnssPositionJump:
      return f.east_m += value, true;
    case kGnssPositionJumpNorth:
      return f.north_m += value, true;
    case kGnssPositionJumpUp:
      return f.up_m += value, true;
    case kGnssPositionJumpAhead:
      return f.ahead_m += value, true;
    case kGnssPositionJumpLeft:
      return f.left_m += value, true;
    case kGnssPositionDrift:
      return f.left_m += value * lasted_s, true;
    case kGnssPositionDriftAhead:
      return f.ahead_m += value * lasted_s, true;
    default:
      return false;
  }
}

bool spoil_stream(BenchFaultKind kind, double value, sensors::StreamFault& f) {
  switch (kind) {
    case kGnssUnitOutage:
      return f.outage = true;
    case kGnssHeadingOutage:
      return f.heading_outage = true;
    case kGnssPositionFrozen:
      return f.position_frozen = true;
    case kGnssStampFrozen:
      return f.stamp_frozen = true;
    case kGnssStampFuture:
      return f.stamp_shift = f.stamp_shift + from_seconds(value), true;
    case kGnssStampBack:
      return f.stamp_shift = f.stamp_shift + from_seconds(-value), true;
    case kGnssLatency:
      return f.added_latency = f.added_latency + from_seconds(value), true;
    case kGnssGaps:
      return f.gaps = std::max(f.gaps, value), true;
    case kGnssNotANumber:
      return f.not_a_number = true;
    case kGnssNegativeSigma:
      return f.negative_sigma = true;
    default:
      return false;
  }
}

bool spoil_imu(BenchFaultKind kind, double value, sensors::ImuFault& f) {
  switch (kind) {
    case kImuOutage:
      return f.outage = true;
    case kImuFrozen:
      return f.frozen = true;
    case kImuNotANumber:
      return f.not_a_number = true;
    case kImuBias:
      return f.yaw_rate_bias_rad_per_s += value, true;
    case kImuAccelBias:
      return f.ahead_bias_mps2 += value, true;
    case kImuAccelBiasLeft:
      return f.left_bias_mps2 += value, true;
    case kImuGyroScale:
      return f.gyro_scale *= value, true;
    default:
      return false;
  }
}

bool spoil_wheel(BenchFaultKind kind, double value, double lasted_s, sensors::WheelFault& f) {
  using enum sensors::WheelTrouble;
  switch (kind) {
    case kWheelLoss:
      return f = {.trouble = kLost}, true;
    case kWheelLock:
      return f = {.trouble = kLocked, .since_s = lasted_s}, true;
    case kWheelSpin:
      return f = {.trouble = kSpinning, .factor = value}, true;
    default:
      return false;
  }
}

bool spoil_unit(BenchFaultKind kind, double value, double lasted_s, sensors::UnitFault& f) {
  return spoil_solution(kind, value, lasted_s, f.solution) ||
         move_position(kind, value, lasted_s, f.solution) || spoil_stream(kind, value, f.stream) ||
         spoil_imu(kind, value, f.imu);
}

bool is_of_a_wheel(BenchFaultKind kind) {
  sensors::WheelFault probe;
  return spoil_wheel(kind, 1.0, 0.0, probe);
}

}  // namespace

bool is_sensor_fault(BenchFaultKind kind) {
  sensors::UnitFault probe;
  return is_of_a_wheel(kind) || spoil_unit(kind, 1.0, 0.0, probe);
}

std::size_t parts_of(BenchFaultKind kind) {
  if (is_of_a_wheel(kind)) return world::kCorners;
  if (kind == kBrakeCircuitLost) return faults::kBrakeCircuits;
  return is_sensor_fault(kind) ? world::kGnssUnits : 1;
}

bool is_sensor_value(BenchFaultKind kind, double value) {
  switch (kind) {
    case kGnssVarianceSpike:
    case kGnssNoise:
    case kGnssRtkFloat:
    case kGnssStampFuture:
    case kGnssStampBack:
      return value > 0.0;
    case kGnssCorrectionsLost:
    case kWheelSpin:
      return value >= 0.0;
    case kGnssLatency:
      return value > 0.0 && value <= sensors::kAddedLatencyMax.seconds();
    case kGnssGaps:
      return value > 0.0 && value <= 1.0;
    default:
      return true;
  }
}

void apply_sensor_fault(const BenchFault& fault, Instant now, sensors::State& receivers,
                        sensors::WheelState& wheels) {
  const double lasted_s = (now - fault.start).seconds();
  if (is_of_a_wheel(fault.kind)) {
    CHECK(fault.unit < wheels.fault.size());
    spoil_wheel(fault.kind, fault.value, lasted_s, wheels.fault[fault.unit]);
    return;
  }
  CHECK(fault.unit < receivers.fault.size());
  // plan_faults() refuses what nobody carries out.
  CHECK(spoil_unit(fault.kind, fault.value, lasted_s, receivers.fault[fault.unit]));
}

}  // namespace pitwall::faults
