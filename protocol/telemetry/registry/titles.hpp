// Titles of fields for operators, in the terms of motorsport, vehicle dynamics and GNSS. They are
// not part of the schema: a title may change without changing the schema hash.
//   in    group and name of a field of the registry, or of one that a base computes (link, derived,
//         base)
//   out   unique words that are understood without the path of the field
//   rule  a field in kTitles has the title there. Any other has the words of its group, those of
//         its name, and the noun that belongs to its number: "tyre temperature front left",
//         "GNSS 0 satellites", "radio loss path 1"
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "protocol/telemetry/registry/registry.hpp"

namespace pitwall::telemetry {

struct FieldTitle {
  std::string_view path, title;
};

// Fields whose group and name are not clear by themselves.
inline constexpr auto kTitles = std::to_array<FieldTitle>({
    {"mode.mode", "car mode"},
    {"mode.ct_state", "CT state"},
    {"mode.sys_state", "system state"},
    {"mode.quiet", "guardian on the bus"},
    {"flags.track", "track flag"},
    {"flags.vehicle", "vehicle flag"},
    {"flags.heartbeat_age", "race control heartbeat age"},
    {"flags.track_acted_on", "track flag acted on"},
    {"flags.vehicle_acted_on", "vehicle flag acted on"},
    {"flags.conflict", "conflict of the flag encodings"},
    {"uplink.authority", "authority known to the car"},
    {"uplink.joystick", "joystick live"},
    {"uplink.link_age", "uplink age"},
    {"ego.x", "position x"},
    {"ego.y", "position y"},
    {"ego.yaw", "yaw angle"},
    {"ego.vx", "speed"},
    {"ego.vy", "lateral speed"},
    {"ego.validity", "pose validity"},
    {"command.steering", "commanded steering angle"},
    {"command.brake", "commanded brake pressure"},
    {"command.actuate", "actuators enabled"},
    {"command.limited", "command slew limited"},
    {"feedback.steering", "steering angle"},
    {"feedback.brake_front", "front brake pressure"},
    {"feedback.brake_rear", "rear brake pressure"},
    {"wheels.standstill", "standstill"},
    {"dynamics.forward", "longitudinal acceleration"},
    {"dynamics.left", "lateral acceleration"},
    {"dynamics.up", "vertical acceleration"},
    {"dynamics.roll", "roll angle"},
    {"dynamics.pitch", "pitch angle"},
    {"dynamics.bank", "track bank angle"},
    {"dynamics.lateral_error", "cross-track error"},
    {"suspension.load_front_left", "wheel load front left"},
    {"suspension.load_front_right", "wheel load front right"},
    {"suspension.load_rear_left", "wheel load rear left"},
    {"suspension.load_rear_right", "wheel load rear right"},
    {"engine.fuel_pressure", "fuel pressure"},
    {"engine.coolant", "coolant temperature"},
    {"powertrain.vehicle_speed", "vehicle speed of the powertrain"},
    {"powertrain.torque", "powertrain torque"},
    {"powertrain.oil", "engine oil temperature"},
    {"powertrain.transmission", "transmission temperature"},
    {"powertrain.traction_aim", "traction control aim"},
    {"powertrain.traction_range", "traction control range"},
    {"powertrain.switch_on", "powertrain switch on"},
    {"fuel.laps_left", "least laps of fuel left, by the car"},
    {"electric.battery", "battery voltage"},
    {"electric.diagnostics", "electric diagnostics"},
    {"steering_unit.duty", "steering motor duty cycle"},
    {"brakes.front_position", "front brake actuator position"},
    {"brakes.rear_position", "rear brake actuator position"},
    {"brakes.front_force", "front brake actuator force"},
    {"brakes.rear_force", "rear brake actuator force"},
    {"localization.sigma_x", "position x standard deviation"},
    {"localization.sigma_y", "position y standard deviation"},
    {"localization.sigma_yaw", "yaw standard deviation"},
    {"localization.sigma_vx", "speed standard deviation"},
    {"localization.sigma_vy", "lateral speed standard deviation"},
    {"localization.sigma_height", "height standard deviation"},
    {"localization.gyro_bias", "gyro bias"},
    {"localization.height", "height over datum"},
    {"localization.position_units", "GNSS units used for position"},
    {"localization.heading_units", "GNSS units used for heading"},
    {"localization.velocity_units", "GNSS units used for velocity"},
    {"localization.imu_units", "IMU units used"},
    {"localization.accepted", "localization samples accepted"},
    {"localization.unsolved", "localization samples without solution"},
    {"localization.uncertain", "localization samples too uncertain"},
    {"localization.late", "localization samples late"},
    {"localization.implausible", "localization samples implausible"},
    {"localization.contradicted", "localization samples contradicted"},
    {"localization.bad_stamps", "localization bad time stamps"},
    {"localization.excluded", "sensors excluded by the operator"},
    {"localization.imu0_verdict", "IMU 0 verdict"},
    {"localization.imu1_verdict", "IMU 1 verdict"},
    {"localization.wheel_verdict", "wheel speed verdict"},
    {"planner.primitive", "planned manoeuvre"},
    {"planner.reason", "reason for the target speed"},
    {"planner.line", "planned line"},
    {"planner.line_offset", "planned line offset"},
    {"planner.target_gap", "target gap"},
    {"planner.stop_distance", "planned stopping distance"},
    {"planner.operator_limit", "speed limit of the operator"},
    {"planner.cost", "plan cost"},
    {"planner.age", "plan age"},
    {"planner.grip_limited", "limited by the tyres"},
    {"planner.missed_shifts", "missed shifts"},
    {"rival.number", "rival's number"},
    {"rival.rank", "rival's rank"},
    {"rival.laps", "rival's laps"},
    {"rival.lap_distance", "rival's distance since the start line"},
    {"rival.speed", "rival's speed"},
    {"computer.step_time_max", "control step time maximum"},
    {"computer.step_time_p50", "control step time median"},
    {"computer.steps", "control steps"},
    {"computer.missed_deadlines", "control deadlines missed"},
    {"computer.processor", "processor load"},
    {"computer.memory", "memory in use"},
    {"faults.now", "active faults"},
    {"faults.now_more", "further active faults"},
    {"faults.last_cause", "last fault"},
    {"faults.last_age", "age of the last fault"},
    {"bus.tx_drops", "CAN transmissions dropped"},
    {"bus.gate_refusals", "CAN frames refused by the gate"},
    {"bus.controller", "CAN controller state"},
    {"bus.identity", "CAN identity check"},
    {"bus.differing_id", "CAN differing identifier"},
    {"bus.database", "CAN database fingerprint"},
    {"radio.base", "base station known to the car"},
    {"radio.rung", "link-loss policy step"},
    {"radio.base_runs", "sessions of the base station"},
    {"radio.heartbeats", "radio packets accepted"},
    {"radio.heartbeats_refused", "radio packets refused"},
    {"radio.threats", "radio threats seen by the car"},
    {"link.down_loss", "downlink loss"},
    {"link.up_loss", "uplink loss"},
    {"link.loss_1s", "downlink loss over 1 s"},
    {"link.loss_30s", "downlink loss over 30 s"},
    {"link.rtt_ms", "link round trip"},
    {"link.down_kbit_s", "downlink rate"},
    {"link.down_cap_kbit_s", "downlink capacity"},
    {"link.up_kbit_s", "uplink rate"},
    {"link.worst_age_ms", "oldest age of the safety groups"},
    {"link.rate_hz", "downlink packet rate"},
    {"link.stale_groups", "stale telemetry groups"},
    {"derived.stop", "stop in force"},
    {"derived.gnss_good", "GNSS receivers good"},
    {"derived.correction_age", "GNSS correction age"},
    {"derived.correction_conflict", "GNSS correction conflict"},
    {"derived.slip_rear_front", "rear slip against front wheels"},
    {"derived.slip_rear_gnss", "rear slip against GNSS"},
    {"derived.slip", "rear wheel slip"},
    {"derived.tyre_min", "coldest tyre temperature"},
    {"derived.tyre_gate", "tyre temperature needed"},
    {"derived.tyre_margin", "tyre temperature margin"},
    {"derived.tyre_pressure_min", "lowest tyre pressure"},
    {"derived.cross_track", "cross-track error magnitude"},
    {"derived.sensor_rate_share", "lowest share of a sensor rate"},
    {"derived.sensor_gap_ms", "longest sensor gap"},
    {"derived.sensor_latency_share", "highest share of a sensor latency"},
    {"derived.race_control_speed", "round speed of race control"},
    {"derived.round_speed_expected", "round speed announced"},
    {"derived.fuel_laps", "laps of fuel left as reckoned"},
    {"derived.fuel_level", "fuel level as reckoned"},
    {"derived.fuel_estimated", "fuel level is an estimate"},
    {"derived.fuel_least", "least fuel level"},
    {"derived.fuel_least_laps", "least laps of fuel left"},
    {"derived.fuel_attempts", "attempts of fuel left"},
    {"derived.corner_in_s", "time to the next corner"},
    {"derived.ghost_x", "ghost position x"},
    {"derived.ghost_y", "ghost position y"},
    {"derived.ghost_yaw", "ghost yaw angle"},
    {"derived.in_pit", "in the pit"},
    {"derived.flag_relayed", "track flag relayed"},
    {"derived.role", "role of race control"},
    {"derived.attempt_laps", "laps of the attempt driven"},
    {"derived.attempt_laps_left", "laps of the attempt left"},
    {"derived.gap_closing", "closing speed"},
    {"base.disk_minutes", "recording time left on disk"},
    {"base.recording", "recording"},
    {"base.recorder_lost", "records lost"},
    {"base.recorder_kbyte_s", "recording rate"},
    {"base.clock_offset_ms", "clock offset of the base station"},
    {"base.joystick_lost", "joystick lost"},
    {"base.authority_lost", "authority lost"},
    {"base.schema_differs", "schema of car and base differs"},
    {"base.settings_unreadable", "settings unreadable"},
});

// Words before and after the name of a group's fields, and the noun for a number at its end.
struct GroupTitle {
  std::string_view group, before, after = {}, counts = {};
};

// For a group that is not here, the name of the group comes before the name of the field.
inline constexpr auto kGroupTitles = std::to_array<GroupTitle>({
    {"mode", ""},
    {"flags", ""},
    {"ego", ""},
    {"track", ""},
    {"command", "commanded"},
    {"feedback", ""},
    {"wheels", "wheel speed"},
    {"dynamics", ""},
    {"tyres", "tyre"},
    {"tread", "tread temperature"},
    {"powertrain", ""},
    {"electric", ""},
    {"steering_unit", "steering motor"},
    {"streams", "", "watchdog"},
    {"sensors", ""},
    {"gnss0", "GNSS 0"},
    {"gnss1", "GNSS 1"},
    {"receivers", "receiver", "", "GNSS"},
    {"bus", "CAN"},
    {"radio", "radio", "", "path"},
    {"stop", "operator stop"},
    {"derived", ""},
});

// Names for which operators use other words.
inline constexpr auto kWords = std::to_array<FieldTitle>({
    {"station", "lap distance"},
    {"offset", "lateral offset"},
    {"identity", "car number"},
    {"age", "detection age"},
    {"sigma", "position standard deviation"},
    {"position_sigma", "position standard deviation"},
    {"height_sigma", "height standard deviation"},
    {"heading_sigma", "heading standard deviation"},
    {"status", "solution status"},
    {"type", "position type"},
    {"silence_ms", "silence"},
    {"jitter_ms", "jitter"},
});

namespace detail {

constexpr std::string_view find_title(std::string_view group, std::string_view name) {
  for (const FieldTitle& row : kTitles) {
    const std::string_view path = row.path;
    if (path.size() == group.size() + 1 + name.size() && path.starts_with(group) &&
        path[group.size()] == '.' && path.ends_with(name))
      return row.title;
  }
  return {};
}

// "gnss0_link" to "GNSS 0 link".
constexpr std::string words_of(std::string_view name) {
  constexpr auto kShort = std::to_array<FieldTitle>(
      {{"gnss0", "GNSS 0"}, {"gnss1", "GNSS 1"}, {"imu0", "IMU 0"}, {"imu1", "IMU 1"}});
  std::string text;
  for (const FieldTitle& row : kShort) {
    if (!name.starts_with(row.path)) continue;
    text = row.title;
    name.remove_prefix(row.path.size());
  }
  for (const char c : name) text += c == '_' ? ' ' : c;
  return text;
}

constexpr void append(std::string& text, std::string_view words) {
  if (words.empty()) return;
  if (!text.empty()) text += ' ';
  text += words;
}

}  // namespace detail

constexpr std::string title_of(std::string_view group, std::string_view name) {
  const std::string_view title = detail::find_title(group, name);
  if (!title.empty()) return std::string{title};
  const auto of_group = std::find_if(kGroupTitles.begin(), kGroupTitles.end(),
                                     [group](const GroupTitle& row) { return row.group == group; });
  const auto word = std::find_if(kWords.begin(), kWords.end(),
                                 [name](const FieldTitle& row) { return row.path == name; });
  const bool known = of_group != kGroupTitles.end();
  std::string text = known ? std::string{of_group->before} : detail::words_of(group);
  if (known && !of_group->counts.empty() && (name.ends_with("_0") || name.ends_with("_1"))) {
    detail::append(text, detail::words_of(name.substr(0, name.size() - 2)));
    detail::append(text, of_group->counts);
    detail::append(text, name.substr(name.size() - 1));
    return text;
  }
  detail::append(text, word != kWords.end() ? std::string{word->title} : detail::words_of(name));
  if (known) detail::append(text, of_group->after);
  return text;
}

static_assert(
    [] {
      for (const FieldTitle& row : kTitles) {
        const std::string_view group = row.path.substr(0, row.path.find('.'));
        if (group == "link" || group == "derived" || group == "base") continue;
        const std::string_view name = row.path.substr(group.size() + 1);
        const bool exists = std::any_of(kFields.begin(), kFields.end(), [&](const FieldRow& field) {
          return row_of(field.group).name == group && field.name == name;
        });
        if (!exists) return false;
      }
      return true;
    }(),
    "a title of a field that the registry does not have");

}  // namespace pitwall::telemetry
