// Registry rows of Class::kSafety, which every packet carries in both directions: each bit of them
// is sent fifty times per second.
//   source states and flags: AV-21 DBC, misc_report, ct_report, base_to_car_summary; its heartbeat
//          is lost after 10 s; stop, joystick and authority: protocol/telemetry/command
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "protocol/telemetry/registry/labels.hpp"
#include "protocol/telemetry/registry/rows.hpp"

namespace pitwall::telemetry::rows {

inline constexpr auto kSafetyDown = [] {
  using enum Group;
  return std::to_array<FieldRow>({
      choice(kMode, "mode", kModes, 6),
      choice(kMode, "ct_state", kCtStates, 255),
      choice(kMode, "sys_state", kSysStates, 255),
      choice(kMode, "first_stop_cause", kStopCauses, 126),
      choice(kMode, "arming", kArmings, 14),
      choice(kMode, "stop_latch", kStopLevels, 2),
      {kMode, "stop_challenge", "", 0, 65'534, 1},  // number that a release must name; 0: no latch
      yes_no(kMode, "quiet"),                       // the guardian sends on the bus

      choice(kFlags, "track", kTrackFlags, 14),
      choice(kFlags, "vehicle", kVehicleFlags, 14),
      {kFlags, "round_target_speed", "m/s", 0, 102, 0.1},  // AV-21: whole mph, one byte
      {kFlags, "heartbeat_age", "s", 0, 50, 0.05},
      choice(kFlags, "track_acted_on", kTrackFlags, 14),  // the flag that the plan follows
      choice(kFlags, "vehicle_acted_on", kVehicleFlags, 14),
      yes_no(kFlags, "conflict"),  // the two encodings of race control disagree

      choice(kUplink, "stop_reason", kStopReasons, 14),
      {kUplink, "authority", "", 0, 254, 1},  // its holder according to the car
      yes_no(kUplink, "joystick"),            // its samples are live
      share(kUplink, "throttle_cap"),
      {kUplink, "link_age", "s", 0, 5.1, 0.005},  // since the newest authentic packet of the base
      yes_no(kUplink, "schema_agrees"),           // if not, the car refuses to arm
  });
}();

inline constexpr auto kSafetyUp = [] {
  using enum Group;
  return std::to_array<FieldRow>({
      choice(kStop, "level", kStopLevels, 2),
      {kStop, "epoch", "", 0, 253, 1},
      choice(kStop, "reason", kStopReasons, 14),

      yes_no(kJoystick, "active"),
      {kJoystick, "sample", "", 0, 65'533, 1},
      {kJoystick, "sample_age", "ms", 0, 1'000, 1},
      {kJoystick, "throttle_cap", "", 0, 1, 0.005},
      {kJoystick, "brake", "", 0, 1, 0.005},

      {kAuthority, "holder", "", 0, 254, 1},
      {kAuthority, "epoch", "", 0, 65'533, 1},
      {kAuthority, "renewal", "", 0, 65'533, 1},
      {kAuthority, "renewal_age", "ms", 0, 4'000, 20},
  });
}();

}  // namespace pitwall::telemetry::rows
