// Speed profile of a closed lap: the fastest that the envelope of the car allows, forward and
// backward along a line.
//   in     points of the road, each with the way to the next and a speed that is not passed
//   out    speed, acceleration to the next point, gear and time since the first point, of each
//          point; the time of the lap
//   invariants
//          v(i+1)^2 <= v(i)^2 + 2 h(i) a(v(i), i)        acceleration of the envelope
//          v(i)^2 <= v(i+1)^2 + 2 h(i) b(v(i+1), i+1)    deceleration of the envelope
//          v(i) <= corner speed, cap; the lap ends with the speed that it begins with, and no
//          profile within these limits is faster anywhere
//          from point to point the acceleration is constant:  t = 2 h(i) / (v(i) + v(i+1))
//          an upward shift cuts the drive for its time: the car coasts. Gears are chosen with the
//          hysteresis of the car's gear selection; downward shifts, while braking, cost nothing
//   errors the first point that no speed carries
//   cost   O(points), some 0.3 us each; solve() does not allocate once it has seen as many points
//   source forward-backward pass: Heilmeier et al., Minimum curvature trajectory planning and
//          control for an autonomous race car, Vehicle System Dynamics 58 (2020), section 4.3
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "vehicle/envelope/envelope_table.hpp"
#include "vehicle/world/raceline.hpp"

namespace pitwall::envelope {

inline constexpr double kNoCap_mps = std::numeric_limits<double>::infinity();

struct RoadStep {
  double curvature_per_m = kUnset, bank_rad = kUnset;
  double cap_mps = kNoCap_mps;
  double step_m = kUnset;  // to the next point
};

struct LapOutcome {
  double lap_s = kUnset;
  std::optional<std::size_t> stuck;  // point that no speed carries
};

class LapProfile {
 public:
  explicit LapProfile(const EnvelopeTable& table) : table_(&table) {}

  // `out` has a place for each point of the road.
  LapOutcome solve(std::span<const RoadStep> road, std::span<world::LapPoint> out);

 private:
  std::size_t limit(std::span<const RoadStep> road);  // index of the slowest point
  void brake(std::span<const RoadStep> road, std::size_t from);
  void drive(std::span<const RoadStep> road, std::size_t from, std::span<world::LapPoint> out);

  const EnvelopeTable* table_;
  std::vector<RoadPlace> places_;
  std::vector<double> limit_mps_;  // of the corners and the brakes
  std::vector<double> speed_mps_;
};

}  // namespace pitwall::envelope
