// Speeds that a car can follow: a reference that moves to its target with limited acceleration and
// jerk, and that reference played forward over a path.
//   invariants
//          acceleration wanted = +-sqrt(2 j |target - v|) within its limits, reached at rate j: it
//          lands on the target with acceleration zero and does not overshoot. A stop brakes with
//          what the corner leaves of the friction ellipse at every place ahead that it reaches
//          before its jerk could let go of the brake
//   cost   O(kProfileSteps), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/planning/friction.hpp"
#include "vehicle/autonomy/planning/line.hpp"
#include "vehicle/steering/angle_limits.hpp"
#include "vehicle/world/trajectory.hpp"

namespace pitwall::planning {

struct SpeedReference {
  double speed_mps = 0.0, accel_mps2 = 0.0;
};

struct SpeedLimits {
  double target_mps = 0.0;
  double accel_max_mps2 = 0.0, decel_max_mps2 = 0.0;  // both >= 0
  double jerk_max_mps3 = 1.0;
};

SpeedReference advance(const SpeedReference& reference, const SpeedLimits& limits, double dt_s);

inline constexpr double kProfileStep_s = 0.05;
inline constexpr std::size_t kProfileSteps = 800;  // 40 s: a stop from top speed takes half of it

// Speed and acceleration at equal distances from where the car is.
struct SpeedProfile {
  double spacing_m = kUnset;
  std::array<SpeedReference, world::kTrajectoryPoints> at{};
  double stop_distance_m = kUnset;  // where it first stands; unset if it does not
};

struct DriveLimits {
  double target_mps = kUnset;
  double warmth = 1.0;  // of the tyres
  double accel_max_mps2 = kUnset, decel_max_mps2 = kUnset, jerk_max_mps3 = kUnset;
  const steering::AngleBudget* steering = nullptr;  // none: no limit
};

// What friction and the steering allow at a point of the line.
double limit_mps(const LinePoint& point, const DriveLimits& limits);

// Towards the target, below the line's own limits, which are seen coming.
SpeedReference advance_drive(const Line& line, double s_m, const SpeedReference& from,
                             const DriveLimits& limits, double dt_s);
SpeedProfile drive_profile(const Line& line, double s_m, const SpeedReference& from,
                           const DriveLimits& limits, double spacing_m);

// The path that a stop takes from where the car is, at equal distances; the last one holds beyond.
inline constexpr std::size_t kRoadPoints = 320;
inline constexpr double kRoadStep_m = 4.0;

struct RoadSample {
  double curvature_per_m = kUnset, bank_rad = kUnset;
  double cos_bank = std::cos(bank_rad), sin_bank = std::sin(bank_rad);
};
struct RoadAhead {
  std::array<RoadSample, kRoadPoints> at{};

  const RoadSample& sample(double distance_m) const;  // the nearest one
};

struct StopLimits {
  FrictionParams friction;  // of the tyres as they are
  double grip_share = kUnset, decel_max_mps2 = kUnset, jerk_max_mps3 = kUnset;
};

// The deceleration of a car that neither drives nor brakes: air and rolling.
double coasting_mps2(const FrictionParams& car, double speed_mps);
// The largest deceleration of a stop at a distance along its road; never less than coasting.
double stop_decel_mps2(const RoadAhead& road, double distance_m, double speed_mps,
                       const StopLimits& limits);

// To standstill with what the corner leaves of the friction ellipse.
SpeedReference advance_stop(const RoadAhead& road, const SpeedReference& from,
                            const StopLimits& limits, double dt_s);
// The spacing is chosen so that the points reach `beyond_m` past the place where it stands.
SpeedProfile stop_profile(const RoadAhead& road, const SpeedReference& from,
                          const StopLimits& limits, double beyond_m);

}  // namespace pitwall::planning
