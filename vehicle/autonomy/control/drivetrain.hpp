// Throttle and brake pressure for an acceleration of the car: inverse of its longitudinal dynamics.
//   in     acceleration along the path, speed, gear, climb of the road
//   out    throttle 0..1 and brake pressure; one of them is zero
//   invariants
//          acceleration = drive(throttle, gear) - brake / brake_kpa_per_mps2 - drag_per_m v^2
//                         - rolling - g sin(climb)
//          between coasting and coasting less the dead zone both are zero; who brakes goes on until
//          coasting is enough, so that throttle and brake do not alternate
//          without an engine in the car file the drive is linear in the throttle, up to the power
//   errors none; a gear of 0 (neutral, a shift) has no drive and no drag of the engine
//   cost   O(rows of the engine), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "vehicle/envelope/friction.hpp"

namespace pitwall::control {

struct DrivetrainParams {
  envelope::FrictionParams car;  // drag, engine, mass
  double brake_kpa_per_mps2 = kUnset;
  double rolling_mps2 = kUnset;
  double dead_zone_mps2 = kUnset;
};

struct Motion {
  double speed_mps = 0.0;
  std::uint8_t gear = 0;
  double climb_rad = 0.0;  // of the road, along the path
};

struct Pedals {
  double throttle_fraction = 0.0, brake_kpa = 0.0;
};

// Resistance of air, tyres and grade: what a constant speed needs from the engine.
double resistance_mps2(const DrivetrainParams& params, const Motion& motion);
// Acceleration with neither throttle nor brake, negative on level road.
double coasting_mps2(const DrivetrainParams& params, const Motion& motion);
double full_throttle_mps2(const DrivetrainParams& params, const Motion& motion);

Pedals pedals_for(const DrivetrainParams& params, const Motion& motion, double accel_mps2,
                  bool brakes_already);

}  // namespace pitwall::control
