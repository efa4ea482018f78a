// Tracker of the other cars: from the detections of LiDAR, camera and radar to their states.
//
//     frame -> checks -> our pose at its time -> association -> filter -> birth and death
//
//   in     detection frames in the order of their arrival, EgoState at `now`, the track map
//   out    cars at `now`; between frames they are predicted, with growing covariance
//   rate   100 Hz, whether or not frames arrive
//   frames Map
//   invariants
//          method "road": within window_s the order of arrival changes no state (rewind)
//          a car is published after two detections in successive frames, until coast_s after its
//          newest one
//          a refused frame or detection changes only its count
//   errors without an ego state no frame can be placed: all are refused
//   cost   O(frames to filter again * tracks * detections): 30 us for a frame with 6 cars, 150 us
//          for one that is 1 s late; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/tracking/filter/track.hpp"
#include "vehicle/autonomy/tracking/names.hpp"
#include "vehicle/autonomy/tracking/own_trail.hpp"
#include "vehicle/autonomy/tracking/params.hpp"
#include "vehicle/autonomy/tracking/timeline.hpp"
#include "vehicle/world/detection.hpp"
#include "vehicle/world/ego_state.hpp"
#include "vehicle/world/opponent.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::tracking {

struct Inputs {
  std::span<const world::DetectionFrame> frames;  // in order of arrival, since the last step
  const world::EgoState& ego;                     // at `now`
  const world::TrackMap* track = nullptr;         // null: a plane without a map
  Instant now{};
};

// Since the start. Of frames, then of detections.
struct Counters {
  std::uint64_t frames = 0, detections = 0;  // used
  std::uint64_t frames_in_future = 0, frames_too_old = 0;
  std::uint64_t frames_repeated = 0;  // same sensor and time as a frame before
  std::uint64_t frames_too_many = 0;  // beyond the room of the window
  std::uint64_t frames_unplaced = 0;  // our own pose at their time is not known
  std::uint64_t frames_unknown = 0;   // of no known source, or one that the method does not use
  std::uint64_t not_finite = 0;       // or without a value that its source must have
  std::uint64_t low_confidence = 0, in_own_car = 0, off_track = 0;
  std::uint64_t too_far = 0;   // beyond reach_m
  std::uint64_t too_many = 0;  // no room for another track
};

struct State {
  Tracks tracks;      // after all frames
  Timeline timeline;  // method "road"
  OwnTrail own;
  Names names;
  Counters counters;
};
static_assert(std::is_trivially_copyable_v<State> && sizeof(State) < 300'000);

struct Output {
  world::Opponents opponents;
  Counters counters;
  bool published = false;  // a frame was used in this step
};

Output step(const Params& params, State& state, const Inputs& in);

// Where a car will be along its line after a while, if it goes on as it does: acceleration fades,
// and with a map the direction follows the road. The covariance grows as that of a coasting track.
// Returns nullopt for a car without finite states, or a time that is negative or beyond coast_s.
std::optional<world::Opponent> predict(const Params& params, const world::Opponent& car,
                                       const world::TrackMap* track, Duration ahead);

}  // namespace pitwall::tracking
