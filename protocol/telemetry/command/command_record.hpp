// Payloads of records for a command, its result, and the acknowledgement of the result.
//   wire   little endian
//          kCommand           number u32, run of the base u32, boot of the car that it is meant for
//                             u32, type u8, argument u16 (step of its row), age u16 (ms, when the
//                             packet is sent), console u8
//          kCommandResult     number u32, run of the base u32, outcome u8
//          kCommandResultAck  number u32, run of the base u32
//   invariants
//          the age is rounded up and saturates, so that a command never seems younger than it is
//   errors nullopt for bytes that the writer cannot produce. A type unknown to this build is no
//          error, so that it can be answered
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/telemetry/command/command_table.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr std::size_t kCommandSize = 18, kResultSize = 9, kResultAckSize = 8;

// Greeting::boot as in records: 32 bits, mixed from all 64.
constexpr std::uint32_t short_boot(std::uint64_t boot) {
  return static_cast<std::uint32_t>(boot ^ boot >> 32U);
}

struct CommandRecord {
  CommandId number = 0;
  std::uint32_t base_run = 0, car_boot = 0;
  std::uint8_t type = 0;  // CommandType, or one of a later build
  std::uint16_t step = 0;
  Duration age{};
  HolderId issuer = 0;

  bool known() const { return type < kCommandTypes; }
  Command command() const;  // known() only
};
std::array<std::uint8_t, kCommandSize> to_bytes(const CommandRecord& record);
std::optional<CommandRecord> parse_command(std::span<const std::uint8_t> payload);

struct ResultRecord {
  CommandId number = 0;
  std::uint32_t base_run = 0;
  Outcome outcome = Outcome::kReceived;
};
std::array<std::uint8_t, kResultSize> to_bytes(const ResultRecord& record);
std::optional<ResultRecord> parse_result(std::span<const std::uint8_t> payload);

struct ResultAckRecord {
  CommandId number = 0;
  std::uint32_t base_run = 0;
};
std::array<std::uint8_t, kResultAckSize> to_bytes(const ResultAckRecord& record);
std::optional<ResultAckRecord> parse_result_ack(std::span<const std::uint8_t> payload);

}  // namespace pitwall::telemetry
