// Checklist before a run: each item with its value, its age, and go or no-go.
//   in     the vehicle state, the base's own fields, alarms; the holder of the authority; how the
//          settings are stored; the state of the joystick
//   out    one check for each item, always all of them and in this order
//   invariants
//          a value that is stale or was never received is no-go. The checklist sends nothing and
//          blocks nothing: people decide, and gates check each command
//   units  ages since the value was measured
//   source Saba et al.: the RTK login that two teams used, cold tyres, the round that was begun
//          without enough fuel
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "basestation/alarms/evaluator.hpp"
#include "protocol/telemetry/command/command_table.hpp"

namespace pitwall::command {

enum class CheckKind : std::uint8_t {
  kLink,         // packets arrive, and few are lost
  kSoftware,     // car and base use the same packet schema
  kClocks,       // the base's clock is near UTC
  kDisk,         // the recorder runs, and the disk has room
  kSettings,     // limits and alarms are those of the file
  kAuthority,    // a console holds the authority
  kJoystick,     // nobody uses it
  kCorrections,  // they arrive, through a login that nobody else uses
  kTyres,        // inflated; their temperatures are known
  kFuel,         // enough for an attempt and the lap into the pits
  kStop,         // no stop is latched
  kAlarms        // no high alarm
};
inline constexpr std::size_t kChecks = 12;
std::string_view text_of(CheckKind kind);

struct Check {
  CheckKind kind = CheckKind::kLink;
  bool go = false;
  bool known = false;  // received, and not stale
  Duration age{};
  std::string text;  // "14.9 laps, 6 attempts"
};

// State of the file of limits and alarms.
struct SettingsState {
  std::string version;   // as consoles show it
  bool kept = false;     // a file stores changes
  bool readable = true;  // the file was read without error
};
enum class JoystickState : std::uint8_t { kNone, kReleased, kInUse, kLost };

struct CheckInputs {
  const state::VehicleState& vehicle;
  const alarms::Evaluator& evaluator;
  telemetry::HolderId holder = 0;  // of the authority, now
  std::string holder_name{};
  SettingsState settings{};
  JoystickState joystick = JoystickState::kNone;
  Instant now{};
};

std::vector<Check> checks_of(const CheckInputs& inputs);
bool all_go(const std::vector<Check>& checks);

}  // namespace pitwall::command
