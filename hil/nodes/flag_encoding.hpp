// Encoder of flags: typed flags to the raw values of both race-control systems.
//   in     flags; out   raw track and vehicle values
//   errors a flag that the encoding cannot carry becomes the most similar one that restricts
//          at least as much (MyLaps: stop -> red, engine kill -> purple; Marelli: orange is a
//          vehicle flag); kUnknown becomes a value that no public table lists
//   source flags as spoken by public code of the racing teams; the car's own table is written apart
//          (vehicle/gateway), so that each tests the other
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

// A green with a round speed that Marelli knows is the speed itself; NaN: plain green.
RawFlags to_marelli(const Flags& flags, double round_target_speed_mph);

}  // namespace pitwall::race
