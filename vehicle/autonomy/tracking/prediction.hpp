// Prediction of another car: it goes on as it does, acceleration fades, and with a map its
// direction follows the road.
//   in     a car as published
//   out    the car after a while, with its covariance
//   frames Map
//   errors nullopt for a car without finite states, or a time that is negative or beyond coast_s
//   cost   0.3 us for every 0.1 s; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/tracking/params.hpp"
#include "vehicle/world/opponent.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::tracking {

// The covariances of acceleration and turn rate are not published: those of a car of which nothing
// is known take their place, so the result is never too sure.
std::optional<world::Opponent> predict(const Params& params, const world::Opponent& car,
                                       const world::TrackMap* track, Duration ahead);

}  // namespace pitwall::tracking
