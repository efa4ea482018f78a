// Filter of the method "paper": the published tracker. AB3DMOT's linear Kalman filter with constant
// velocity in Map, greedy matching on the Mahalanobis distance; camera and LiDAR as positions.
//   in     tracks, a frame in the order of arrival
//   out    tracks after the frame; a frame older than the tracks is used without going back
//   source Weng et al. (2020), AB3DMOT; the published stack for matching, birth and death
//   cost   O(tracks * detections); no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/tracking/filter/filter_params.hpp"
#include "vehicle/autonomy/tracking/filter/frame.hpp"
#include "vehicle/autonomy/tracking/filter/track.hpp"
#include "vehicle/world/opponent.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::tracking {

// Indices of the states.
inline constexpr std::size_t kX = 0, kY = 1, kYaw = 2, kLength = 3, kWidth = 4, kVx = 5, kVy = 6;

void filter_paper(const PaperParams& params, Duration coast, const Frame& frame, Tracks& tracks);

// Moves the track by a time, with the noise of that time.
void predict_paper(const PaperParams& params, double dt_s, Track& track);

world::Opponent paper_opponent(const world::TrackMap* map, const Track& track);

}  // namespace pitwall::tracking
