// Drift detector of each unit's positions against the motion by the car's own speed: of two units
// that come apart slowly, the one that drifts is to blame, although the filter follows both.
//   in     per tick the velocity in Map; per position its residual-free place in Map
//   out    distance from where the unit has been over the last drift_memory_s, m
//   invariants
//          what strays is not learned while it is refused
//   cost   O(1)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/localization/checks/check_params.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::localization {

struct DriftWatch {
  struct Unit {
    bool known = false;
    Instant at{};
    double x_m = 0.0, y_m = 0.0;  // the place less the way gone, low-passed
  };
  bool moving = false;
  Instant at{};
  double gone_x_m = 0.0, gone_y_m = 0.0;  // the way gone until `at`
  double vx_mps = 0.0, vy_mps = 0.0;      // Map
  std::array<Unit, world::kGnssUnits> units{};
};
static_assert(std::is_trivially_copyable_v<DriftWatch>);

// The car goes on with this velocity until now.
void go(DriftWatch& watch, double vx_mps, double vy_mps, Instant now);
void forget(DriftWatch& watch);  // the way is not known any more

// Of a place of the centre of gravity by one unit; unset where nothing is known of it.
double stray_m(const DriftWatch& watch, std::size_t unit, double x_m, double y_m, Instant at);
void learn(const CheckParams& params, DriftWatch& watch, std::size_t unit, double x_m, double y_m,
           Instant at);

}  // namespace pitwall::localization
