// Is everything still alive? One row per stream: when it was last heard, how old that is, and what
// the age means by the row's limits. Ages decide: a stream that misses its rate grows old. Time in
// which the car's process itself did not run is taken off the age, up to kPardonMax: whoever slept
// cannot say who else was silent, and hears in its next ticks who lives.
//   in     the samples of this tick, the signals and flags heard so far, the instants of the
//          planner and of the radio
//   out    one row per stream: good, warning, bad, never heard, or not watched
//   errors none
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/world/monitor.hpp"
#include "vehicle/world/race_control.hpp"
#include "vehicle/world/sensor_input.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::safety {

enum class Stream : std::uint8_t {
  kGnss0Link,
  kGnss1Link,  // any byte of the receiver
  kGnss0Position,
  kGnss1Position,  // a position message, whatever it says
  kGnss0Solution,
  kGnss1Solution,  // a position with a computed solution of any quality
  kGnss0Velocity,
  kGnss1Velocity,
  kGnss0Heading,
  kGnss1Heading,
  kImu0,
  kImu1,
  kWheelSpeed,
  kBrake,
  kThrottle,
  kSteering,
  kMisc,
  kPowertrain,
  kDiagnostics,
  kRaceControl,  // change of the heartbeat
  kPlanner,
  kRadio
};
inline constexpr std::size_t kStreams = 22;

enum class Health : std::uint8_t { kUnwatched, kNever, kGood, kWarning, kBad };

struct StreamLimit {
  Stream stream;
  const char* name;
  bool watched;      // false: the car has no such stream
  Duration warning;  // older than this is a warning; (0, bad)
  Duration bad;      // older than this is bad; [20 ms, 60 s]
};

struct WatchdogParams {
  std::array<StreamLimit, kStreams> limits{{
      {Stream::kGnss0Link, "gnss0 link", true, milliseconds(100), milliseconds(500)},
      {Stream::kGnss1Link, "gnss1 link", true, milliseconds(100), milliseconds(500)},
      {Stream::kGnss0Position, "gnss0 position", true, milliseconds(125), milliseconds(500)},
      {Stream::kGnss1Position, "gnss1 position", true, milliseconds(125), milliseconds(500)},
      {Stream::kGnss0Solution, "gnss0 solution", true, milliseconds(250), seconds(2)},
      {Stream::kGnss1Solution, "gnss1 solution", true, milliseconds(250), seconds(2)},
      {Stream::kGnss0Velocity, "gnss0 velocity", true, milliseconds(125), milliseconds(500)},
      {Stream::kGnss1Velocity, "gnss1 velocity", true, milliseconds(125), milliseconds(500)},
      {Stream::kGnss0Heading, "gnss0 heading", true, milliseconds(2500), seconds(5)},
      {Stream::kGnss1Heading, "gnss1 heading", true, milliseconds(2500), seconds(5)},
      {Stream::kImu0, "imu0", true, milliseconds(25), milliseconds(250)},
      {Stream::kImu1, "imu1", true, milliseconds(25), milliseconds(250)},
      {Stream::kWheelSpeed, "wheel speed", true, milliseconds(25), milliseconds(250)},
      {Stream::kBrake, "brake", true, milliseconds(25), milliseconds(250)},
      {Stream::kThrottle, "throttle", true, milliseconds(25), milliseconds(250)},
      {Stream::kSteering, "steering", true, milliseconds(25), milliseconds(250)},
      {Stream::kMisc, "drive-by-wire state", true, milliseconds(1250), milliseconds(2500)},
      {Stream::kPowertrain, "powertrain", true, milliseconds(25), milliseconds(500)},
      {Stream::kDiagnostics, "diagnostics", true, milliseconds(250), milliseconds(1000)},
      {Stream::kRaceControl, "race control", true, milliseconds(1250), seconds(10)},
      {Stream::kPlanner, "planner", true, milliseconds(125), milliseconds(500)},
      {Stream::kRadio, "radio", true, seconds(1), seconds(3)},
  }};

  world::MonitorSet off{};  // of the bench alone: no car file sets it

  constexpr StreamLimit& operator[](Stream s) { return limits[static_cast<std::size_t>(s)]; }
};

inline constexpr Duration kOverslept = milliseconds(25);  // two ticks missed
inline constexpr Duration kPardonMax = milliseconds(250);

struct WatchdogState {
  std::array<Instant, kStreams> last{};
  std::array<bool, kStreams> ever{};
  std::array<Duration, kStreams> pardoned{};  // since it was last heard; [0, kPardonMax]
  Instant watched_at{};                       // the last tick
};
static_assert(std::is_trivially_copyable_v<WatchdogState>);

struct WatchdogInputs {
  const world::SensorInput& sensors;
  const world::VehicleSignals& signals;
  const world::RaceControl& race_control;
  // From the receivers' ports where the rim knows them; else any sample of the unit counts.
  std::array<std::optional<Instant>, world::kGnssUnits> gnss_byte_at{};
  std::optional<Instant> planner_at;  // when the newest trajectory was planned
  std::optional<Instant> radio_at;    // the base station was alive then
};

struct StreamRow {
  Stream stream = Stream::kGnss0Link;
  Health health = Health::kUnwatched;
  Duration age{};  // since the last; zero where never
};

struct WatchdogOutput {
  std::array<StreamRow, kStreams> rows{};
  world::MonitorSet seen{};  // monitors that see something wrong now

  constexpr const StreamRow& operator[](Stream s) const {
    return rows[static_cast<std::size_t>(s)];
  }
};

WatchdogOutput watch(const WatchdogParams& params, WatchdogState& state,
                     const WatchdogInputs& inputs, Instant now);

}  // namespace pitwall::safety
