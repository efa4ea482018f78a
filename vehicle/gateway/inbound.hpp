// CAN frames in, what the car and race control say out, in SI units. Nothing is applied that is not
// whitelisted, complete, alive and plausible; every frame that is not applied is counted by kind.
//   in     frames in the order of arrival, each with its instant
//   out    the latest accepted value of every signal; the flags of race control; the health of
//          every expected message
//   units  SI (m/s, rad at the steering motor, kPa, degrees Celsius, fractions of 1)
//   errors none: a bad frame is a count in BusHealth::refused
//   cost   no allocation; O(frames)
//
// Rules, in this order, per frame
//   1 remote, FD or extended                  -> remote_or_error
//   2 not in the database                     -> unknown_id
//   3 an id that we alone may send            -> own_frames, and own_id_seen latches (our socket
//                                                does not deliver our own frames: another node
//                                                speaks with our voice)
//   4 length differs from the database        -> wrong_length
//   5 checksum, where the message has one     -> wrong_checksum
//   6 counter equal to the last one received  -> stuck_counter
//   7 counter, while the leaky bucket over bad counters and checksums is at fault_debt
//                                             -> jumped_counter. What is a jump and what a wrap, a
//                                                restart or a loss: can::MessageMonitor
//   8 a number that is not finite, or outside the plausible range of the parameters
//                                             -> not_finite, out_of_range
//   9 a change faster than the database's side file allows since the last accepted value, in the
//     time that passed (at least one period)  -> implausible_slew. The allowance grows with time:
//                                                a wrong first value cannot lock out the truth
// The counters of race-control messages are not looked at (6, 7): to refuse a flag could hide a
// stop. Their heartbeat is watched for change instead (RaceControl::last_heartbeat_change).
//
// Law: every frame is applied, refused by one kind, or an own frame; each is counted once.
// Losses are those of can::MessageMonitor, for every message that was heard at least once; a frame
// that is refused by rules 5 to 9 came and is not lost. A frame that comes after it was reported is
// taken out of frames_lost again, its report stands.
//
// Monitors: kMessageAge sees a message that is late or a loss that is noticed, kCounter, kChecksum,
// kFrameShape (rules 1, 2, 4), kOwnId (rule 3) and kDecodedRange (8, 9) what their rules refuse in
// this tick, kFrozenSignal what frozen_signal.hpp says. What a monitor that is off would refuse
// passes: a frame of a wrong length is read as if it were whole.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <type_traits>

#include "protocol/can/av21.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/can/message_monitor.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/gateway/bus_load.hpp"
#include "vehicle/gateway/frozen_signal.hpp"
#include "vehicle/world/actuator_command.hpp"
#include "vehicle/world/bus_health.hpp"
#include "vehicle/world/monitor.hpp"
#include "vehicle/world/race_control.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::gateway {

struct Span {
  double min = kUnset, max = kUnset;  // both included
};

struct InboundParams {
  world::FlagEncoding flag_encoding = world::FlagEncoding::kMyLaps;  // the authoritative one
  std::uint8_t degraded_debt = 3;          // shown as degraded; [1, fault_debt)
  std::uint8_t fault_debt = 5;             // no longer applied; [2, 100]
  Span wheel_speed_mps{0.0, 120.0};        // within [0, 150]
  Span brake_kpa{0.0, 8000.0};             // within [0, 8191]
  Span throttle_fraction{0.0, 1.05};       // within [0, 2]
  Span steering_motor_deg{-300.0, 300.0};  // within [-512, 511.5]
  Span engine_speed_rpm{0.0, 12000.0};     // within [0, 16000]
  Span battery_v{0.0, 20.0};               // within [0, 25.5]
  Span tyre_temperature_c{-40.0, 250.0};   // within [-100, 6453]
  Span tyre_pressure_kpa{-50.0, 500.0};    // gauge; within [-100, 6553]
  std::uint8_t gear_max = 6;               // [1, 8]
  // Of the bench alone, no car file sets them: monitors that are switched off; messages that are
  // judged by these rows in rules 4 to 7. Those beside the database mean nothing.
  world::MonitorSet off{};
  std::span<const can::MessageRow> also{};  // at most kAlsoMax, in the order of their ids
};

// What became of the frames of one expected message.
struct MessageTrack {
  Instant last{};  // last applied
  bool ever = false;
  std::uint32_t refused = 0;
};

// The last accepted value of a signal whose rate of change is limited.
struct SlewTrack {
  double value = kUnset;
  Instant at{};
};

// What one encoding said last.
struct FlagSource {
  bool received = false;
  std::uint8_t raw_track = 0, raw_vehicle = 0, raw_sector = 0;
  world::TrackFlag track = world::TrackFlag::kNone;
  world::VehicleFlag vehicle = world::VehicleFlag::kNone;
  double round_target_speed_mps = kUnset;
  Instant last_change{};       // of the heartbeat
  std::uint8_t heartbeat = 0;  // MyLaps only
  std::uint8_t lap_count = 0;  // MyLaps only
};

// When the guardian spoke for the car: commands heard then are not another node's.
struct StandIn {
  Instant from{}, until{};  // both included; equal: never

  constexpr bool covers(Instant at) const { return from < until && from <= at && at <= until; }
};

inline constexpr std::size_t kTyreSensors = 16;
inline constexpr std::size_t kAlsoMax = 16;

struct InboundState {
  std::array<MessageTrack, can::av21::kMessages.size()> messages{};
  std::array<can::MessageMonitor, can::av21::kMessages.size()> monitors{};
  can::LossLog losses;          // of this tick
  world::LinkObservation link;  // of the tick before
  std::array<SlewTrack, can::av21::kSlews.size()> slews{};
  std::array<std::array<double, kTyreSensors>, world::kCorners> tyre_sensor_c{};
  std::array<std::uint8_t, world::kCorners> tyre_messages_received{};  // one bit for each of the 4
  world::VehicleSignals signals;
  FlagSource mylaps, marelli;
  world::FrameRefusals refused;
  std::uint64_t frames_applied = 0;
  std::uint64_t own_frames = 0;
  bool own_id_seen = false;  // latched
  StandIn stand_in;          // told by the pipeline
  Instant last_frame{};
  std::array<can::MessageMonitor, kAlsoMax> also{};
  BusLoad load;
  FrozenState frozen;
  world::MonitorSet seen{};  // in this tick
};
static_assert(std::is_trivially_copyable_v<InboundState>);

struct InboundOutput {
  world::VehicleSignals signals;
  world::RaceControl race_control;  // the more restrictive of both encodings, conflict marked
  world::BusHealth bus;
  std::uint64_t own_frames = 0;  // frames with an id of ours from somebody else
  bool own_id_seen = false;
  world::MonitorSet seen{};  // monitors that see something wrong now
};

InboundOutput decode(const InboundParams& params, InboundState& state,
                     std::span<const can::ReceivedFrame> frames, Instant now);

// What the actuators were told last, in the tick before, if anything: what they report has to move
// with it. Before decode().
void store_command(InboundState& state, const world::ActuatorCommand& command, bool reported,
                   Instant now);

// What the rim sees of the interface; frames that it lost since the tick before become reports
// without an identifier. After decode() of the same tick.
void observe_link(InboundState& state, world::BusHealth& bus, const world::LinkObservation& link,
                  Instant now);

// kLate after 2.5 periods, kLost after the timeout of the database's side file.
world::Liveness liveness(const can::MessageRow& row, const MessageTrack& track, Instant now);

}  // namespace pitwall::gateway
