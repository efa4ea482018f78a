// Race control as a node on the CAN bus: plays the flags of a script, or what a judge calls.
//   in     Script (sorted by time), State, what timing knows of the car and its rival, the time
//   out    frames that are due: 1200 (every 500 ms and at once on a change; its heartbeat moves
//          with every frame), 1208 and 1209 (100 ms), 1250 and 1251 (500 ms, 1250 also on a
//          change), 226 and 228 (200 ms)
//   rate   call every 1 to 5 ms; late calls do not shift the due times
//   invariants
//          no two consecutive 1200 frames carry the same heartbeat, unless a fault demands it
//   units  mph in what race control sends; seconds and metres otherwise
//   errors an unsendable frame (NaN) is left out and counted
//   source DBC of the AV-21; cycle times of the public AV-24 bridge; sync check: falls when
//          the base has been lost for more than 10 s
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "hil/nodes/flag_encoding.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::race {

// Changes at one time; absent values stay.
struct Call {
  Instant at{};
  std::optional<world::TrackFlag> track{};
  std::optional<world::VehicleFlag> vehicle{};
  std::optional<double> round_target_speed_mph{};
  std::optional<std::uint8_t> lap{};  // absent: the count of timing
};

struct Script {
  world::FlagEncoding encoding = world::FlagEncoding::kMyLaps;
  bool both_encodings = true;  // both systems on the bus, in agreement, as on the V14 car
  // 226, 228 and a position in 1251; else 1251 is that of a unit without a fix: 0, 0
  bool positions = false;
  std::vector<Call> calls{};  // sorted by `at`; step() CHECKs
};

// Another car, as timing has it.
struct Rival {
  std::uint8_t number = 0, rank = 2, laps = 0;
  double distance_m = 0.0;  // since the start line
  double speed_mps = 0.0;
};

// Measurements of timing and scoring.
struct Timing {
  std::uint8_t laps = 0, rank = 1;
  double lap_distance_m = 0.0;  // since the start line
  double last_lap_s = 0.0;
  double speed_mps = 0.0, heading_deg = 0.0;
  double latitude_deg = 0.0, longitude_deg = 0.0;
  std::optional<Rival> rival{};
};

// Active faults, set by the bench.
struct RaceFaults {
  bool silent = false;                      // neither system sends any frame
  bool heartbeat_stopped = false;           // frames continue, the base behind both is lost
  std::optional<double> wrong_speed_mph{};  // the round speed sent instead
  // A call is shown so long after it; what is called meanwhile, with it.
  Duration late{};
};

struct RaceFrame {
  std::uint32_t id;
  Duration period, phase;
};
inline constexpr std::array kRaceFrames{
    RaceFrame{1200, milliseconds(500), milliseconds(2)},
    RaceFrame{1250, milliseconds(500), milliseconds(12)},
    RaceFrame{1251, milliseconds(500), milliseconds(22)},
    RaceFrame{1208, milliseconds(100), milliseconds(32)},
    RaceFrame{1209, milliseconds(100), milliseconds(42)},
    RaceFrame{226, milliseconds(200), milliseconds(52)},
    RaceFrame{228, milliseconds(200), milliseconds(62)},
};

// What the frames carry.
struct ShownCall {
  Flags flags;
  double round_target_speed_mph = 0.0;
  std::optional<std::uint8_t> lap{};

  bool operator==(const ShownCall&) const = default;
};

struct State {
  Flags flags;  // as called
  double round_target_speed_mph = 0.0;
  std::optional<std::uint8_t> lap{};
  ShownCall shown;
  std::optional<Instant> waiting_since{};  // a call that is not shown yet
  std::size_t next_call = 0;
  bool changed = true;  // an extra 1200 / 1250 is due
  RaceFaults faults;
  bool begun = false;
  std::array<Instant, kRaceFrames.size()> due{};
  std::uint8_t heartbeat = 0;
  Instant base_lost_since{};
  bool base_lost = false;
  std::uint64_t unsent = 0, saturated = 0;
};

using RaceFrames = FixedVector<can::Frame, kRaceFrames.size()>;

// Applies a call from outside the script, by a judge or an operator, at the next step().
void call(State& state, const Call& call);

RaceFrames step(const Script& script, State& state, const Timing& timing, Instant now);

}  // namespace pitwall::race
