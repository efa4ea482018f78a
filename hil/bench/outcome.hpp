// Outcome of a run for the car: smallest gap to a wall, contact, place at the end.
//   in     what is true of the car, once per tick, in the order of time
//   out    Outcome; nothing after a contact is taken in: a run ends there, the plant knows no walls
//   units  m/s, m
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::bench {

struct Whereabouts {
  Instant at{};
  double speed_mps = kUnset;
  double cross_track_m = kUnset;  // from the line that the car was told to drive; left is positive
  double wall_gap_m = kUnset;     // of the nearest corner
  double s_m = kUnset;            // station on the track
  bool left = false;              // the nearer wall is that on the left
  bool contact = false;           // a corner is in a wall
};

struct Outcome {
  std::optional<Whereabouts> last;  // at the contact, where there was one
  std::optional<Whereabouts> nearest;
};

inline bool has_contact(const Outcome& outcome) { return outcome.last && outcome.last->contact; }

void follow(Outcome& outcome, const Whereabouts& now);

// One sentence; empty if nothing was followed.
std::string to_text(const Outcome& outcome);

}  // namespace pitwall::bench
