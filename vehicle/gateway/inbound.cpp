// SPDX-License-Identifier: Apache-2.0
#include "vehicle/gateway/inbound.hpp"

#include <cmath>

#include "protocol/can/manifest.hpp"
#include "protocol/vocabulary/check.hpp"
#include "vehicle/gateway/flag_tables.hpp"
#include "vehicle/gateway/readings.hpp"

namespace pitwall::gateway {
namespace {

using can::av21::kMessages;
constexpr std::size_t kNoRow = kMessages.size();

std::size_t row_index(std::uint32_t id) {
  std::size_t low = 0, high = kMessages.size();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (kMessages[middle].id < id)
      low = middle + 1;
    else
      high = middle;
  }
  return low < kMessages.size() && kMessages[low].id == id ? low : kNoRow;
}

using world::Monitor;

// The verdict of the monitor; true if the frame may be read.
bool admit(world::FrameRefusals& refused, can::FrameVerdict verdict) {
  switch (verdict) {
    case can::FrameVerdict::kGood:
      return true;
    case can::FrameVerdict::kStuckCounter:
      ++refused.stuck_counter;
      break;
    case can::FrameVerdict::kJumpedCounter:
      ++refused.jumped_counter;
      break;
    case can::FrameVerdict::kWrongChecksum:
      ++refused.wrong_checksum;
      break;
  }
  return false;
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

// What is refused, or would be: nothing where its monitor is off.
bool refuses(const InboundParams& params, InboundState& state, Monitor monitor) {
  if (params.off.has(monitor)) return false;
  state.seen.add(monitor);
  return true;
}

bool has_length(const InboundParams& params, InboundState& state, const can::MessageRow& row,
                const can::Frame& frame) {
  if (frame.length == row.length || !refuses(params, state, Monitor::kFrameShape)) return true;
  ++state.refused.wrong_length;
  return false;
}

// Rules 5 to 7. A debt that rises is a bad frame, whether it is refused yet or not.
bool is_alive(const InboundParams& params, InboundState& state, const can::MessageRow& row,
              can::MessageMonitor& monitor, const can::ReceivedFrame& received) {
  can::MessageRow rules_of = row;
  if (params.off.has(Monitor::kChecksum)) rules_of.protection = {};
  const can::MonitorRules rules{.fault_debt = params.fault_debt,
                                .use_counter = row.safety != can::SafetyClass::kRaceControl &&
                                               !params.off.has(Monitor::kCounter)};
  const std::uint8_t before = monitor.debt;
  const can::FrameVerdict verdict = can::judge(rules_of, rules, monitor, received, state.losses);
  const bool is_whole = verdict != can::FrameVerdict::kWrongChecksum;
  if (!is_whole)
    state.seen.add(Monitor::kChecksum);
  else if (verdict != can::FrameVerdict::kGood || monitor.debt > before)
    state.seen.add(Monitor::kCounter);
  return admit(state.refused, verdict);
}

can::ReceivedFrame with_length(const can::ReceivedFrame& received, std::uint8_t length) {
  can::ReceivedFrame whole = received;
  whole.frame.length = length;
  whole.frame.extended = whole.frame.remote = whole.frame.fd = false;
  return whole;
}

// A frame of a message of the car: rules 4 to 9.
bool accept(const InboundParams& params, InboundState& state, std::size_t index,
            const can::MessageRow& row, const can::ReceivedFrame& received) {
  if (!has_length(params, state, row, received.frame)) return false;
  const can::ReceivedFrame whole = with_length(received, row.length);
  if (!is_alive(params, state, row, state.monitors[index], whole)) return false;
  const Reading reading = apply(params, state, whole);
  tally(state, reading);
  if (reading != Reading::kApplied) state.seen.add(Monitor::kDecodedRange);
  return reading == Reading::kApplied;
}

// Among the rows that the bench gives; as many as there are: none of them.
std::size_t also_index(const InboundParams& params, std::uint32_t id) {
  std::size_t i = 0;
  while (i < params.also.size() && params.also[i].id != id) ++i;
  return i;
}

// Of a message beside the database.
void receive_also(const InboundParams& params, InboundState& state, std::size_t also,
                  const can::ReceivedFrame& received) {
  const can::MessageRow& row = params.also[also];
  if (!has_length(params, state, row, received.frame)) return;
  const can::ReceivedFrame whole = with_length(received, row.length);
  if (is_alive(params, state, row, state.also[also], whole)) ++state.frames_applied;
}

void receive_own(const InboundParams& params, InboundState& state, Instant at) {
  ++state.own_frames;
  if (state.guardian_control.covers(at) || !refuses(params, state, Monitor::kOwnId)) return;
  state.own_id_seen = true;
}

void receive(const InboundParams& params, InboundState& state, const can::ReceivedFrame& received) {
  const can::Frame& frame = received.frame;
  state.last_frame = received.at;
  state.load.add(received);
  if ((frame.extended || frame.remote || frame.fd) &&
      refuses(params, state, Monitor::kFrameShape)) {
    ++state.refused.remote_or_error;
    return;
  }
  const std::size_t index = row_index(frame.id), also = also_index(params, frame.id);
  const bool has_row = also < params.also.size();
  if (index == kNoRow && has_row) return receive_also(params, state, also, received);
  if (index == kNoRow) {
    refuses(params, state, Monitor::kFrameShape);
    ++state.refused.unknown_id;
    return;
  }
  const can::MessageRow& row = has_row ? params.also[also] : kMessages[index];
  if (row.direction == can::Direction::kToCar) return receive_own(params, state, received.at);
  MessageTrack& track = state.messages[index];
  if (!accept(params, state, index, row, received)) {
    ++track.refused;
    return;
  }
  track.last = received.at;
  track.ever = true;
}

void watch_ages(const InboundParams& params, InboundState& state, Instant now) {
  if (params.off.has(Monitor::kMessageAge)) return;
  bool late = state.losses.count > 0;
  for (std::size_t i = 0; i < kMessages.size() && !late; ++i) {
    if (kMessages[i].direction != can::Direction::kFromCar) continue;
    const world::Liveness life = liveness(kMessages[i], state.messages[i], now);
    late = life == world::Liveness::kLate || life == world::Liveness::kLost;
  }
  if (late) state.seen.add(Monitor::kMessageAge);
}

void watch_frozen(const InboundParams& params, InboundState& state, Instant now) {
  if (params.off.has(Monitor::kFrozenSignal)) return;
  judge_frozen(state.frozen, state.signals, now);
  if (state.frozen.any()) state.seen.add(Monitor::kFrozenSignal);
}

// Whether two sources ask different things. Each has its own way to say one and the same: a stop is
// a red track in one encoding and a vehicle flag in the other.
bool contradict(const FlagSource& a, const FlagSource& b) {
  using world::TrackFlag;
  using world::VehicleFlag;
  const auto has_flags = [](const FlagSource& s) {
    return s.received && (s.track != TrackFlag::kNone || s.vehicle != VehicleFlag::kNone);
  };
  const auto role = [](VehicleFlag flag) {
    return flag == VehicleFlag::kAttacker || flag == VehicleFlag::kDefender;
  };
  if (!has_flags(a) || !has_flags(b)) return false;
  const world::FlagDemand demand = world::demand_of(a.track, a.vehicle);
  if (demand != world::demand_of(b.track, b.vehicle)) return true;
  const bool waves = (a.track == TrackFlag::kWavingGreen) != (b.track == TrackFlag::kWavingGreen);
  const bool roles = role(a.vehicle) && role(b.vehicle) && a.vehicle != b.vehicle;
  return (demand == world::FlagDemand::kRace && waves) || roles;
}

// Silence of the other source never lifts its flag, and "none" of it is no statement: it can make
// the car slower only.
world::RaceControl merge(const FlagSource& main, const FlagSource& other,
                         world::FlagEncoding encoding, std::uint8_t lap_count) {
  using world::TrackFlag;
  using world::VehicleFlag;
  world::RaceControl rc;
  rc.track = other.track == TrackFlag::kNone ? main.track
                                             : world::more_restrictive(main.track, other.track);
  rc.vehicle = other.vehicle == VehicleFlag::kNone
                   ? main.vehicle
                   : world::more_restrictive(main.vehicle, other.vehicle);
  rc.round_target_speed_mps = std::fmin(main.round_target_speed_mps, other.round_target_speed_mps);
  rc.raw_track = main.raw_track;
  rc.raw_vehicle = main.raw_vehicle;
  rc.raw_sector = main.raw_sector;
  rc.encoding = encoding;
  rc.ever_received = main.received;
  rc.last_heartbeat_change = main.last_change;
  rc.lap_count = lap_count;
  rc.other_raw_track = other.raw_track;
  rc.other_raw_vehicle = other.raw_vehicle;
  rc.other_raw_sector = other.raw_sector;
  rc.conflict = contradict(main, other);
  return rc;
}

world::LossReport report_of(const can::LossReport& loss) {
  return {.id = loss.id,
          .detector = loss.sign == can::LossSign::kCounter ? world::LossDetector::kCounter
                                                           : world::LossDetector::kPeriod,
          .frames = loss.frames,
          .due = loss.due,
          .noticed = loss.noticed};
}

world::BusHealth health(const InboundState& state, Instant now) {
  world::BusHealth bus;
  bus.frames_applied = state.frames_applied;
  bus.refused = state.refused;
  bus.last_frame = state.last_frame;
  for (std::size_t i = 0; i < kMessages.size(); ++i) {
    if (kMessages[i].direction != can::Direction::kFromCar) continue;
    const MessageTrack& track = state.messages[i];
    const can::MessageMonitor& monitor = state.monitors[i];
    const bool listed = bus.messages.push({.id = kMessages[i].id,
                                           .liveness = liveness(kMessages[i], track, now),
                                           .debt = monitor.debt,
                                           .lost = monitor.lost,
                                           .late = monitor.late,
                                           .bad = track.refused,
                                           .mean_interval = monitor.mean_interval,
                                           .last = track.last});
    CHECK(listed);
    bus.frames_lost += monitor.lost;
  }
  static_assert(can::LossLog::kMax == decltype(bus.losses)::capacity());
  for (const can::LossReport& loss : state.losses.listed()) CHECK(bus.losses.push(report_of(loss)));
  bus.losses_unlisted = state.losses.unlisted;
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
  CHECK(params.also.size() <= kAlsoMax);
  state.losses.clear();
  state.seen = {};
  for (const can::ReceivedFrame& received : frames) receive(params, state, received);
  can::watch(kMessages, state.monitors, now, state.losses);
  can::watch(params.also, std::span{state.also}.first(params.also.size()), now, state.losses);
  watch_ages(params, state, now);
  watch_frozen(params, state, now);
  const bool mylaps = params.flag_encoding == world::FlagEncoding::kMyLaps;
  const FlagSource& main = mylaps ? state.mylaps : state.marelli;
  const FlagSource& other = mylaps ? state.marelli : state.mylaps;
  return {.signals = state.signals,
          .race_control = merge(main, other, params.flag_encoding, state.mylaps.lap_count),
          .bus = health(state, now),
          .own_frames = state.own_frames,
          .own_id_seen = state.own_id_seen,
          .seen = state.seen};
}

void store_command(InboundState& state, const world::ActuatorCommand& command, bool reported,
                   Instant now) {
  store(state.frozen, command, reported, now);
}

void observe_link(InboundState& state, world::BusHealth& bus, const world::LinkObservation& link,
                  Instant now) {
  const auto report = [&](world::LossDetector detector, std::uint64_t before, std::uint64_t lost) {
    if (lost <= before) return;
    const world::LossReport loss{
        .detector = detector, .frames = static_cast<std::uint32_t>(lost - before), .noticed = now};
    if (!bus.losses.push(loss)) bus.losses_unlisted = ++state.losses.unlisted;
  };
  report(world::LossDetector::kSocketQueue, state.link.lost_in_socket, link.lost_in_socket);
  report(world::LossDetector::kInterface, state.link.lost_in_interface, link.lost_in_interface);
  state.link = bus.link = link;
  bus.link.load = state.load.share(now);
}

}  // namespace pitwall::gateway
