// Driver of a ghost in a match: lane and speed by role, flag and gap, in a manner that is known
// beforehand.
//   in     what the driver does in its attempts; role, flag, lead over the other car
//   out    lane and speed; whether it declines the attempt
//   method a function of its inputs without memory. It trails on the outside lane, 25 m behind,
//          and passes there with a constant surplus. Where it falls back it leaves its lane to the
//          other car; where the other one falls back it keeps its own until it is ahead
//   units  lead: its centre before that of the other car along the track [m], negative behind
//   errors a NaN lead: it keeps the outside lane at the speed of the other car
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/rules/passing_rules.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::traffic {

// What it does with an attempt of its own.
enum class Manner : std::uint8_t {
  kPass,
  kFollow,    // trails, and does not pass
  kCutIn,     // takes the inside lane 10 m ahead
  kEarly,     // does not wait for waving green
  kRam,       // drives into the car ahead
  kOpenDoor,  // does not take the inside lane after the pass
  kDecline,
};

enum class Defence : std::uint8_t {
  kHold,
  kSlow,  // 15 % below the round speed in the pass
  kWide,  // on the outside lane in the pass
};

struct MatchTask {
  rules::Role role = rules::Role::kDefender;
  bool is_cautioned = false;  // told to fall back
  bool pass_allowed = false;  // waving green
  double round_speed_mps = kUnset;
  double lead_m = kUnset;
  double length_m = kUnset;  // mean of the two cars
  double other_mps = kUnset;
  bool is_inside = false, is_other_inside = false;  // lanes now
};

struct DriverOrder {
  bool inside = false;
  double speed_mps = 0.0;
  bool declines = false;
};

DriverOrder order_of(Manner manner, Defence defence, const MatchTask& task);

}  // namespace pitwall::traffic
