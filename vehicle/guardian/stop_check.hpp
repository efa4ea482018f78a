// Check of a stop trajectory for the guardian, which cannot plan a new one: the car process judges
// it before it publishes it; one that fails is not published and the one before stays.
//   in     the trajectory, where the car is, the track
//   out    kGood, or the first reason against it
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
  double ahead_max_m = 10.0;       // the car beyond or before the first point; [1, 50]
  double beside_max_m = 3.0;       // beside the first point; [0.5, 10]
  double speed_off_max_mps = 5.0;  // of the first point from the car's; [1, 20]
  double turned_max_rad = 0.3;     // of the first point's direction from the car's; [0.05, 1]
  double wall_least_m = 1.2;       // from the centre of the car to the wall; [0.5, 5]
  double standing_mps = 0.1;       // of the last point; [0, 1]
  double accel_max_mps2 = 12.0;    // planned, either way; [5, 30]
  double step_max_m = 12.0;        // between points; [2, 50]
};

enum class StopVerdict : std::uint8_t {
  kGood,
  kEmpty,
  kNotFinite,
  kNotMonotone,  // stations do not rise, or not as the places do
  kNotHere,      // does not begin where and as fast as the car is
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
