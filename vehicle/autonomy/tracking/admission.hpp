// Checks of the detection frames before the filter: time, place, form.
//   in     a frame as it arrived, our own poses, the track map
//   out    the frame with the detections that are used; a count for everything else, by its reason
//   invariants
//          every frame and every detection adds to exactly one count
//   cost   O(detections), 0.3 us each with a map; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/tracking/filter/frame.hpp"
#include "vehicle/autonomy/tracking/own_trail.hpp"
#include "vehicle/autonomy/tracking/params.hpp"
#include "vehicle/world/detection.hpp"
#include "vehicle/world/operator_inputs.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::tracking {

// Since the start. Of frames, then of detections.
struct Counters {
  std::uint64_t frames = 0, detections = 0;  // used
  std::uint64_t frames_in_future = 0, frames_too_old = 0;
  std::uint64_t frames_repeated = 0;  // same sensor and time as a frame before
  std::uint64_t frames_too_many = 0;  // beyond the room of the window
  std::uint64_t frames_unplaced = 0;  // our own pose at their time is not known
  std::uint64_t frames_unknown = 0;   // of no known source, or one that the method does not use
  std::uint64_t frames_excluded = 0;  // of a sensor that the operator has excluded
  std::uint64_t not_finite = 0;       // or without a value that its source must have
  std::uint64_t low_confidence = 0, in_own_car = 0, off_track = 0;
  std::uint64_t too_far = 0;   // beyond reach_m
  std::uint64_t too_many = 0;  // no room for another track
};

struct AdmittedFrame {
  FrameKey key;
  OwnMotion own;
  FixedVector<Measurement, kMeasurementsMax> measurements;
};

struct Surroundings {
  const OwnTrail& own;
  const world::TrackMap* track;  // null: a plane without a map
  world::SensorUse use;
  Instant now;
};

// Returns nullopt for a frame that is not used. A used frame is counted with its detections; where
// the filter has no room for it, it takes them back.
std::optional<AdmittedFrame> admit(const Params& params, const Surroundings& around,
                                   const world::DetectionFrame& frame, Counters& counters);

}  // namespace pitwall::tracking
