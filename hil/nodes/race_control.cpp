// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/race_control.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/can/av21.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::race {
namespace {

namespace av21 = can::av21;
using world::FlagEncoding;

constexpr std::uint8_t kHeartbeats = 16;  // 4 bits
constexpr Duration kBaseSyncTimeout = seconds(10);
constexpr double kRadioStrength = 90.0;  // lte_rssi; a healthy modem

bool uses(const Script& script, FlagEncoding encoding) {
  return script.both_encodings || script.encoding == encoding;
}

// Of the messages that this script sends at all.
bool sends(const Script& script, std::uint32_t id) {
  switch (id) {
    case av21::BaseToCarSummary::kId:
      return uses(script, FlagEncoding::kMyLaps);
    case av21::MarelliReport1::kId:
    case av21::MarelliReport2::kId:
      return uses(script, FlagEncoding::kMarelli);
    case av21::MylapsReport1::kId:
    case av21::MylapsReport2::kId:
      return script.positions;
    default:
      return true;
  }
}

bool carries_flags(std::uint32_t id) {
  return id == av21::BaseToCarSummary::kId || id == av21::MarelliReport1::kId;
}

template <class Message>
bool encoded(const Message& message, State& state, can::Frame& out) {
  can::EncodeCounters counters;
  const bool sendable = av21::encode(message, out, counters);
  state.saturated += counters.saturated;
  state.unsent += sendable ? 0U : 1U;
  return sendable;
}

bool encode_summary(State& state, const Timing& timing, can::Frame& out) {
  const RawFlags raw = to_mylaps(state.shown.flags);
  if (!state.faults.heartbeat_stopped)
    state.heartbeat = static_cast<std::uint8_t>((state.heartbeat + 1) % kHeartbeats);
  av21::BaseToCarSummary m;
  m.base_to_car_heartbeat = state.heartbeat;
  m.track_flag = raw.track;
  m.veh_flag = raw.vehicle;
  m.veh_rank = timing.rank;
  m.round_target_speed = state.faults.wrong_speed_mph.value_or(state.shown.round_target_speed_mph);
  m.lap_count = state.shown.lap.value_or(timing.laps);
  m.lap_distance = timing.lap_distance_m;
  return encoded(m, state, out);
}

bool encode_marelli(State& state, can::Frame& out, Instant now) {
  const double speed_mph =
      state.faults.wrong_speed_mph.value_or(state.shown.round_target_speed_mph);
  const RawFlags raw = to_marelli(state.shown.flags, speed_mph);
  const bool synchronous = !state.base_lost || now - state.base_lost_since <= kBaseSyncTimeout;
  av21::MarelliReport1 m;
  m.marelli_track_flag = raw.track;
  m.marelli_vehicle_flag = raw.vehicle;
  m.marelli_sector_flag = 0.0;
  m.marelli_rc_base_sync_check = synchronous ? 1.0 : 0.0;
  m.marelli_rc_lte_rssi = kRadioStrength;
  return encoded(m, state, out);
}

bool encode_timing(State& state, const Timing& timing, can::Frame& out, Instant now) {
  av21::BaseToCarTiming m;
  m.laps = timing.laps;
  m.lap_time = timing.last_lap_s * 1e3;
  m.time_stamp = std::fmod(Duration{now.ns}.milliseconds(), 429'496'729.0);  // 32 bits of 0.1 ms
  return encoded(m, state, out);
}

bool encode_rival(State& state, const Timing& timing, can::Frame& out) {
  av21::RestOfField m;
  const Rival rival = timing.rival.value_or(Rival{.number = 0, .rank = 0});
  m.comp_veh_num = rival.number;
  m.comp_veh_flag = 0.0;
  m.comp_rank = rival.rank;
  m.comp_laps_count = rival.laps;
  m.comp_lap_distance = rival.distance_m;
  m.comp_speed = to_kmh(rival.speed_mps);
  return encoded(m, state, out);
}

bool encode_frame(const Script& script, std::uint32_t id, State& state, const Timing& timing,
                  can::Frame& out, Instant now) {
  switch (id) {
    case av21::BaseToCarSummary::kId:
      return encode_summary(state, timing, out);
    case av21::MarelliReport1::kId:
      return encode_marelli(state, out, now);
    case av21::BaseToCarTiming::kId:
      return encode_timing(state, timing, out, now);
    case av21::RestOfField::kId:
      return encode_rival(state, timing, out);
    case av21::MarelliReport2::kId: {
      av21::MarelliReport2 m;
      m.marelli_gps_lat = script.positions ? timing.latitude_deg : 0.0;
      m.marelli_gps_long = script.positions ? timing.longitude_deg : 0.0;
      return encoded(m, state, out);
    }
    case av21::MylapsReport2::kId: {
      av21::MylapsReport2 m;
      m.Latitude = timing.latitude_deg;
      m.Longitude = timing.longitude_deg;
      return encoded(m, state, out);
    }
    case av21::MylapsReport1::kId: {
      av21::MylapsReport1 m;
      m.mylaps_speed = to_kmh(timing.speed_mps);
      m.mylaps_heading = timing.heading_deg;
      return encoded(m, state, out);
    }
    default:
      CHECK(false);
  }
  return false;
}

Instant first_due(const RaceFrame& row, Instant now) {
  const std::int64_t steps = (now.ns - row.phase.ns + row.period.ns - 1) / row.period.ns;
  return Instant{} + row.phase + row.period * std::max<std::int64_t>(steps, 0);
}

void begin(const Script& script, State& state, Instant now) {
  const auto earlier = [](const Call& a, const Call& b) { return a.at < b.at; };
  CHECK(std::is_sorted(script.calls.begin(), script.calls.end(), earlier));
  for (std::size_t i = 0; i < kRaceFrames.size(); ++i)
    state.due[i] = first_due(kRaceFrames[i], now);
  state.begun = true;
}

void show(State& state, Instant now) {
  const ShownCall called{state.flags, state.round_target_speed_mph, state.lap};
  if (state.shown == called) return state.waiting_since.reset();
  if (!state.waiting_since) state.waiting_since = now;
  if (now - *state.waiting_since < state.faults.late) return;
  state.waiting_since.reset();
  state.shown = called;
  state.changed = true;
}

}  // namespace

