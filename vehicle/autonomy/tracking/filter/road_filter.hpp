// Filter of the method "road": one frame of any sensor in time order into the tracks.
//
//     coast to the frame -> gates -> assignment -> updates -> birth and death
//
// What is seen where only a lost car can be begins a track; which car it is shows soon
// (reidentification.hpp). One that was gone for longer than `coast` is still known: what comes to
// its place is a new car, and not another one that is out of sight.
//
//   in     tracks at the time of an older frame, the frame
//   out    tracks at the time of the frame; their modes are not joined
//   source Chiu et al. (2020): greedy by Mahalanobis distance; here with the logarithm of the
//          determinant, as the likelihood has it
//   cost   O(tracks * detections); no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/tracking/filter/filter_params.hpp"
#include "vehicle/autonomy/tracking/filter/frame.hpp"
#include "vehicle/autonomy/tracking/filter/track.hpp"
#include "vehicle/world/opponent.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::tracking {

void filter_road(const RoadParams& params, const world::TrackMap* map, Duration coast,
                 const Frame& frame, Tracks& tracks);

// Track that a detection begins: at its place, in the direction of the road (of our car on a
// plane) or of its box, at our speed. Returns nullopt for a bearing without a depth.
std::optional<Track> first_track(const RoadParams& params, const world::TrackMap* map,
                                 const Frame& frame, std::size_t index);

// States and covariance at the time of the track as published; without number.
world::Opponent road_opponent(const world::TrackMap* map, const Track& track);

}  // namespace pitwall::tracking
