// Birth and death of tracks, the same for both methods.
//   invariants
//          a track is confirmed by its second detection; on trial it ends with the first frame of
//          the sensor that began it without a detection of it. A confirmed track ends when its
//          newest detection is too old, or when another one takes its place
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "vehicle/autonomy/tracking/filter/frame.hpp"
#include "vehicle/autonomy/tracking/filter/track.hpp"

namespace pitwall::tracking {

// A detection of the frame belongs to the track: its first one, or another one.
void note_first(const Frame& frame, std::size_t index, Track& track);
void note_detection(const Frame& frame, std::size_t index, Track& track);

// Whether a confirmed track was not seen for so long that a detection near it may be another car's,
// or none: what is seen there begins a track of its own.
bool is_lost(const Frame& frame, const Track& track);

// Adds a track on trial; counts it in `crowded` where there is no room.
void add_track(const Track& track, Tracks& tracks);

// Before the detections of a frame: removes tracks that nothing was seen of for longer than
// `coast`, those of the longest time first, until each detection finds room for a track.
void make_room(const Frame& frame, Duration coast, Tracks& tracks);

// Before the detections of a frame: removes the tracks that nothing was seen of for too long.
void end_unseen(const Frame& frame, Duration coast, Tracks& tracks);

// After the detections of a frame: removes tracks, also those on trial; the others keep
// their order.
void end_tracks(const Frame& frame, Duration coast, Tracks& tracks);
void end_track(std::size_t index, Tracks& tracks);

}  // namespace pitwall::tracking