void call(State& state, const Call& call) {
  state.flags.track = call.track.value_or(state.flags.track);
  state.flags.vehicle = call.vehicle.value_or(state.flags.vehicle);
  state.round_target_speed_mph = call.round_target_speed_mph.value_or(state.round_target_speed_mph);
  if (call.lap) state.lap = call.lap;
}

RaceFrames step(const Script& script, State& state, const Timing& timing, Instant now) {
  if (!state.begun) begin(script, state, now);
  while (state.next_call < script.calls.size() && script.calls[state.next_call].at <= now)
    call(state, script.calls[state.next_call++]);

  show(state, now);

  const bool lost = state.faults.heartbeat_stopped || state.faults.silent;
  if (lost && !state.base_lost) state.base_lost_since = now;
  state.base_lost = lost;

  RaceFrames frames;
  for (std::size_t i = 0; i < kRaceFrames.size(); ++i) {
    const RaceFrame& row = kRaceFrames[i];
    const bool due = state.due[i] <= now;
    if (due) state.due[i] += row.period * ((now - state.due[i]) / row.period + 1);
    if (state.faults.silent || !sends(script, row.id)) continue;
    if (!due && !(state.changed && carries_flags(row.id))) continue;
    can::Frame frame;
    if (encode_frame(script, row.id, state, timing, frame, now)) CHECK(frames.push(frame));
  }
  if (!state.faults.silent) state.changed = false;
  return frames;
}

}  // namespace pitwall::race
