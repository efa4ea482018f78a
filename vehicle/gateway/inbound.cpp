// SPDX-License-Identifier: Apache-2.0
#include "vehicle/gateway/inbound.hpp"

#include <cmath>
#include <cstring>

#include "protocol/can/manifest.hpp"
#include "protocol/vocabulary/check.hpp"
#include "vehicle/gateway/flag_tables.hpp"
#include "vehicle/gateway/readings.hpp"

namespace pitwall::gateway {
namespace {

using can::av21::kMessages;
constexpr std::size_t kNotFound = kMessages.size();

std::size_t row_index(std::uint32_t id) {
  std::size_t low = 0, high = kMessages.size();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (kMessages[middle].id < id)
      low = middle + 1;
    else
      high = middle;
  }
  return low < kMessages.size() && kMessages[low].id == id ? low : kNotFound;
}

std::uint8_t counter_of(const can::MessageRow& row, const can::Frame& frame) {
  constexpr unsigned kBitsPerByte = 8;
  std::uint64_t raw = 0;
  std::memcpy(&raw, frame.data.data(), sizeof raw);  // Intel order, as the host
  const unsigned shift = row.counter_start;
  const std::uint64_t mask = (1ull << row.counter_bits) - 1;
  static_assert(sizeof(raw) == kBitsPerByte);
  return static_cast<std::uint8_t>((raw >> shift) & mask);
}

enum class CounterVerdict : std::uint8_t { kGood, kStuck, kJumped };

CounterVerdict count(const InboundParams& params, const can::MessageRow& row, MessageTrack& track,
                     std::uint8_t counter) {
  const std::uint8_t before = track.counter;
  const bool known = track.counter_known;
  track.counter = counter;
  track.counter_known = true;
  if (!known) return CounterVerdict::kGood;
  const auto wrap = static_cast<std::uint8_t>((1u << row.counter_bits) - 1u);
  const bool stuck = counter == before;
  const bool next = counter == ((before + 1u) & wrap) || counter == 0;
  const auto debt_max = static_cast<std::uint8_t>(2 * params.fault_debt);  // bounds the recovery
  if (stuck || !next) {
    if (track.debt < debt_max) ++track.debt;
  } else if (track.debt > 0) {
    --track.debt;
  }
  if (stuck) return CounterVerdict::kStuck;
  return track.debt >= params.fault_debt ? CounterVerdict::kJumped : CounterVerdict::kGood;
}

void tally(InboundState& state, Reading reading) {
  switch (reading) {
    case Reading::kNotFinite:
      ++state.refused.not_finite;
      return;
    case Reading::kOutOfRange:
      ++state.refused.out_of_range;
      return;
    case Reading::kImplausibleSlew:
      ++state.refused.implausible_slew;
      return;
    case Reading::kApplied:
      ++state.frames_applied;
      return;
  }
}

void receive(const InboundParams& params, InboundState& state, const can::ReceivedFrame& received) {
  const can::Frame& frame = received.frame;
  state.last_frame = received.at;
  if (frame.extended || frame.remote || frame.fd) {
    ++state.refused.remote_or_error;
    return;
  }
  const std::size_t index = row_index(frame.id);
  if (index == kNotFound) {
    ++state.refused.unknown_id;
    return;
  }
  const can::MessageRow& row = kMessages[index];
  if (row.direction == can::Direction::kToCar) {
    ++state.own_frames;
    state.own_id_seen = true;
    return;
  }
  if (frame.length != row.length) {
    ++state.refused.wrong_length;
    return;
  }
  MessageTrack& track = state.messages[index];
  if (row.has_counter && row.safety != can::SafetyClass::kRaceControl) {
    const CounterVerdict verdict = count(params, row, track, counter_of(row, frame));
    if (verdict == CounterVerdict::kStuck) {
      ++state.refused.stuck_counter;
      return;
    }
    if (verdict == CounterVerdict::kJumped) {
      ++state.refused.jumped_counter;
      return;
    }
  }
  const Reading reading = apply(params, state, received);
  tally(state, reading);
  if (reading != Reading::kApplied) return;
  track.last = received.at;
  track.ever = true;
}

// Silence of the other source never lifts its flag, and "none" of it is no statement: it can make
// the car slower only.
world::RaceControl merge(const FlagSource& main, const FlagSource& other,
                         world::FlagEncoding encoding, std::uint8_t lap_count) {
  using world::TrackFlag;
  using world::VehicleFlag;
  world::RaceControl rc;
  rc.track =
      other.track == TrackFlag::kNone ? main.track : more_restrictive(main.track, other.track);
  rc.vehicle = other.vehicle == VehicleFlag::kNone ? main.vehicle
                                                   : more_restrictive(main.vehicle, other.vehicle);
  rc.round_target_speed_mps = std::fmin(main.round_target_speed_mps, other.round_target_speed_mps);
  rc.raw_track = main.raw_track;
  rc.raw_vehicle = main.raw_vehicle;
  rc.raw_sector = main.raw_sector;
  rc.encoding = encoding;
  rc.ever_heard = main.heard;
  rc.last_heartbeat_change = main.last_change;
  rc.lap_count = lap_count;
  rc.other_raw_track = other.raw_track;
  rc.other_raw_vehicle = other.raw_vehicle;
  rc.other_raw_sector = other.raw_sector;
  const auto differ = [](auto a, auto b, auto none) { return a != none && b != none && a != b; };
  rc.conflict = main.heard && other.heard &&
                (differ(main.track, other.track, TrackFlag::kNone) ||
                 differ(main.vehicle, other.vehicle, VehicleFlag::kNone));
  return rc;
}

world::BusHealth health(const InboundState& state, Instant now) {
  world::BusHealth bus;
  bus.frames_applied = state.frames_applied;
  bus.refused = state.refused;
  bus.last_frame = state.last_frame;
  for (std::size_t i = 0; i < kMessages.size(); ++i) {
    if (kMessages[i].direction != can::Direction::kFromCar) continue;
    const MessageTrack& track = state.messages[i];
    const bool listed = bus.messages.push({.id = kMessages[i].id,
                                           .liveness = liveness(kMessages[i], track, now),
                                           .debt = track.debt,
                                           .last = track.last});
    CHECK(listed);
  }
  return bus;
}

}  // namespace

world::Liveness liveness(const can::MessageRow& row, const MessageTrack& track, Instant now) {
  if (!track.ever) return world::Liveness::kNever;
  const Duration age = now - track.last;
  if (age > row.timeout) return world::Liveness::kLost;
  const Duration late = row.period * 5 / 2;  // 2.5 periods
  return age > late ? world::Liveness::kLate : world::Liveness::kAlive;
}

InboundOutput decode(const InboundParams& params, InboundState& state,
                     std::span<const can::ReceivedFrame> frames, Instant now) {
  for (const can::ReceivedFrame& received : frames) receive(params, state, received);
  const bool mylaps = params.flag_encoding == world::FlagEncoding::kMyLaps;
  const FlagSource& main = mylaps ? state.mylaps : state.marelli;
  const FlagSource& other = mylaps ? state.marelli : state.mylaps;
  return {.signals = state.signals,
          .race_control = merge(main, other, params.flag_encoding, state.mylaps.lap_count),
          .bus = health(state, now),
          .own_frames = state.own_frames,
          .own_id_seen = state.own_id_seen};
}

}  // namespace pitwall::gateway
