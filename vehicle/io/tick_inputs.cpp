// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/tick_inputs.hpp"

#include <algorithm>
#include <optional>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::io {
namespace {

using recorder::kNever;
using recorder::TickRecord;

enum RequestBit : std::uint8_t {
  kArmBit = 1,
  kResetBit = 2,
  kStopBit = 4,
  kEmergencyBit = 8,
  kMayArmBit = 16,
  kLastRunArmedBit = 32,
  kAllRequestBits = 63
};
enum GuardianBit : std::uint8_t { kDrivesBit = 1, kStoppedBit = 2, kAllGuardianBits = 3 };

std::uint8_t bit_if(bool holds, std::uint8_t bit) { return holds ? bit : std::uint8_t{0}; }
std::int64_t ns_of(const std::optional<Instant>& at) { return at ? at->ns : kNever; }
std::optional<Instant> instant_of(std::int64_t ns) {
  return ns == kNever ? std::nullopt : std::optional{Instant{ns}};
}

std::uint32_t packed(const guardian::CommandCounters& c) {
  return std::uint32_t{c.brake} | std::uint32_t{c.throttle} << 8U |
         std::uint32_t{c.steering} << 16U | std::uint32_t{c.report} << 24U;
}
guardian::CommandCounters unpacked(std::uint32_t bits) {
  const auto byte = [&](unsigned shift) { return static_cast<std::uint8_t>(bits >> shift); };
  return {.brake = byte(0), .throttle = byte(8), .steering = byte(16), .report = byte(24)};
}

void record_operator(const pipeline::Inputs& in, TickRecord& to) {
  to.requests = static_cast<std::uint8_t>(
      bit_if(in.requests.arm, kArmBit) | bit_if(in.requests.reset, kResetBit) |
      bit_if(in.requests.stop, kStopBit) | bit_if(in.requests.emergency_stop, kEmergencyBit) |
      bit_if(in.may_arm, kMayArmBit) | bit_if(in.last_run_armed, kLastRunArmedBit));
  to.operator_speed_limit_mps = in.operator_speed_limit_mps;
  to.stop = static_cast<std::uint8_t>(in.operator_inputs.stop);
  if (const auto& joystick = in.operator_inputs.joystick) {
    to.joystick_at_ns = joystick->at.ns;
    to.joystick_throttle_cap = joystick->throttle_cap;
    to.joystick_brake = joystick->brake;
  }
  for (const world::OperatorCommand& command : in.commands) {
    CHECK(append(to, {.id = command.id,
                      .kind = static_cast<std::uint8_t>(command.kind),
                      .argument = command.argument,
                      .expires_ns = command.expires.ns}));
  }
  to.radio_at_ns = ns_of(in.radio_at);
}

void record_link(const world::LinkObservation& link, TickRecord& to) {
  to.controller = static_cast<std::uint8_t>(link.controller);
  to.lost_in_socket = link.lost_in_socket;
  to.lost_in_interface = link.lost_in_interface;
  to.error_frames = link.error_frames;
  to.tx_drops = link.tx_drops;
  to.restarts = link.restarts;
  to.tx_stalled_ns = link.tx_stalled.ns;
  to.bus_load = link.load;
}

void record_guardian(const pipeline::GuardianView& guardian, TickRecord& to) {
  to.guardian = static_cast<std::uint8_t>(bit_if(guardian.drives, kDrivesBit) |
                                          bit_if(guardian.stopped, kStoppedBit));
  to.drove_from_ns = guardian.drove_from.ns;
  to.drove_until_ns = guardian.drove_until.ns;
  to.guardian_counters = packed(guardian.counters);
  to.guardian_at_ns = guardian.command.at.ns;
  to.guardian_road_wheel_rad = guardian.command.road_wheel_rad;
  to.guardian_throttle = guardian.command.throttle_fraction;
  to.guardian_brake_kpa = guardian.command.brake_kpa;
  to.guardian_gear = guardian.command.gear;
}

std::optional<Problem> out_of_range(const TickRecord& record) {
  using world::ControllerState;
  if ((record.requests & ~unsigned{kAllRequestBits}) != 0)
    return Problem{"requests", "unknown bit"};
  if ((record.guardian & ~unsigned{kAllGuardianBits}) != 0)
    return Problem{"guardian", "unknown bit"};
  if (record.stop > static_cast<std::uint8_t>(world::StopRequest::kEmergency))
    return Problem{"stop", "unknown request"};
  if (record.controller > static_cast<std::uint8_t>(ControllerState::kDown))
    return Problem{"controller", "unknown state"};
  return std::nullopt;
}

Result<bool, Problem> restore_commands(const TickRecord& record, TickCommands& to) {
  const auto kept = recorder::commands_of(record);
  if (!kept) return Unexpected{Problem{"commands", "the list is cut short or too long"}};
  for (const recorder::TickCommand& command : *kept) {
    if (command.kind > static_cast<std::uint8_t>(world::OperatorCommandKind::kSendParameters))
      return Unexpected{Problem{"commands", "unknown kind"}};
    CHECK(to.list.push({.id = command.id,
                        .kind = static_cast<world::OperatorCommandKind>(command.kind),
                        .argument = command.argument,
                        .expires = Instant{command.expires_ns}}));
  }
  return true;
}

world::OperatorInputs operator_of(const TickRecord& record) {
  world::OperatorInputs out{.stop = static_cast<world::StopRequest>(record.stop), .joystick = {}};
  if (record.joystick_at_ns == kNever) return out;
  out.joystick = world::Joystick{.throttle_cap = record.joystick_throttle_cap,
                                 .brake = record.joystick_brake,
                                 .at = Instant{record.joystick_at_ns}};
  return out;
}

world::LinkObservation link_of(const TickRecord& record) {
  return {.controller = static_cast<world::ControllerState>(record.controller),
          .lost_in_socket = record.lost_in_socket,
          .lost_in_interface = record.lost_in_interface,
          .error_frames = record.error_frames,
          .tx_drops = record.tx_drops,
          .restarts = record.restarts,
          .tx_stalled = Duration{record.tx_stalled_ns},
          .load = record.bus_load};
}

pipeline::GuardianView guardian_of(const TickRecord& record) {
  return {.drives = (record.guardian & kDrivesBit) != 0,
          .stopped = (record.guardian & kStoppedBit) != 0,
          .drove_from = Instant{record.drove_from_ns},
          .drove_until = Instant{record.drove_until_ns},
          .counters = unpacked(record.guardian_counters),
          .command = {.at = Instant{record.guardian_at_ns},
                      .road_wheel_rad = record.guardian_road_wheel_rad,
                      .throttle_fraction = record.guardian_throttle,
                      .brake_kpa = record.guardian_brake_kpa,
                      .gear = record.guardian_gear}};
}

}  // namespace

