// Decoder of the CAN frames from the car and from race control into SI signals. Only frames that
// are whitelisted, complete, alive and plausible are applied; every other frame is counted by kind.
//   in     frames in the order of arrival, each with its instant
//   out    the latest accepted value of every signal; the flags of race control; the health of
//          every expected message
//   units  SI (m/s, rad at the steering motor, kPa, degrees Celsius, fractions of 1)
//   errors none: a bad frame is counted in BusHealth::refused
//   cost   no allocation; O(frames)
//
// Rules per frame, in this order
//   1 remote, FD or extended                  -> remote_or_error
//   2 not in the database                     -> unknown_id
//   3 an identifier that only we may send     -> own_frames, and own_id_seen latches (our socket
//                                                does not deliver our own frames, so another node
//                                                sends them)
//   4 length differs from the database        -> wrong_length
//   5 checksum, if the message has one        -> wrong_checksum
//   6 counter equal to the last one received  -> stuck_counter
//   7 counter, while the leaky bucket over bad counters and checksums is at fault_debt
//                                             -> jumped_counter. can::MessageMonitor distinguishes
//                                                a jump from a wrap, a restart and a loss
//   8 a number that is not finite, or outside the plausible range of the parameters
//                                             -> not_finite, out_of_range
//   9 a change since the last accepted value that is faster than the database's side file allows
//     for the time passed (at least one period)
//                                             -> implausible_slew. The allowance grows with time,
//                                                so that a wrong first value cannot lock out the
//                                                right ones
// The counters of race-control messages are not checked (6, 7), because a refused flag could hide a
// stop. Instead their heartbeat must change (RaceControl::last_heartbeat_change).
//
// Invariant: every frame is applied, refused by one kind, or an own frame; each is counted once.
// Losses are those of can::MessageMonitor, for every message that was received at least once. A
// frame that rules 5 to 9 refuse did arrive and is not lost. A frame that arrives after it was
// reported as lost is subtracted from frames_lost; the report stays.
//
// Monitors: kMessageAge reports a late message or a detected loss; kCounter, kChecksum, kFrameShape
// (rules 1, 2, 4), kOwnId (rule 3) and kDecodedRange (8, 9) report refusals of their rules in this
// tick; kFrozenSignal those of frozen_signal.hpp. With a monitor disabled, the frames that it would
// refuse pass: a frame of a wrong length is then read as if it were whole.
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
#include "vehicle/world/health.hpp"
#include "vehicle/world/monitor.hpp"
#include "vehicle/world/race_control.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::gateway {

struct Span {
  double min = kUnset, max = kUnset;  // both included
};

struct InboundParams {
  world::FlagEncoding flag_encoding = world::FlagEncoding::kMyLaps;  // the authoritative one
  std::uint8_t degraded_debt = 3;          // reported as degraded; [1, fault_debt)
  std::uint8_t fault_debt = 5;             // frames are refused; [2, 100]
  Span wheel_speed_mps{0.0, 120.0};        // within [0, 150]
  Span brake_kpa{0.0, 8000.0};             // within [0, 8191]
  Span throttle_fraction{0.0, 1.05};       // within [0, 2]
  Span steering_motor_deg{-300.0, 300.0};  // within [-512, 511.5]
  Span engine_speed_rpm{0.0, 12000.0};     // within [0, 16000]
  Span battery_v{0.0, 20.0};               // within [0, 25.5]
  Span tyre_temperature_c{-40.0, 250.0};   // within [-100, 6453]
  Span tyre_pressure_kpa{-50.0, 500.0};    // gauge; within [-100, 6553]
  std::uint8_t gear_max = 6;               // [1, 8]
  // Set by the bench only, not by a car file: disabled monitors; and messages to which rules 4 to 7
  // apply with these rows. Messages that are not in the database have no signals.
  world::MonitorSet off{};
  std::span<const can::MessageRow> also{};  // at most kAlsoMax, in the order of identifiers
};

// Counts of the frames of one expected message.
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

// Last flags of one encoding.
struct FlagSource {
  bool received = false;
  std::uint8_t raw_track = 0, raw_vehicle = 0, raw_sector = 0;
  world::TrackFlag track = world::TrackFlag::kNone;
  world::VehicleFlag vehicle = world::VehicleFlag::kNone;
  double round_target_speed_mps = kUnset;
  Instant last_change{};       // last change of the heartbeat
  std::uint8_t heartbeat = 0;  // MyLaps only
  std::uint8_t lap_count = 0;  // MyLaps only
};

// Period in which the guardian drove the car: commands received then are not from an unknown node.
struct GuardianControl {
  Instant from{}, until{};  // both included; equal: never

  constexpr bool covers(Instant at) const { return from < until && from <= at && at <= until; }
};

inline constexpr std::size_t kTyreSensors = 16;
inline constexpr std::size_t kAlsoMax = 16;

struct InboundState {
  std::array<MessageTrack, can::av21::kMessages.size()> messages{};
  std::array<can::MessageMonitor, can::av21::kMessages.size()> monitors{};
  can::LossLog losses;          // in this tick
  world::LinkObservation link;  // at the previous tick
  std::array<SlewTrack, can::av21::kSlews.size()> slews{};
  std::array<std::array<double, kTyreSensors>, world::kCorners> tyre_sensor_c{};
  std::array<std::uint8_t, world::kCorners> tyre_messages_received{};  // one bit per message
  world::VehicleSignals signals;
  FlagSource mylaps, marelli;
  world::FrameRefusals refused;
  std::uint64_t frames_applied = 0;
  std::uint64_t own_frames = 0;
  bool own_id_seen = false;          // latched
  GuardianControl guardian_control;  // set by the pipeline
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
  std::uint64_t own_frames = 0;  // frames with our identifiers from another node
  bool own_id_seen = false;
  world::MonitorSet seen{};  // monitors with a finding in this tick
};

InboundOutput decode(const InboundParams& params, InboundState& state,
                     std::span<const can::ReceivedFrame> frames, Instant now);

// Stores the last command of the previous tick, if any, for the detection of frozen feedback. To be
// called before decode().
void store_command(InboundState& state, const world::ActuatorCommand& command, bool reported,
                   Instant now);

// Adds the link observation of the interface; frames that it lost since the previous tick become
// reports without an identifier. To be called after decode() of the same tick.
void observe_link(InboundState& state, world::BusHealth& bus, const world::LinkObservation& link,
                  Instant now);

// kLate after 2.5 periods, kLost after the timeout of the database's side file.
world::Liveness liveness(const can::MessageRow& row, const MessageTrack& track, Instant now);

}  // namespace pitwall::gateway
