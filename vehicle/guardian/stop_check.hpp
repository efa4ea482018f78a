// Check of a stop trajectory for the guardian, which cannot plan a new one. The car process checks
// each trajectory before it publishes it; one that fails is not published, and the previous one
// stays.
//   in     the trajectory, the ego state, the track
//   out    kGood, or the first reason for the refusal
//   units  m, m/s
//   cost   one projection onto the track per kBetweenPoints points: below 100 us, at the planning
//          rate
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "vehicle/world/ego_state.hpp"
#include "vehicle/world/track_map.hpp"
#include "vehicle/world/trajectory.hpp"

namespace pitwall::guardian {

struct StopCheckParams {
  double ahead_max_m = 10.0;       // longitudinal distance to the first point; [1, 50]
  double beside_max_m = 3.0;       // lateral distance to the first point; [0.5, 10]
  double speed_off_max_mps = 5.0;  // speed difference to the first point; [1, 20]
  double turned_max_rad = 0.3;     // yaw difference to the first point; [0.05, 1]
  double wall_least_m = 1.2;       // minimum distance to the wall; [0.5, 5]
  double standing_mps = 0.1;       // largest speed of the last point; [0, 1]
  double accel_max_mps2 = 12.0;    // magnitude of the planned acceleration; [5, 30]
  double step_max_m = 12.0;        // distance between points; [2, 50]
};

enum class StopVerdict : std::uint8_t {
  kGood,
  kEmpty,
  kNotFinite,
  kNotMonotone,  // stations do not rise, or differ from the distances
  kNotHere,      // does not begin at the pose and speed of the car
  kNoStop,       // does not end at standstill
  kTooHard,
  kOffTrack
};
inline constexpr std::size_t kStopVerdicts = 8;

constexpr const char* text_of(StopVerdict verdict) {
  constexpr std::array<const char*, kStopVerdicts> kTexts{
      "good",           "empty",         "not finite", "stations do not rise",
      "not at the car", "does not stop", "too hard",   "leaves the track"};
  return kTexts[static_cast<std::size_t>(verdict)];
}

StopVerdict check_stop(const StopCheckParams& params, const world::Trajectory& stop,
                       const world::EgoState& ego, const world::TrackMap& track);

}  // namespace pitwall::guardian
