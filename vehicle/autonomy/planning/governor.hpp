// Speed governor: every speed that race control, the operator or the planner demands passes it,
// and becomes one that the car can drive on the road ahead.
//   in     the demanded speed and its pace; the line ahead and the pace towards its corners; what
//          the car can do on its tyres as they are
//   out    limits for the speed reference (speed_reference.hpp) at a distance along the line
//   invariants
//          the jerk is at most that of the pace, whatever is demanded, and towards a corner that of
//          the corners' pace
//          the acceleration is at most that of the pace, of the engine in its gear and of the rear
//          axle beside the corner
//          a demand slows the car by at most the deceleration of its pace. A corner ahead is met
//          with that of the corners' pace, which no flag changes, and where it comes as a surprise
//          (the tyres are colder than was believed) with all that the brakes have beside the corner
//          a car beyond its envelope coasts: nothing is left for the brake
//   cost   look_ahead() some 0.05 ms, drive_limits() below 1 us; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "vehicle/autonomy/planning/line.hpp"
#include "vehicle/autonomy/planning/offset.hpp"
#include "vehicle/autonomy/planning/speed_reference.hpp"
#include "vehicle/envelope/friction.hpp"
#include "vehicle/steering/angle_limits.hpp"
#include "vehicle/steering/road_load.hpp"
#include "vehicle/world/tyre_grip.hpp"

namespace pitwall::planning {

struct Pace {
  double accel_max_mps2 = kUnset, decel_max_mps2 = kUnset, jerk_max_mps3 = kUnset;
};

struct DriveLimits {
  double target_mps = kUnset;  // demanded
  Pace pace;
  Pace corners;
  double brake_most_mps2 = HUGE_VAL;  // also for a corner; of a car that coasts what drag takes
  envelope::FrictionParams friction;  // on the tyres as they are
  double grip_share = kUnset;         // usable
  world::TyrePlace tyres;             // the same, for the speeds of the line
  const steering::AngleBudget* steering = nullptr;  // null: no limit
};

// Speed that friction and steering allow at a point of the line.
double limit_mps(const LinePoint& point, const DriveLimits& limits);

// Of the road ahead, at equal distances from the car.
inline constexpr std::size_t kAheadPoints = 320;
inline constexpr double kAheadStep_m = 4.0;

struct AheadPoint {
  steering::RoadLoad road;    // its speed is not used
  double speed_mps = kUnset;  // from which every corner ahead is met
  double accel_mps2 = 0.0;    // of these speeds, as far as the next point
  double brake_mps2 = 0.0;    // what the ellipse leaves at this speed, with air drag
};
struct SpeedsAhead {
  std::array<AheadPoint, kAheadPoints> at;
};

// `merge`: the change of offset from the line that the car drives.
SpeedsAhead look_ahead(const Line& line, double s_m, const DriveLimits& limits,
                       const OffsetChange& merge = {});

// For a reference that is this far ahead of the car's place.
SpeedLimits drive_limits(const SpeedsAhead& ahead, double gone_m, const SpeedReference& now,
                         const DriveLimits& limits);

}  // namespace pitwall::planning
