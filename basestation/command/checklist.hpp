// Checklist before a run: each item with its value, its age, and go or no-go.
//   in     the vehicle state, the base's own fields, alarms; who holds the authority; how the
//          settings are kept; what the joystick does
//   out    one check for each item, always all of them and in this order
//   invariants
//          what is stale or was never heard is no-go. Nothing here sends anything or holds anything
//          back: people decide, and gates stand before each command
//   units  ages since the value was true where it was measured
//   source Saba et al.: the RTK login that two teams used, cold tyres, the round that was begun
//          without the fuel for it
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
  kLink,         // packets come, and few are lost
  kSoftware,     // both ends read each other's packets alike
  kClocks,       // the base's clock is near UTC
  kDisk,         // it records, and has room
  kSettings,     // limits and alarms are those of the file
  kAuthority,    // somebody can command the car
  kJoystick,     // nobody's hand is on it
  kCorrections,  // they come, by a login that nobody else uses
  kTyres,        // with air; their temperatures are known
  kFuel,         // an attempt and the way home
  kStop,         // none is latched
  kAlarms        // no high one
};
inline constexpr std::size_t kChecks = 12;
std::string_view text_of(CheckKind kind);

struct Check {
  CheckKind kind = CheckKind::kLink;
  bool go = false;
  bool known = false;  // heard, and not stale
  Duration age{};
  std::string text;  // "14.9 laps, 6 attempts"
};

// Of the file of limits and alarms.
struct SettingsState {
  std::string version;   // as consoles show it
  bool kept = false;     // there is a file for changes
  bool readable = true;  // and it was understood
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
