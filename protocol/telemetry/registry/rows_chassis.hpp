// Registry rows of suspension, tyres, engine, electrics and actuator units, from the car's CAN bus.
//   source AV-21 DBC: wheel_potentiometer_data, wheel_strain_gauge (to 8190 N), Tire_Pressure
//          (1 mbar), Tire_Temp (16 sensors across each tyre), pt_report_1 to 3 (temperatures in
//          whole degrees, one byte), misc_report (0.1 V), diagnostic_report, dash_switches; AV-24
//          DBC: steering_report_extd_2, brake_report_extd and _2. A step is the smallest change
//          that a pit wall acts on: 1 degree, 1 kPa, 8 kPa of a hydraulic pressure, 0.4 mm of
//          travel, 1 % of the load on a wheel
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "protocol/telemetry/registry/rows.hpp"

namespace pitwall::telemetry::rows {

constexpr FieldRow travel(std::string_view name) {
  return {Group::kSuspension, name, "mm", 0, 204, 0.4};
}
constexpr FieldRow load(std::string_view name) {
  return {Group::kSuspension, name, "N", 0, 8'128, 32};
}
constexpr FieldRow temperature(Group group, std::string_view name) {
  return {group, name, "degC", -40, 214, 1};  // 8 bits
}
constexpr FieldRow tyre_pressure(std::string_view name) {
  return {Group::kTyres, name, "kPa", 0, 408, 0.8};
}
constexpr FieldRow motor_angle(std::string_view name) {  // at the road wheel; two sensor steps
  return {Group::kSteeringUnit, name, "rad", -0.46, 0.46, 0.0009};
}
constexpr FieldRow position(std::string_view name) {
  return {Group::kBrakes, name, "", 0, 15'000, 60};
}
constexpr FieldRow force(std::string_view name) {
  return {Group::kBrakes, name, "N", 0, 3'000, 12};
}

inline constexpr auto kChassisRows = [] {
  using enum Group;
  return std::to_array<FieldRow>({
      travel("travel_front_left"),
      travel("travel_front_right"),
      travel("travel_rear_left"),
      travel("travel_rear_right"),
      load("load_front_left"),
      load("load_front_right"),
      load("load_rear_left"),
      load("load_rear_right"),

      temperature(kTyres, "temperature_front_left"),
      temperature(kTyres, "temperature_front_right"),
      temperature(kTyres, "temperature_rear_left"),
      temperature(kTyres, "temperature_rear_right"),
      tyre_pressure("pressure_front_left"),
      tyre_pressure("pressure_front_right"),
      tyre_pressure("pressure_rear_left"),
      tyre_pressure("pressure_rear_right"),

      temperature(kTread, "inner_front_left"),
      temperature(kTread, "inner_front_right"),
      temperature(kTread, "inner_rear_left"),
      temperature(kTread, "inner_rear_right"),
      temperature(kTread, "outer_front_left"),
      temperature(kTread, "outer_front_right"),
      temperature(kTread, "outer_rear_left"),
      temperature(kTread, "outer_rear_right"),

      {kEngine, "speed", "rpm", 0, 12'000, 12},
      yes_no(kEngine, "running"),
      {kEngine, "fuel_pressure", "kPa", 0, 1'000, 4},
      {kEngine, "oil_pressure", "kPa", 0, 1'500, 6},
      temperature(kEngine, "coolant"),

      share(kPowertrain, "throttle_position"),
      speed(kPowertrain, "vehicle_speed"),
      {kPowertrain, "torque", "Nm", -2'000, 6'000, 8},
      temperature(kPowertrain, "oil"),
      temperature(kPowertrain, "transmission"),
      {kPowertrain, "transmission_pressure", "kPa", 0, 2'000, 8},
      choice(kPowertrain, "shift_status", kShiftStates, 6),
      {kPowertrain, "traction_aim", "", 0, 14, 1},
      {kPowertrain, "traction_range", "", 0, 14, 1},
      yes_no(kPowertrain, "switch_on"),

      {kFuel, "level", "l", 0, 102, 0.2},
      {kFuel, "used", "l", 0, 102, 0.1},
      {kFuel, "flow", "l/h", 0, 250, 1},
      {kFuel, "laps_left", "", 0, 102, 0.1},

      {kElectric, "battery", "V", 0, 25.4, 0.1},
      {kElectric, "diagnostics", FieldRow::kBitSet, 0, 16'777'214, 1},
      yes_no(kElectric, "mode_switch"),
      {kElectric, "safety_switch", "", 0, 14, 1},  // three bits on the bus, all values legal

      motor_angle("angle_1"),
      motor_angle("angle_2"),
      motor_angle("angle_3"),
      {kSteeringUnit, "current", "A", 0, 128, 0.6},
      {kSteeringUnit, "duty", "", -1, 1, 0.01},
      {kSteeringUnit, "voltage", "V", 0, 25.4, 0.1},
      temperature(kSteeringUnit, "temperature"),
      {kSteeringUnit, "torque", "Nm", 0, 110, 0.5},
      {kSteeringUnit, "error", "", 0, 126, 1},

      position("front_position"),
      position("rear_position"),
      force("front_force"),
      force("rear_force"),
  });
}();

}  // namespace pitwall::telemetry::rows
