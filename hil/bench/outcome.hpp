// Outcome of a run for the car: smallest gap to a wall, contact, final position.
//   in     the true state of the car, once per tick, in order of time
//   out    Outcome; states after a contact are ignored: a run ends there, because the plant has no
//          walls
//   units  m/s, m
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::bench {

struct VehiclePlace {
  Instant at{};
  double speed_mps = kUnset;
  double cross_track_m = kUnset;  // from the line that the car has to drive; left is positive
  double wall_gap_m = kUnset;     // of the corner nearest to a wall
  double s_m = kUnset;            // station on the track
  bool left = false;              // the nearer wall is on the left
  bool contact = false;           // a corner of the car is in a wall
};

struct Outcome {
  std::optional<VehiclePlace> last;  // at the contact, if there was one
  std::optional<VehiclePlace> nearest;
};

inline bool has_contact(const Outcome& outcome) { return outcome.last && outcome.last->contact; }

void follow(Outcome& outcome, const VehiclePlace& now);

// Returns one sentence; empty if there was no state.
std::string to_text(const Outcome& outcome);

}  // namespace pitwall::bench
