// Car that ours trails or passes, by its gap along the track: one that keeps its place through a
// new number of its track and a short time out of sight.
//   in     the tracked cars; station of our car
//   out    Rival
//   frames gap: our station less that of the rival, positive where we are ahead; offset n as
//          TrackMap has it
//   invariants
//          a rival that is known stays the rival while it is tracked within reach. Where its number
//          is gone, a car where it should be is the same
//          without one it goes on at its speed for forget_s, then it is not known
//          a car that has not been measured for a quarter of a second is not believed
//   errors cars without a finite place or speed are no rivals
//   cost   O(cars), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/opponent.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::planning {

struct RivalParams {
  double watch_ahead_m = kUnset, watch_behind_m = kUnset;  // where a car becomes the rival
  double forget_s = kUnset;
};

struct Rival {
  bool known = false;
  std::uint32_t id = 0;  // of its track
  double gap_m = kUnset, n_m = kUnset;
  double speed_mps = kUnset;    // along the track
  double drift_mps = kUnset;    // to the left
  Instant at{}, measured_at{};  // of this state; of its newest detection
};

// Our car on the track.
struct OwnPlace {
  double track_s_m = kUnset, speed_mps = kUnset;
};

// Of our station over that of a car, the shorter way around.
double gap_m(const world::TrackMap& track, double own_s_m, double other_s_m);

Rival follow(const RivalParams& params, const Rival& last, const world::TrackMap& track,
             const OwnPlace& own, const world::Opponents& cars, Instant now);

// A tracked car as a rival; not known without a finite place and speed, or where it is too young.
Rival rival_of(const world::TrackMap& track, const OwnPlace& own, const world::Opponent& car,
               Instant at);

}  // namespace pitwall::planning
