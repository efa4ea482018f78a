// Every command that a base may give. Commands are absolute: "120 km/h", never "10 faster" nor
// "toggle", so that one which comes twice, late or out of order does no harm.
//   wire   see command_record.hpp; arguments quantised as their row says
//   invariants
//          commands of one slot replace each other: a newer one supersedes what was not applied
//   units  as each row has it
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
  kReset,            // 1: a stop that has ended is acknowledged by the operator
  kSpeedLimit,       // m/s; the car never drives faster
  kRaceLine,         // number of the line
  kRole,             // 0 none, 1 defender, 2 attacker
  kTrackFlag,        // as telemetry labels kTrackFlags; the most restrictive of all sources holds
  kSensorsExcluded,  // a set of bits: which sensors the car does not believe; 0: uses all
  kReleaseStop,      // argument: the car's challenge; see stop_latch.hpp
  kEndRun,           // 1: the car ends its run where it stands
  kSendParameters    // 1: as bulk
};
inline constexpr std::size_t kCommandTypes = 10;

struct CommandRow {
  CommandType type;
  std::string_view name;
  std::string_view unit;
  double min, max, resolution;
  Duration time_to_live;  // not applied later than this after it was given
  bool needs_authority;
  // Of the values 0, 1, 2 ...; of a bit set: of the bits. "-": a value that means nothing.
  std::string_view labels = {};
  bool offered = true;  // some car carries it out

  static constexpr std::string_view kBitSet = "bits", kNoValue = "-";

  constexpr bool is_set() const { return unit == kBitSet; }
  // An argument that means something: in the range, and named where the values have names.
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
      {kSensorsExcluded, "sensors excluded", CommandRow::kBitSet, 0, 62, 1, seconds(2), true,
       kExcludableNames},
      {kReleaseStop, "release stop", "", 0, 65'534, 1, seconds(2), true},
      {kEndRun, "end run", "", 0, 2, 1, seconds(2), true, "-|end"},
      {kSendParameters, "send parameters", "", 0, 2, 1, seconds(5), false, "-|send", false},
  });
}();
static_assert(kCommandTable.size() == kCommandTypes);
static_assert([] {
  for (std::size_t i = 0; i < kCommandTypes; ++i) {
    if (static_cast<std::size_t>(kCommandTable[i].type) != i) return false;
    if (kCommandTable[i].quantized().bits() > 16) return false;  // as command_record.hpp has it
  }
  return true;
}());

constexpr const CommandRow& row_of(CommandType type) {
  return kCommandTable[static_cast<std::size_t>(type)];
}

using CommandId = std::uint32_t;  // rises within one run of the base, from 1
using HolderId = std::uint8_t;    // a console that may hold the authority: 1 .. 254; 0: nobody

struct Command {
  CommandType type = CommandType::kArm;
  double argument = kUnset;
  HolderId issuer = 0;  // the console that gave it
};

// What became of it, as the car says. All but kReceived are final.
enum class Outcome : std::uint8_t {
  kReceived,  // known to the car, its consumer has not answered
  kApplied,
  kRefused,      // the consumer did not accept it in its present state
  kUnsupported,  // this car has no such thing
  kExpired,      // came, or was to be applied, after its time
  kSuperseded,   // a newer one of its type came first
  kNoAuthority,  // the console that gave it did not hold the authority
  kOtherRun      // meant for the run of the car before this one
};
inline constexpr std::size_t kOutcomes = 8;
constexpr bool is_final(Outcome outcome) { return outcome != Outcome::kReceived; }
std::string_view text_of(Outcome outcome);

}  // namespace pitwall::telemetry
