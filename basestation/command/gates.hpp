// Gates of a command: conditions that must hold before it is sent, each with its value and age.
//   in     the command, the vehicle state, the base's own fields, alarms, the holder of the
//          authority
//   out    one check for each gate of the command; the command passes when all gates do
//   invariants
//          a value that is stale or was never received does not pass. A command that makes the car
//          slower than now has only the gates of link and authority. Stops have no gate and are
//          not checked here
//   units  as each gate's text says; ages since the value was measured in the car
//   source Saba et al.: the spin (29 degC, 20 mph more, into a corner), the last attempt without
//          fuel; the limits of step and corner are our own
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "basestation/alarms/evaluator.hpp"
#include "protocol/telemetry/command/command_table.hpp"

namespace pitwall::command {

enum class GateKind : std::uint8_t {
  kLink,       // packets arrive in both directions
  kAuthority,  // the console holds it
  kStop,       // no stop is latched
  kFlag,       // the flag that the car acts on allows it
  kTyres,      // warm enough for the speed
  kStep,       // the speed limit rises by a small enough step
  kCorner,     // neither in nor just before a corner
  kFuel,       // enough for another attempt and the lap into the pits
  kAlarms,     // no high alarm
  kSource,     // race control shows this flag, or the command asks for a more restrictive one
  kStanding    // the car stands
};
std::string_view text_of(GateKind kind);
// By a reason, and a second person where required; link, authority and stop can never be.
bool can_be_overridden(GateKind kind);

struct Gate {
  GateKind kind = GateKind::kLink;
  bool ok = false;
  double value = kUnset;    // that the gate judged
  std::string_view unit{};  // of the value
  std::string word{};       // label of the value, if it has one, instead of the number
  Duration age{};
  bool known = false;  // received, and not stale
  std::string text;    // "29 degC, 66 degC needed for 62 m/s"
};

struct GateParams {
  double step_max_mps = 5.0;
  Duration corner_ahead = seconds(3);
  double caution_speed_mps = 22.0;  // under yellow
  double standing_mps = 0.5;
};

struct GateInputs {
  const state::VehicleState& vehicle;
  const alarms::Evaluator& evaluator;
  telemetry::HolderId holder = 0;  // of the authority, now
  Instant now{};
};

std::vector<Gate> gates_of(const telemetry::Command& command, const GateParams& params,
                           const GateInputs& inputs);
bool all_pass(const std::vector<Gate>& gates);
// "tyres: 29.0 degC, ...; step: ...": the gates that refuse; empty if all pass.
std::string refusals_of(const std::vector<Gate>& gates);

}  // namespace pitwall::command
