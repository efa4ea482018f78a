// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/watchdog.hpp"

#include <algorithm>

namespace pitwall::safety {
namespace {

constexpr Duration kTick = milliseconds(10);

constexpr std::size_t at(Stream stream) { return static_cast<std::size_t>(stream); }

// The streams of one kind are neighbours: unit 0, then unit 1.
constexpr Stream of_unit(Stream unit_0, std::uint8_t unit) {
  return static_cast<Stream>(at(unit_0) + unit);
}
static_assert(of_unit(Stream::kGnss0Link, 1) == Stream::kGnss1Link);
static_assert(of_unit(Stream::kGnss0Position, 1) == Stream::kGnss1Position);
static_assert(of_unit(Stream::kGnss0Solution, 1) == Stream::kGnss1Solution);
static_assert(of_unit(Stream::kGnss0Velocity, 1) == Stream::kGnss1Velocity);
static_assert(of_unit(Stream::kGnss0Heading, 1) == Stream::kGnss1Heading);
static_assert(of_unit(Stream::kImu0, 1) == Stream::kImu1);

consteval bool limits_are_in_order() {
  const WatchdogParams params;
  for (std::size_t i = 0; i < kStreams; ++i)
    if (at(params.limits[i].stream) != i) return false;
  return true;
}
static_assert(limits_are_in_order(), "WatchdogParams::limits is indexed by Stream");

void seen(WatchdogState& state, Stream stream, Instant when) {
  const std::size_t i = at(stream);
  if (!state.ever[i] || when > state.last[i]) {
    state.last[i] = when;
    state.pardoned[i] = {};
  }
  state.ever[i] = true;
}

// Of a sleep that is over, what lies after a stream's newest.
void pardon(WatchdogState& state, Instant now) {
  const Duration slept = now - state.watched_at;
  const bool overslept = state.watched_at != Instant{} && slept > kOverslept;
  state.watched_at = now;
  if (!overslept) return;
  for (std::size_t i = 0; i < kStreams; ++i) {
    const Duration of_this = std::min(slept, now - state.last[i]) - kTick;
    state.pardoned[i] = std::clamp(state.pardoned[i] + of_this, state.pardoned[i], kPardonMax);
  }
}

bool is_solved(const world::GnssPosition& p) {
  return p.solution_status == world::kSolutionComputed && p.position_type != world::kPositionNone;
}

template <class Sample>
void samples(WatchdogState& state, const WatchdogInputs& inputs, const Sample& sample,
             Stream unit_0) {
  if (sample.unit >= world::kGnssUnits) return;  // not a unit of this car
  seen(state, of_unit(unit_0, sample.unit), sample.at);
  if (!inputs.gnss_byte_at[sample.unit])
    seen(state, of_unit(Stream::kGnss0Link, sample.unit), sample.at);
}

void sensors(WatchdogState& state, const WatchdogInputs& inputs) {
  for (const auto& p : inputs.sensors.positions) {
    samples(state, inputs, p, Stream::kGnss0Position);
    if (is_solved(p)) samples(state, inputs, p, Stream::kGnss0Solution);
  }
  for (const auto& v : inputs.sensors.velocities) samples(state, inputs, v, Stream::kGnss0Velocity);
  for (const auto& h : inputs.sensors.headings) samples(state, inputs, h, Stream::kGnss0Heading);
  for (const auto& i : inputs.sensors.imu) samples(state, inputs, i, Stream::kImu0);
  for (std::uint8_t unit = 0; unit < world::kGnssUnits; ++unit)
    if (inputs.gnss_byte_at[unit])
      seen(state, of_unit(Stream::kGnss0Link, unit), *inputs.gnss_byte_at[unit]);
}

template <class T>
void heard(WatchdogState& state, Stream stream, const world::Heard<T>& signal) {
  if (signal.heard) seen(state, stream, signal.at);
}

StreamRow judge(const StreamLimit& limit, const WatchdogState& state, Instant now) {
  if (!limit.watched) return {limit.stream, Health::kUnwatched, Duration{}};
  const std::size_t i = at(limit.stream);
  if (!state.ever[i]) return {limit.stream, Health::kNever, Duration{}};
  const Duration age = std::max(Duration{}, now - state.last[i] - state.pardoned[i]);
  if (age > limit.bad) return {limit.stream, Health::kBad, age};
  return {limit.stream, age > limit.warning ? Health::kWarning : Health::kGood, age};
}

}  // namespace

WatchdogOutput watch(const WatchdogParams& params, WatchdogState& state,
                     const WatchdogInputs& inputs, Instant now) {
  sensors(state, inputs);
  const world::VehicleSignals& s = inputs.signals;
  heard(state, Stream::kWheelSpeed, s.wheel_speed_mps);
  heard(state, Stream::kBrake, s.brake);
  heard(state, Stream::kThrottle, s.throttle_fraction);
  heard(state, Stream::kSteering, s.steering_motor_rad);
  heard(state, Stream::kMisc, s.misc);
  heard(state, Stream::kPowertrain, s.powertrain);
  heard(state, Stream::kDiagnostics, s.diagnostics);
  if (inputs.race_control.ever_heard)
    seen(state, Stream::kRaceControl, inputs.race_control.last_heartbeat_change);
  if (inputs.planner_at) seen(state, Stream::kPlanner, *inputs.planner_at);
  if (inputs.radio_at) seen(state, Stream::kRadio, *inputs.radio_at);

  // A stamp from the future keeps nothing alive.
  for (Instant& last : state.last) last = std::min(last, now);
  pardon(state, now);
  WatchdogOutput out;
  for (std::size_t i = 0; i < kStreams; ++i) out.rows[i] = judge(params.limits[i], state, now);
  return out;
}

}  // namespace pitwall::safety
