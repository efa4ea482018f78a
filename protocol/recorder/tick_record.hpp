// Inputs of one tick of the car that are not recorded as bytes or frames; with them a run can be
// replayed. It is the message /car/tick of the black box, after all traffic of the tick.
//
//   file  ... bytes of receivers, datagrams, received frames, sent frames, TICK, states ...
//
//   units  seconds, m/s, fractions as their names say; instants: nanoseconds on the car's clock,
//          kNever if there is none; log time: that of the tick
//   errors commands_of() returns nullopt for cut commands
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <type_traits>

#include "protocol/recording/cdr_struct.hpp"
#include "protocol/vocabulary/bytes.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::recorder {

inline constexpr const char* kTickTopic = "/car/tick";
inline constexpr std::int64_t kNever = INT64_MIN;

struct TickCommand {
  std::uint32_t id = 0;
  std::uint8_t kind = 0;
  double argument = kUnset;
  std::int64_t expires_ns = kNever;
};
inline constexpr std::size_t kTickCommandBytes = 21, kTickCommandsMax = 16;

struct TickRecord {
  std::uint64_t number = 0;  // tick number of the run, from 0
  std::int64_t dt_ns = 0;
  std::uint32_t frames_received = 0, frames_sent = 0, receiver_bytes = 0;
  std::uint8_t requests = 0;  // bits: arm, reset, stop, emergency stop, may arm, last run armed
  double operator_speed_limit_mps = kUnset;
  std::uint8_t stop = 0;
  std::int64_t joystick_at_ns = kNever;
  double joystick_throttle_cap = kUnset, joystick_brake = kUnset;
  recording::CdrBytes<kTickCommandBytes * kTickCommandsMax> commands;
  std::int64_t gnss0_byte_at_ns = kNever, gnss1_byte_at_ns = kNever, radio_at_ns = kNever;
  std::uint8_t controller = 0;
  std::uint64_t lost_in_socket = 0, lost_in_interface = 0, error_frames = 0, tx_drops = 0;
  std::uint64_t restarts = 0;
  std::int64_t tx_stalled_ns = 0;
  double bus_load = 0.0;
  std::uint8_t guardian = 0;  // bits: drives, stopped
  std::int64_t drove_from_ns = 0, drove_until_ns = 0;
  std::uint32_t guardian_counters = 0;  // brake, throttle, steering, report; one byte each
  std::int64_t guardian_at_ns = 0;
  double guardian_road_wheel_rad = kUnset, guardian_throttle = kUnset, guardian_brake_kpa = kUnset;
  std::uint8_t guardian_gear = 0;
  double processor_share = kUnset, memory_mib = kUnset, temperature_c = kUnset;
};
constexpr recording::CdrName cdr_name(std::type_identity<TickRecord>) { return "CarTick"; }
constexpr auto cdr_fields(std::type_identity<TickRecord>) {
  using recording::CdrField;
  using T = TickRecord;
  return std::tuple{CdrField{"number", &T::number},
                    CdrField{"dt_ns", &T::dt_ns},
                    CdrField{"frames_heard", &T::frames_received},
                    CdrField{"frames_said", &T::frames_sent},
                    CdrField{"receiver_bytes", &T::receiver_bytes},
                    CdrField{"requests", &T::requests},
                    CdrField{"operator_speed_limit_mps", &T::operator_speed_limit_mps},
                    CdrField{"stop", &T::stop},
                    CdrField{"joystick_at_ns", &T::joystick_at_ns},
                    CdrField{"joystick_throttle_cap", &T::joystick_throttle_cap},
                    CdrField{"joystick_brake", &T::joystick_brake},
                    CdrField{"commands", &T::commands},
                    CdrField{"gnss0_byte_at_ns", &T::gnss0_byte_at_ns},
                    CdrField{"gnss1_byte_at_ns", &T::gnss1_byte_at_ns},
                    CdrField{"radio_at_ns", &T::radio_at_ns},
                    CdrField{"controller", &T::controller},
                    CdrField{"lost_in_socket", &T::lost_in_socket},
                    CdrField{"lost_in_interface", &T::lost_in_interface},
                    CdrField{"error_frames", &T::error_frames},
                    CdrField{"tx_drops", &T::tx_drops},
                    CdrField{"restarts", &T::restarts},
                    CdrField{"tx_stalled_ns", &T::tx_stalled_ns},
                    CdrField{"bus_load", &T::bus_load},
                    CdrField{"guardian", &T::guardian},
                    CdrField{"drove_from_ns", &T::drove_from_ns},
                    CdrField{"drove_until_ns", &T::drove_until_ns},
                    CdrField{"guardian_counters", &T::guardian_counters},
                    CdrField{"guardian_at_ns", &T::guardian_at_ns},
                    CdrField{"guardian_road_wheel_rad", &T::guardian_road_wheel_rad},
                    CdrField{"guardian_throttle", &T::guardian_throttle},
                    CdrField{"guardian_brake_kpa", &T::guardian_brake_kpa},
                    CdrField{"guardian_gear", &T::guardian_gear},
                    CdrField{"processor_share", &T::processor_share},
                    CdrField{"memory_mib", &T::memory_mib},
                    CdrField{"temperature_c", &T::temperature_c}};
}
using TickBytes = std::array<std::uint8_t, recording::cdr_bytes_max<TickRecord>()>;

// False if there is no room for another command.
inline bool append(TickRecord& tick, const TickCommand& command) {
  const auto put = [&](std::uint64_t bits, unsigned bytes) {
    for (unsigned i = 0; i < bytes; ++i)
      if (!tick.commands.push(static_cast<std::uint8_t>(bits >> (8 * i)))) return false;
    return true;
  };
  return put(command.id, 4) && put(command.kind, 1) &&
         put(std::bit_cast<std::uint64_t>(command.argument), 8) &&
         put(static_cast<std::uint64_t>(command.expires_ns), 8);
}

inline std::optional<FixedVector<TickCommand, kTickCommandsMax>> commands_of(
    const TickRecord& tick) {
  FixedVector<TickCommand, kTickCommandsMax> commands;
  std::span<const std::uint8_t> rest = tick.commands.span();
  if (rest.size() % kTickCommandBytes != 0) return std::nullopt;
  const auto get = [&](std::size_t bytes) {
    const std::uint64_t bits = load(rest.first(bytes));
    rest = rest.subspan(bytes);
    return bits;
  };
  while (!rest.empty()) {
    TickCommand command;
    command.id = static_cast<std::uint32_t>(get(4));
    command.kind = static_cast<std::uint8_t>(get(1));
    command.argument = std::bit_cast<double>(get(8));
    command.expires_ns = static_cast<std::int64_t>(get(8));
    if (!commands.push(command)) return std::nullopt;
  }
  return commands;
}

}  // namespace pitwall::recorder
