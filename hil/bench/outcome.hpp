// Outcome of a run for the car: smallest gap to a wall, contact with a wall or with another car,
// final position.
//   in     the true state of the car, once per tick, in order of time
//   out    Outcome; states after a contact are ignored: a run ends there, because the plant has no
//          walls
//   units  m/s, m
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hil/traffic/contact_cause.hpp"
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

// Contact with another car, which ends a run too. Poses at that moment.
struct CarContact {
  Instant at{};
  std::string with;              // name of the other car
  std::uint8_t with_number = 0;  // as race control has it
  traffic::ContactKind kind = traffic::ContactKind::kFromSide;
  traffic::ContactRule rule = traffic::ContactRule::kApproached;
  bool is_caused = false;           // by this car, alone or with the other one
  bool is_caused_by_other = false;  // likewise
  double closing_mps = kUnset;
  double s_m = kUnset;  // station on the track
  traffic::Vector2 point_m{};
  plant::CarPose own{}, other{};
};

// Returns one sentence with place, speed and cause.
std::string to_text(const CarContact& contact);

// Returns one sentence; empty if there was no state.
std::string to_text(const Outcome& outcome);

}  // namespace pitwall::bench
