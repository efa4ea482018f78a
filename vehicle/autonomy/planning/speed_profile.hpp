// Speed profiles that a car can follow: the reference of speed_reference.hpp, simulated forward
// along the line below the limits of the governor, or along the path of a stop.
//   invariants
//          at every point the acceleration is that of the reference there
//          a stop brakes with what the corner leaves of the friction ellipse at every point ahead
//          that it reaches before the jerk limit could release the brake
//   cost   O(kProfileSteps), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/planning/governor.hpp"
#include "vehicle/autonomy/planning/speed_reference.hpp"
#include "vehicle/envelope/friction.hpp"
#include "vehicle/world/trajectory.hpp"

namespace pitwall::planning {

inline constexpr double kProfileStep_s = 0.05;
inline constexpr std::size_t kProfileSteps = 800;  // 40 s: twice a stop from top speed

// Speed and acceleration at equal distances from the car.
struct SpeedProfile {
  double spacing_m = kUnset;
  std::array<SpeedReference, world::kTrajectoryPoints> at{};
  double stop_distance_m = kUnset;  // to standstill; unset if it does not stop
};

// Next reference towards the demanded speed, as far as the governor lets it.
SpeedReference advance_drive(const SpeedsAhead& ahead, const SpeedReference& from,
                             const DriveLimits& limits, double dt_s);
SpeedProfile drive_profile(const SpeedsAhead& ahead, const SpeedReference& from,
                           const DriveLimits& limits, double spacing_m);

// Path of a stop from the car, at equal distances; beyond its end the last sample holds.
inline constexpr std::size_t kRoadPoints = 320;
inline constexpr double kRoadStep_m = 4.0;

struct RoadSample {
  double curvature_per_m = kUnset, bank_rad = kUnset;
  double cos_bank = std::cos(bank_rad), sin_bank = std::sin(bank_rad);
};
struct RoadAhead {
  std::array<RoadSample, kRoadPoints> at{};

  const RoadSample& sample(double distance_m) const;  // nearest sample
};

struct StopLimits {
  envelope::FrictionParams friction;  // for the present tyre temperature
  double grip_share = kUnset, decel_max_mps2 = kUnset, jerk_max_mps3 = kUnset;
};

// Deceleration with neither throttle nor brake: air drag and rolling resistance.
double coasting_mps2(const envelope::FrictionParams& car, double speed_mps);
// Largest deceleration of a stop at a distance along its path; at least that of coasting.
double stop_decel_mps2(const RoadAhead& road, double distance_m, double speed_mps,
                       const StopLimits& limits);

// Next reference of a stop, with what the corner leaves of the friction ellipse.
SpeedReference advance_stop(const RoadAhead& road, const SpeedReference& from,
                            const StopLimits& limits, double dt_s);
// Profile of a stop. Its spacing is chosen so that the points reach `beyond_m` past the standstill.
SpeedProfile stop_profile(const RoadAhead& road, const SpeedReference& from,
                          const StopLimits& limits, double beyond_m);

}  // namespace pitwall::planning
