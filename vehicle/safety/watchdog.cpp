// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/watchdog.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

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

std::int64_t slot_number(Instant at) { return (at - Instant{}) / kFigureSlot; }
std::size_t slot_of(Instant at) { return static_cast<std::size_t>(slot_number(at)) % kFigureSlots; }

void note(StreamHistory& history, Duration gap, Duration latency, Instant now) {
  const std::size_t slot = slot_of(now);
  if (history.samples[slot] < std::numeric_limits<std::uint16_t>::max()) ++history.samples[slot];
  history.gap[slot] = std::max(history.gap[slot], gap);
  history.latency[slot] = std::max(history.latency[slot], latency);
}

// `delayed`: from the time of the sample to its arrival. A pause of the process is no gap of the
// stream.
void record_arrival(WatchdogState& state, Stream stream, Instant when, Duration delayed,
                    Duration pause, Instant now) {
  const std::size_t i = at(stream);
  if (state.ever[i] && when <= state.last[i]) return;
  if (!state.ever[i]) state.history[i].began = now;
  const Duration own = std::max(state.discounted[i], pause);
  const Duration gap = state.ever[i] ? when - state.last[i] - own : Duration{};
  note(state.history[i], std::max(gap, Duration{}), delayed, now);
  state.last[i] = when;
  state.discounted[i] = {};
  state.ever[i] = true;
}

// Slots that have begun since the last tick are empty.
void clear_begun_slots(WatchdogState& state, Instant now) {
  const std::int64_t passed = slot_number(now) - slot_number(state.watched_at);
  const auto fresh = std::clamp<std::int64_t>(passed, 0, kFigureSlots);
  for (std::int64_t k = 0; k < fresh; ++k) {
    const std::size_t slot = slot_of(now - k * kFigureSlot);
    for (StreamHistory& history : state.history) {
      history.samples[slot] = 0;
      history.gap[slot] = history.latency[slot] = {};
    }
  }
}

// Discounts the part of a pause that lies after the newest sample of each stream.
void discount_pause(WatchdogState& state, Instant now, Duration pause) {
  for (std::size_t i = 0; i < kStreams; ++i) {
    const Duration of_this = std::min(pause, now - state.last[i]) - kTick;
    state.discounted[i] =
        std::clamp(state.discounted[i] + of_this, state.discounted[i], kDiscountMax);
  }
}

// The car's own stream had no samples during the pause: as many are counted as just suffice.
void count_paused_samples(StreamHistory& history, const RateLimit& rate, Duration pause,
                          Instant now) {
  const double missed = std::ceil(rate.warning_hz * pause.seconds());
  constexpr double kMost = 1'000.0;
  history.samples[slot_of(now)] += static_cast<std::uint16_t>(std::clamp(missed, 0.0, kMost));
}

// With a receiver that counts its satellites, enough of them.
bool is_solved(const world::GnssPosition& p) {
  constexpr std::uint8_t kSatellitesLeast = 4;
  return p.solution_status == world::kSolutionComputed && p.position_type != world::kPositionNone &&
         (p.satellites == 0 || p.satellites >= kSatellitesLeast);
}

// Records arrivals without the part of their delay in which the process was paused.
struct ArrivalRecorder {
  WatchdogState& state;
  Instant now;
  Duration pause;

  void record(Stream stream, Instant when) const {
    record_arrival(state, stream, when, now - when - pause, pause, now);
  }
  template <class T>
  void record(Stream stream, const world::Received<T>& signal) const {
    if (signal.received) record(stream, signal.at);
  }
};

template <class Sample>
void record_sample(const ArrivalRecorder& recorder, const WatchdogInputs& inputs,
                   const Sample& sample, Stream unit_0) {
  if (sample.unit >= world::kGnssUnits) return;  // not a unit of this car
  recorder.record(of_unit(unit_0, sample.unit), sample.at);
  if (!inputs.gnss_byte_at[sample.unit])
    recorder.record(of_unit(Stream::kGnss0Link, sample.unit), sample.at);
}

void store_sigma(WatchdogState& state, const world::GnssPosition& p) {
  if (p.unit >= world::kGnssUnits) return;
  const double sigma_m = std::max(p.latitude_sigma_m, p.longitude_sigma_m);
  const bool reported = p.latitude_sigma_m >= 0.0 && p.longitude_sigma_m >= 0.0;
  auto& kept_m = state.sigmas_m[p.unit];
  kept_m[state.positions[p.unit]++ % kept_m.size()] =
      reported ? sigma_m : std::numeric_limits<double>::infinity();
}

void record_sensors(const ArrivalRecorder& recorder, const WatchdogInputs& inputs) {
  for (const auto& p : inputs.sensors.positions) {
    record_sample(recorder, inputs, p, Stream::kGnss0Position);
    if (is_solved(p)) record_sample(recorder, inputs, p, Stream::kGnss0Solution);
    store_sigma(recorder.state, p);
  }
  for (const auto& v : inputs.sensors.velocities)
    record_sample(recorder, inputs, v, Stream::kGnss0Velocity);
  for (const auto& h : inputs.sensors.headings)
    record_sample(recorder, inputs, h, Stream::kGnss0Heading);
  for (const auto& i : inputs.sensors.imu) record_sample(recorder, inputs, i, Stream::kImu0);
  for (std::uint8_t unit = 0; unit < world::kGnssUnits; ++unit)
    if (inputs.gnss_byte_at[unit])
      recorder.record(of_unit(Stream::kGnss0Link, unit), *inputs.gnss_byte_at[unit]);
}

