// Interacting models of a track: the car goes on steadily, or it is in a maneuver. Both take the
// same measurements; how well each expects them says how likely it is.
//
//     mixed (a car may begin or end a maneuver) -> moved -> joined -> updated -> joined
//
//   in     states x of the track: the mean of both modes by their probability
//   out    joined(): its covariance, with the distance between the modes in it
//   invariants
//          mixing and joining do not change x; equal modes are one filter
//   cost   0.1 us each; no allocation
//   source Blom and Bar-Shalom (1988), IEEE Trans. Automatic Control 33, p. 780: IMM
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vehicle/autonomy/tracking/filter/filter_params.hpp"
#include "vehicle/autonomy/tracking/filter/track.hpp"

namespace pitwall::tracking {

// Probability to change the mode in a step.
struct ModeChange {
  double to_maneuver = 0.0, to_steady = 0.0;
};
ModeChange mode_change(const RoadParams& params, double dt_s);

// Of a track of which no more is known than x and p.
void begin_modes(const RoadParams& params, Track& track);

void mix_modes(const ModeChange& change, Modes& modes);
void join_modes(Track& track);

// States of a mode minus x.
inline double offset_of(const Modes& m, std::size_t mode, std::size_t state) {
  return (mode == kManeuver ? 1.0 - m.maneuver : -m.maneuver) * m.apart[state];
}

}  // namespace pitwall::tracking
