// Encoder of flags: from typed flags to the raw values of both race-control systems.
//   in     flags
//   out    raw track and vehicle values
//   errors a flag that the encoding lacks becomes the most similar one that is at least as
//          restrictive (MyLaps: stop -> red, engine kill -> purple; Marelli: orange is a vehicle
//          flag); kUnknown becomes a value that is in no public table
//   source flags as used by public code of the racing teams; the table of the car is written
//          independently (vehicle/gateway), so that each tests the other
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "vehicle/world/race_control.hpp"

namespace pitwall::race {

struct Flags {
  world::TrackFlag track = world::TrackFlag::kNone;
  world::VehicleFlag vehicle = world::VehicleFlag::kNone;

  bool operator==(const Flags&) const = default;
};

struct RawFlags {
  std::uint8_t track = 0, vehicle = 0;

  bool operator==(const RawFlags&) const = default;
};

RawFlags to_mylaps(const Flags& flags);

// A green flag with a round speed that Marelli defines becomes the code of that speed; NaN: plain
// green.
RawFlags to_marelli(const Flags& flags, double round_target_speed_mph);

}  // namespace pitwall::race
