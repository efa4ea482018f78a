// Drift detector of each unit's positions relative to dead reckoning with the car's speed. If two
// units diverge slowly, it shows which of them drifts, although the filter follows both.
//   in     per tick the velocity in Map; per position the position of the centre of gravity in Map
//   out    distance from the unit's mean offset over the last drift_memory_s, m
//   invariants
//          a position that is refused does not change the mean offset
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
    double x_m = 0.0, y_m = 0.0;  // position minus reckoned path, low-passed
  };
  bool moving = false;
  Instant at{};
  double gone_x_m = 0.0, gone_y_m = 0.0;  // path reckoned until `at`
  double vx_mps = 0.0, vy_mps = 0.0;      // Map
  std::array<Unit, world::kGnssUnits> units{};
};
static_assert(std::is_trivially_copyable_v<DriftWatch>);

// Advances the reckoned path to `now` with this velocity.
void go(DriftWatch& watch, double vx_mps, double vy_mps, Instant now);
void forget(DriftWatch& watch);  // when the reckoned path is no longer valid

// Distance of a position (centre of gravity) of one unit from its mean offset; unset if the unit is
// unknown.
double stray_m(const DriftWatch& watch, std::size_t unit, double x_m, double y_m, Instant at);
void learn(const CheckParams& params, DriftWatch& watch, std::size_t unit, double x_m, double y_m,
           Instant at);

}  // namespace pitwall::localization
