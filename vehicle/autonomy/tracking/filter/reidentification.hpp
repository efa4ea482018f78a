// Re-identification: which of the cars that were lost a car is that came into sight. It begins as a
// track of its own, whose second detection decides: place, speed and what else is known of it
// together say more than its place alone, as a car that braked is behind and slow.
//
//     lost tracks, predicted   one assignment   tracks that are confirmed by the frame
//                              of all to all
//
//   in     tracks at the time of the frame
//   out    tracks, of which one that came back has the number and the size of the car that it is,
//          and states from both; the lost track ends
//   invariants
//          a track is decided once, and is never a car that was still seen after it had begun
//   cost   without an undecided track nothing; 3 us for each pair; no allocation
//   source Bar-Shalom, Li and Kirubarajan (2001), section 8.3: fusion of two tracks
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/tracking/filter/filter_params.hpp"
#include "vehicle/autonomy/tracking/filter/frame.hpp"
#include "vehicle/autonomy/tracking/filter/track.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::tracking {

// A car that was not seen for longer than `coast` keeps what is known of it, but not its number.
void identify(const RoadParams& params, const world::TrackMap* map, Duration coast,
              const Frame& frame, Tracks& tracks);

}  // namespace pitwall::tracking
