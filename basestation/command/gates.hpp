// Gates of a command: conditions that must hold before it is sent, each with its value and age.
//   in     the command, the vehicle state, the base's own fields, alarms, who holds the authority
//   out    one check for each gate that the command has; it passes when all do
//   invariants
//          what is stale or was never heard has not passed. A command that makes the car slower
//          than now passes every gate but those of the way to it: link and authority. Stops have no
//          gate at all and do not come here
//   units  as each gate's text says; ages since the value was true in the car
//   source Saba et al.: the spin (29 degC, 20 mph more, into a corner), the last attempt without
//          fuel; the step and corner figures are ours
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
  kLink,       // packets come, and the car hears us
  kAuthority,  // the console holds it
  kStop,       // no stop is latched
  kFlag,       // the flag that the car acts on allows it
  kTyres,      // warm enough for the speed
  kStep,       // not too much at once
  kCorner,     // neither in nor just before a corner
  kFuel,       // enough for another attempt and home
  kAlarms,     // no high alarm
  kSource,     // race control shows this flag, or a more restrictive one is asked for
  kStanding    // the car stands
};
std::string_view text_of(GateKind kind);
// By a second person with a reason; the way to the car and the latched stop by nobody.
bool can_be_overridden(GateKind kind);

struct Gate {
  GateKind kind = GateKind::kLink;
  bool ok = false;
  double value = kUnset;    // that it was judged by
  std::string_view unit{};  // of the value
  std::string word{};       // of a value that has a name, instead of the number
  Duration age{};
  bool known = false;  // heard, and not stale
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
// "tyres: 29.0 degC, ...; step: ...": those that refuse; empty where all pass.
std::string refusals_of(const std::vector<Gate>& gates);

}  // namespace pitwall::command
