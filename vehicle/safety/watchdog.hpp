// Watchdog of the input streams: one row per stream with the age of its newest sample, and over the
// last second its rate, its longest gap and its longest delay from measurement to arrival. Each
// figure is good, warning or bad by the limits of the row; the row takes the worst of them, but a
// gap alone, which is over, is at most a warning. Time in which the car's own process did not run
// is subtracted from the ages, up to kDiscountMax, because the silence may be its own; the next
// ticks show which streams are alive.
//   in     the samples of this tick, the signals and flags received so far, the instants of the
//          planner and of the radio; the sensors that the operator has excluded
//   out    one row per stream: good, warning, bad, never received, or not watched; for each
//          receiver its own estimate of its accuracy
//   invariants
//          rate and delay are judged only over a whole second; of several values of a signal within
//          one tick the newest counts; an excluded sensor is not watched
//   units  Hz, s, m
//   errors none
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/monitor.hpp"
#include "vehicle/world/operator_inputs.hpp"
#include "vehicle/world/race_control.hpp"
#include "vehicle/world/sensor_input.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::safety {

enum class Stream : std::uint8_t {
  kGnss0Link,
  kGnss1Link,  // any byte of the receiver
  kGnss0Position,
  kGnss1Position,  // a position message of any content
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

// Bounds of one figure; zero disables it.
struct DurationLimit {
  Duration warning{}, bad{};
};
struct RateLimit {
  double warning_hz = 0.0, bad_hz = 0.0;  // lower rates are a warning or bad; bad_hz < warning_hz
};

struct StreamLimit {
  Stream stream;
  const char* name;
  bool watched;      // false: the car has no such stream
  Duration warning;  // older than this is a warning; (0, bad)
  Duration bad;      // older than this is bad; [20 ms, 60 s]
  RateLimit rate{};
  DurationLimit latency{};
  DurationLimit gap{};  // zero: the limits of the age
};

inline constexpr std::array<StreamLimit, kStreams> kStreamLimits = [] {
  constexpr auto ms = [](std::int64_t n) { return milliseconds(n); };
  using enum Stream;
  return std::array<StreamLimit, kStreams>{{
      {kGnss0Link, "gnss0 link", true, ms(100), ms(500), {}, {}},
      {kGnss1Link, "gnss1 link", true, ms(100), ms(500), {}, {}},
      {kGnss0Position, "gnss0 position", true, ms(125), ms(500), {15, 8}, {ms(120), ms(300)}},
      {kGnss1Position, "gnss1 position", true, ms(125), ms(500), {15, 8}, {ms(120), ms(300)}},
      {kGnss0Solution, "gnss0 solution", true, ms(250), ms(500), {}, {}},
      {kGnss1Solution, "gnss1 solution", true, ms(250), ms(500), {}, {}},
      {kGnss0Velocity, "gnss0 velocity", true, ms(125), ms(500), {15, 8}, {ms(120), ms(300)}},
      {kGnss1Velocity, "gnss1 velocity", true, ms(125), ms(500), {15, 8}, {ms(120), ms(300)}},
      {kGnss0Heading, "gnss0 heading", true, ms(2500), seconds(5), {}, {ms(300), ms(1000)}},
      {kGnss1Heading, "gnss1 heading", true, ms(2500), seconds(5), {}, {ms(300), ms(1000)}},
      {kImu0, "imu0", true, ms(25), ms(250), {80, 40}, {ms(30), ms(200)}},
      {kImu1, "imu1", true, ms(25), ms(250), {80, 40}, {ms(30), ms(200)}},
      {kWheelSpeed, "wheel speed", true, ms(25), ms(250), {70, 30}, {}},
      {kBrake, "brake", true, ms(25), ms(250), {70, 30}, {}},
      {kThrottle, "throttle", true, ms(25), ms(250), {70, 30}, {}},
      {kSteering, "steering", true, ms(25), ms(250), {70, 30}, {}},
      {kMisc, "drive-by-wire state", true, ms(1250), ms(2500), {}, {}},
      {kPowertrain, "powertrain", true, ms(25), ms(500), {70, 30}, {}},
      {kDiagnostics, "diagnostics", true, ms(250), ms(1000), {}, {}},
      {kRaceControl, "race control", true, ms(1250), seconds(10), {}, {}},
      {kPlanner, "planner", true, ms(125), ms(500), {15, 8}, {}},
      {kRadio, "radio", true, seconds(1), seconds(3), {}, {}},
  }};
}();

struct WatchdogParams {
  std::array<StreamLimit, kStreams> limits = kStreamLimits;

  world::MonitorSet off{};  // set by the bench only, not by a car file

  constexpr StreamLimit& operator[](Stream s) { return limits[static_cast<std::size_t>(s)]; }
};

inline constexpr Duration kPauseMin = milliseconds(25);  // two ticks missed
inline constexpr Duration kDiscountMax = milliseconds(250);

// Recent samples in slots of a tenth of a second. One slot more than the output covers: the running
// one.
inline constexpr Duration kFigureSlot = milliseconds(100);
inline constexpr std::size_t kFigureSlots = 11;
struct StreamHistory {
  std::array<std::uint16_t, kFigureSlots> samples{};
  std::array<Duration, kFigureSlots> gap{}, latency{};
  Instant began{};  // time of the first sample
};

struct WatchdogState {
  std::array<Instant, kStreams> last{};
  std::array<bool, kStreams> ever{};
  std::array<Duration, kStreams> discounted{};  // since its last sample; [0, kDiscountMax]
  std::array<StreamHistory, kStreams> history{};
  // Reported standard deviations of the last three positions of each receiver.
  std::array<std::array<double, 3>, world::kGnssUnits> sigmas_m{};
  std::array<std::uint32_t, world::kGnssUnits> positions{};
  Instant watched_at{};  // the last tick
};
static_assert(std::is_trivially_copyable_v<WatchdogState>);

struct WatchdogInputs {
  const world::SensorInput& sensors;
  const world::VehicleSignals& signals;
  const world::RaceControl& race_control;
  // Newest byte at the port of each receiver; nullopt: any sample of the unit counts as link.
  std::array<std::optional<Instant>, world::kGnssUnits> gnss_byte_at{};
  std::optional<Instant> planner_at;  // when the newest trajectory was planned
  std::optional<Instant> radio_at;    // newest sign of life of the base station
  world::SensorUse use{};
};

struct StreamRow {
  Stream stream = Stream::kGnss0Link;
  Health health = Health::kUnwatched;
  Duration age{};  // since the last sample; zero if never received
  // Over the last whole second; unset and zero before the first one.
  double rate_hz = kUnset;
  Duration gap{}, latency{};
};

struct WatchdogOutput {
  std::array<StreamRow, kStreams> rows{};
  // Best of the last three positions; unset before the first. A value that is not a number counts
  // as infinite.
  std::array<double, world::kGnssUnits> sigma_m{kUnset, kUnset};
  world::MonitorSet seen{};  // monitors with a finding in this tick

  constexpr const StreamRow& operator[](Stream s) const {
    return rows[static_cast<std::size_t>(s)];
  }
};

WatchdogOutput watch(const WatchdogParams& params, WatchdogState& state,
                     const WatchdogInputs& inputs, Instant now);

}  // namespace pitwall::safety
