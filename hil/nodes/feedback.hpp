// Inputs (Feedback) and outputs (Demand) of the drive-by-wire model. The bench connects both to its
// plant; this folder does not depend on a plant.
//   units  SI, kPa, C; angles at the steering motor, left positive; per wheel FL FR RL RR
//   errors NaN means "not given": the report with this value is not sent, and that is counted
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::drive_by_wire {

struct Feedback {
  std::array<double, 4> wheel_speed_mps{kUnset, kUnset, kUnset, kUnset};
  double vehicle_speed_mps = kUnset;
  double brake_front_kpa = kUnset, brake_rear_kpa = kUnset;
  double throttle_fraction = kUnset;
  double steering_motor_rad = kUnset;
  double engine_speed_rpm = kUnset;
  bool engine_running = false;
  std::uint8_t gear = 0;               // 0 neutral
  std::uint8_t gear_shift_status = 1;  // 0 uninitialised, 1 ready, 2 locked out, 3 up, 4 down
  double wheel_torque_nm = 0.0;        // before the gearbox, in pt_report_3

  // Defaults of a healthy car, for a plant that does not model these.
  std::array<double, 4> tyre_temperature_c{60.0, 60.0, 60.0, 60.0};
  std::array<double, 4> tyre_pressure_kpa{150.0, 150.0, 150.0, 150.0};  // gauge
  std::array<double, 4> wheel_load_n{2000.0, 2000.0, 2000.0, 2000.0};
  std::array<double, 4> damper_mm{20.0, 20.0, 20.0, 20.0};
  double fuel_pressure_kpa = 400.0;  // falls when the tank runs dry
  double oil_pressure_kpa = 450.0, oil_temperature_c = 95.0;
  double coolant_c = 85.0;
  double transmission_c = 80.0, transmission_pressure_kpa = 300.0;
  double battery_v = 13.2;
};

struct Demand {
  double steering_motor_rad = 0.0;
  double throttle_fraction = 0.0;                      // 0..1
  double brake_front_kpa = 0.0, brake_rear_kpa = 0.0;  // >= 0
  std::uint8_t gear = 0;
  bool crank = false;      // starter motor turns
  bool engine_on = false;  // ignition and fuel: a turning engine runs
};

}  // namespace pitwall::drive_by_wire
