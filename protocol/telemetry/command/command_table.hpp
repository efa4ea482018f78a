// Table of all commands of a base. Commands are absolute ("120 km/h", never "10 faster" or
// "toggle"), so that a command that is repeated, late or out of order does no harm.
//   wire   see command_record.hpp; arguments quantised as in their row
//   invariants
//          commands of one type replace each other: a newer one supersedes those not yet applied
//   units  as in each row
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "protocol/bits/quantized.hpp"
#include "protocol/telemetry/registry/labels.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::telemetry {

enum class CommandType : std::uint8_t {
  kArm,              // 0 disarm, 1 arm
  kReset,            // 1: the operator acknowledges a stop that has ended
  kSpeedLimit,       // m/s; the car never drives faster
  kRaceLine,         // number of the line
  kRole,             // 0 none, 1 defender, 2 attacker
  kTrackFlag,        // as telemetry labels kTrackFlags; the most restrictive of all sources applies
  kSensorsExcluded,  // bit set of the sensors that the car does not use; 0: it uses all
  kFuelEntered,      // litres in the tank, as an operator says
  kReleaseStop,      // argument: the car's challenge; see stop_latch.hpp
  kEndRun,           // 1: the car ends its run where it stands
  kSendParameters    // 1: as bulk
};
inline constexpr std::size_t kCommandTypes = 11;

struct CommandRow {
  CommandType type;
  std::string_view name;
  std::string_view unit;
  double min, max, resolution;
  Duration time_to_live;  // not applied later than this after the command was issued
  bool needs_authority;
  // Names of the values 0, 1, 2 ..., or of the bits of a bit set. "-": a value without a meaning.
  std::string_view labels = {};
  bool offered = true;  // at least one car executes it

  static constexpr std::string_view kBitSet = "bits", kNoValue = "-";

  constexpr bool is_set() const { return unit == kBitSet; }
  // True for a valid argument: in the range, and named if the values have names.
  constexpr bool has(double argument) const {
    if (!(argument >= min && argument <= max)) return false;
    if (labels.empty()) return true;
    const auto whole = static_cast<std::size_t>(argument);
    if (static_cast<double>(whole) != argument) return false;
    if (is_set()) return whole < std::size_t{1} << label_count(labels);
    const std::string_view value = label_at(labels, whole);
    return !value.empty() && value != kNoValue;
  }

  constexpr bits::Quantized quantized() const { return {min, max, resolution}; }
};

inline constexpr auto kCommandTable = [] {
  using enum CommandType;
  return std::to_array<CommandRow>({
      {kArm, "arm", "", 0, 2, 1, seconds(2), true, "disarm|arm"},
      {kReset, "reset", "", 0, 2, 1, seconds(2), true, "-|reset"},
      {kSpeedLimit, "speed limit", "m/s", 0, 120, 0.1, seconds(2), true},
      {kRaceLine, "race line", "", 0, 30, 1, seconds(2), true, {}, false},
      {kRole, "role", "", 0, 6, 1, seconds(2), true, kRoles, false},
      {kTrackFlag, "track flag", "", 0, 14, 1, seconds(2), true, kShownTrackFlags},
      {kSensorsExcluded, "sensors excluded", CommandRow::kBitSet, 0, 1'022, 1, seconds(2), true,
       kExcludableNames},
      {kFuelEntered, "fuel entered", "l", 0, 120, 0.1, seconds(2), true},
      {kReleaseStop, "release stop", "", 0, 65'534, 1, seconds(2), true},
      {kEndRun, "end run", "", 0, 2, 1, seconds(2), true, "-|end"},
      {kSendParameters, "send parameters", "", 0, 2, 1, seconds(5), false, "-|send", false},
  });
}();
static_assert(kCommandTable.size() == kCommandTypes);
static_assert([] {
  for (std::size_t i = 0; i < kCommandTypes; ++i) {
    if (static_cast<std::size_t>(kCommandTable[i].type) != i) return false;
    if (kCommandTable[i].quantized().bits() > 16) return false;  // argument of a CommandRecord
  }
  return true;
}());

constexpr const CommandRow& row_of(CommandType type) {
  return kCommandTable[static_cast<std::size_t>(type)];
}

using CommandId = std::uint32_t;  // ascending within one run of the base, from 1
using HolderId = std::uint8_t;    // a console that can hold the authority: 1 .. 254; 0: none

struct Command {
  CommandType type = CommandType::kArm;
  double argument = kUnset;
  HolderId issuer = 0;  // the console that issued it
};

// Result of a command, from the car. All except kReceived are final.
enum class Outcome : std::uint8_t {
  kReceived,  // received by the car, no answer of its consumer yet
  kApplied,
  kRefused,      // the consumer did not accept it in its present state
  kUnsupported,  // this car has no such function
  kExpired,      // received, or due to be applied, after its time to live
  kSuperseded,   // a newer one of its type came first
  kNoAuthority,  // the console that issued it did not hold the authority
  kOtherRun      // meant for a previous run of the car
};
inline constexpr std::size_t kOutcomes = 8;
constexpr bool is_final(Outcome outcome) { return outcome != Outcome::kReceived; }
std::string_view text_of(Outcome outcome);

}  // namespace pitwall::telemetry
