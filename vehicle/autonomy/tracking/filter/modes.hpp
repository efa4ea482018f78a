// Interacting models of a track: the car goes on steadily, it changes its speed, or it changes its
// lane (and its speed with it). All take the same measurements; how well each expects them says how
// likely it is.
//
//     mixed (a car may begin or end a maneuver) -> moved -> joined -> updated -> joined
//
//   in     states x of the track: the mean of the modes by their probability
//   out    join_modes(): its covariance, with the distances between the modes in it
//   invariants
//          mixing and joining do not change x; equal modes are one filter
//   cost   0.2 us each; no allocation
//   source Blom and Bar-Shalom (1988), IEEE Trans. Automatic Control 33, p. 780: IMM
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vehicle/autonomy/tracking/filter/filter_params.hpp"
#include "vehicle/autonomy/tracking/filter/track.hpp"

namespace pitwall::tracking {

// Probability of a mode after a step, by the mode before.
using ModeChange = std::array<std::array<double, kModes>, kModes>;  // [from][to]
ModeChange mode_change(const RoadParams& params, double dt_s);

// Of a track of which no more is known than x and p.
void begin_modes(const RoadParams& params, Track& track);

void mix_modes(const ModeChange& change, Modes& modes);
// Moves x to the mean of the modes, each of which stays where it is.
void centre_modes(Track& track);
// Sets the covariance of the track. The filter works on the modes and leaves it to who reads it.
void join_modes(Track& track);

}  // namespace pitwall::tracking
