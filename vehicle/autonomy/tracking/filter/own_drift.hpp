// Drift of our own pose between two frames: a track is in Map, but sensors measure from where we
// believe to be, so what was measured before is off by the change of that error.
//
//     along and across the road += drift of our position, and of our yaw times the line of sight
//
//   in     the modes of a track, its place, our own motion, the time since the last frame
//   out    the covariances of the modes; the states stay
//   source the errors of localization wander as a first-order Gauss-Markov process, whose change in
//          a short time dt has the variance 2 sigma^2 dt / time
//   cost   0.1 us; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vehicle/autonomy/tracking/filter/filter_params.hpp"
#include "vehicle/autonomy/tracking/filter/frame.hpp"
#include "vehicle/autonomy/tracking/filter/measurement.hpp"
#include "vehicle/autonomy/tracking/filter/track.hpp"

namespace pitwall::tracking {

void add_own_drift(const RoadParams& params, const OwnMotion& own, const Place& place, double dt_s,
                   Modes& modes);

}  // namespace pitwall::tracking