TickRecord record_of(const pipeline::Inputs& in, const TickCounts& counts) {
  TickRecord to;
  to.number = counts.number;
  to.dt_ns = in.dt.ns;
  to.frames_received = static_cast<std::uint32_t>(in.can.size());
  to.frames_sent = static_cast<std::uint32_t>(counts.frames_sent);
  to.receiver_bytes = static_cast<std::uint32_t>(counts.receiver_bytes);
  record_operator(in, to);
  to.gnss0_byte_at_ns = ns_of(in.gnss_byte_at[0]);
  to.gnss1_byte_at_ns = ns_of(in.gnss_byte_at[1]);
  record_link(in.link, to);
  record_guardian(in.guardian, to);
  to.processor_share = in.computer.processor_share;
  to.memory_mib = in.computer.memory_mib;
  to.temperature_c = in.computer.temperature_c;
  return to;
}

Result<pipeline::Inputs, Problem> inputs_of(const TickRecord& record, Instant now,
                                            std::span<const can::ReceivedFrame> can,
                                            const world::SensorInput& sensors,
                                            TickCommands& commands) {
  if (const auto problem = out_of_range(record)) return Unexpected{*problem};
  if (const auto restored = restore_commands(record, commands); !restored)
    return Unexpected{restored.error()};
  return pipeline::Inputs{
      .now = now,
      .dt = Duration{record.dt_ns},
      .can = can,
      .sensors = sensors,
      .requests = {.arm = (record.requests & kArmBit) != 0,
                   .reset = (record.requests & kResetBit) != 0,
                   .stop = (record.requests & kStopBit) != 0,
                   .emergency_stop = (record.requests & kEmergencyBit) != 0},
      .operator_speed_limit_mps = record.operator_speed_limit_mps,
      .operator_inputs = operator_of(record),
      .commands = commands.list.span(),
      .may_arm = (record.requests & kMayArmBit) != 0,
      .gnss_byte_at = {instant_of(record.gnss0_byte_at_ns), instant_of(record.gnss1_byte_at_ns)},
      .link = link_of(record),
      .radio_at = instant_of(record.radio_at_ns),
      .guardian = guardian_of(record),
      .computer = {record.processor_share, record.memory_mib, record.temperature_c},
      .last_run_armed = (record.requests & kLastRunArmedBit) != 0};
}

}  // namespace pitwall::io