Health grade(Duration value, const DurationLimit& limit) {
  if (limit.bad != Duration{} && value > limit.bad) return Health::kBad;
  return limit.warning != Duration{} && value > limit.warning ? Health::kWarning : Health::kGood;
}
Health grade(double rate_hz, const RateLimit& limit) {  // not a number is not judged
  if (rate_hz < limit.bad_hz) return Health::kBad;
  return rate_hz < limit.warning_hz ? Health::kWarning : Health::kGood;
}

// Of the ten slots before the running one.
void figures(const StreamHistory& history, Instant now, StreamRow& row) {
  if (now - history.began < static_cast<std::int64_t>(kFigureSlots) * kFigureSlot) return;
  const std::size_t running = slot_of(now);
  double samples = 0.0;
  for (std::size_t slot = 0; slot < kFigureSlots; ++slot) {
    if (slot == running) continue;
    samples += history.samples[slot];
    row.gap = std::max(row.gap, history.gap[slot]);
    row.latency = std::max(row.latency, history.latency[slot]);
  }
  row.rate_hz = samples / (kFigureSlot.seconds() * (kFigureSlots - 1));
}

StreamRow judge(const StreamLimit& limit, const WatchdogState& state, Instant now) {
  const std::size_t i = at(limit.stream);
  StreamRow row{.stream = limit.stream, .health = Health::kUnwatched};
  if (!limit.watched) return row;
  row.health = Health::kNever;
  if (!state.ever[i]) return row;
  row.age = std::max(Duration{}, now - state.last[i] - state.discounted[i]);
  figures(state.history[i], now, row);
  const DurationLimit age{limit.warning, limit.bad};
  const DurationLimit gap = limit.gap.bad == Duration{} ? age : limit.gap;
  row.health = std::max({grade(row.age, age), grade(row.rate_hz, limit.rate),
                         grade(row.latency, limit.latency),
                         std::min(grade(row.gap, gap), Health::kWarning)});
  return row;
}

// Whether the operator has excluded the sensor of the stream.
bool is_excluded(const world::SensorUse& use, Stream stream) {
  using enum world::Excludable;
  if (stream < Stream::kImu0) {
    const bool first = at(stream) % 2 == 0;  // links, positions ... of units 0 and 1 alternate
    return !use.uses(first ? kGnss0 : kGnss1);
  }
  if (stream == Stream::kImu0) return !use.uses(kImu0);
  if (stream == Stream::kImu1) return !use.uses(kImu1);
  return false;
}
static_assert(at(Stream::kGnss0Heading) % 2 == 0 && at(Stream::kImu0) == 10);

// What localization lives on: receivers, IMUs and wheels.
constexpr bool is_of_localization(Stream stream) { return stream <= Stream::kWheelSpeed; }

}  // namespace

WatchdogOutput watch(const WatchdogParams& params, WatchdogState& state,
                     const WatchdogInputs& inputs, Instant now) {
  clear_begun_slots(state, now);
  const Duration pause = now - state.watched_at;
  const bool paused = state.watched_at != Instant{} && pause > kPauseMin;
  const ArrivalRecorder recorder{state, now, paused ? pause : Duration{}};
  record_sensors(recorder, inputs);
  const world::VehicleSignals& s = inputs.signals;
  recorder.record(Stream::kWheelSpeed, s.wheel_speed_mps);
  recorder.record(Stream::kBrake, s.brake);
  recorder.record(Stream::kThrottle, s.throttle_fraction);
  recorder.record(Stream::kSteering, s.steering_motor_rad);
  recorder.record(Stream::kMisc, s.misc);
  recorder.record(Stream::kPowertrain, s.powertrain);
  recorder.record(Stream::kDiagnostics, s.diagnostics);
  if (inputs.race_control.ever_received)
    recorder.record(Stream::kRaceControl, inputs.race_control.last_heartbeat_change);
  if (inputs.planner_at) recorder.record(Stream::kPlanner, *inputs.planner_at);
  if (inputs.radio_at) recorder.record(Stream::kRadio, *inputs.radio_at);

  // A stamp from the future keeps nothing alive.
  for (Instant& last : state.last) last = std::min(last, now);
  if (paused) {
    discount_pause(state, now, pause);
    count_paused_samples(state.history[at(Stream::kPlanner)],
                         params.limits[at(Stream::kPlanner)].rate, std::min(pause, kDiscountMax),
                         now);
  }
  state.watched_at = now;
  WatchdogOutput out;
  for (std::size_t i = 0; i < kStreams; ++i) {
    StreamRow& row = out.rows[i] = judge(params.limits[i], state, now);
    const auto stream = static_cast<Stream>(i);
    if (is_excluded(inputs.use, stream)) row.health = Health::kUnwatched;
    if (row.health > Health::kGood && is_of_localization(stream))
      out.seen.add(world::Monitor::kStreamAge);
  }
  for (std::size_t unit = 0; unit < world::kGnssUnits; ++unit)
    if (state.positions[unit] > 0)
      out.sigma_m[unit] = *std::ranges::min_element(
          std::span{state.sigmas_m[unit]}.first(std::min<std::size_t>(state.positions[unit], 3)));
  out.seen.bits &= ~params.off.bits;
  return out;
}

}  // namespace pitwall::safety
