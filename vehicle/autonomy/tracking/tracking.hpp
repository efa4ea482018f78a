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
//          newest one; it is known for remembered_s, so that no other gets its place
//          a refused frame or detection changes only its count
//   errors without an ego state no frame can be placed: all are refused
//   cost   O(frames to filter again * tracks * detections): 30 us for a frame with 6 cars, 150 us
//          for one that is 1 s late; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/tracking/admission.hpp"
#include "vehicle/autonomy/tracking/camera_watch.hpp"
#include "vehicle/autonomy/tracking/filter/track.hpp"
#include "vehicle/autonomy/tracking/names.hpp"
#include "vehicle/autonomy/tracking/own_trail.hpp"
#include "vehicle/autonomy/tracking/params.hpp"
#include "vehicle/autonomy/tracking/prediction.hpp"
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
  world::SensorUse use{};
  Instant now{};
};

struct State {
  Tracks tracks;      // after all frames
  Timeline timeline;  // method "road"
  OwnTrail own;
  Names names;
  CameraWatch cameras;
  Counters counters;
};
static_assert(std::is_trivially_copyable_v<State> && sizeof(State) < 650'000);

struct Output {
  world::Opponents opponents;
  Counters counters;
  bool published = false;  // a frame was used in this step
};

Output step(const Params& params, State& state, const Inputs& in);

}  // namespace pitwall::tracking
