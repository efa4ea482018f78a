// Signals of the car from the CAN bus, in SI units, each with the instant of its reception. Only
// gateway/inbound fills them; a value that was never received is NaN with received == false.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::world {

template <class T>
struct Received {
  T value{};
  Instant at{};
  bool received = false;

  constexpr bool fresh(Instant now, Duration limit) const { return received && now - at <= limit; }
};

enum class Corner : std::uint8_t { kFrontLeft, kFrontRight, kRearLeft, kRearRight };
inline constexpr std::size_t kCorners = 4;

// One number per wheel, indexed by Corner.
struct PerWheel {
  std::array<double, kCorners> at{kUnset, kUnset, kUnset, kUnset};

  constexpr double& operator[](Corner c) { return at[static_cast<std::size_t>(c)]; }
  constexpr double operator[](Corner c) const { return at[static_cast<std::size_t>(c)]; }
};

struct BrakePressure {
  double front_kpa = kUnset, rear_kpa = kUnset;
};

// State of the drive-by-wire computer (Raptor), CAN misc_report.sys_state.
enum class SysState : std::uint8_t {
  kUnknown = 0,
  kPowerOn = 1,
  kSubsystemsConnected = 2,
  kActuatorTesting = 3,
  kActuatorTestDone = 4,
  kCrankReady = 5,
  kPreCrankCheck = 6,
  kCranking = 7,
  kEngineRunning = 8,
  kDriving = 9,
  kShutEngine = 10,
  kPowerOff = 11,
  kRaptorOff = 12,
  kCrankCheckInit = 13,
  kActuatorTestFailed = 14,
  kCrankChecksFailed = 15,
  kEmergencyShutdown = 16,
  kEngineFailedToStart = 17,
  kCriticalLimitsExceeded = 18,
  kStandby = 19,
  kDefault = 255
};

struct Powertrain {
  double throttle_fraction = kUnset;  // 0..1
  double engine_speed_rpm = kUnset;
  double vehicle_speed_mps = kUnset;
  std::uint8_t gear = 0;  // 0 neutral
  bool engine_running = false;
  bool engine_switch_on = false;
  std::uint8_t gear_shift_status = 0;  // 0 uninitialised, 1 ready, 2 locked out, 3 up, 4 down
};

struct EngineHealth {
  double fuel_pressure_kpa = kUnset, oil_pressure_kpa = kUnset, coolant_c = kUnset;
  double transmission_c = kUnset, transmission_pressure_kpa = kUnset;
};

// CAN diagnostic_report: true is a fault. safety/causes.hpp lists those that stop the car; the
// warnings and low_engine_speed are only reported.
struct DriveByWireDiagnostics {
  bool system_warning = false, system_failure = false;
  std::array<bool, 3> brake_warning{}, steer_warning{};
  std::uint8_t motec_warning = 0;
  bool front_brake_out_of_spec = false, rear_brake_out_of_spec = false, low_engine_speed = false;
  bool steer_comms_lost = false, motec_comms_lost = false, emergency_brake = false;
  bool computer_heartbeat_lost = false, race_control_lost = false;
};

struct Misc {
  double battery_v = kUnset;
  SysState sys_state = SysState::kUnknown;
  std::uint8_t mode_switch = 0, safety_switch = 0;
};

// Competitor as race control reports it (CAN 1209), for display.
struct RivalReport {
  std::uint8_t number = 0;  // 0: race control names none
  std::uint8_t rank = 0, laps = 0;
  double lap_distance_m = kUnset;  // since the start line
  double speed_mps = kUnset;
};

struct VehicleSignals {
  Received<PerWheel> wheel_speed_mps;         // circumferential speed of each wheel
  Received<PerWheel> wheel_speed_before_mps;  // likewise, of the frame before
  Received<BrakePressure> brake;
  Received<double> throttle_fraction;   // pedal feedback, 0..1
  Received<double> steering_motor_rad;  // average of the three sensors, at the motor, left positive
  Received<Misc> misc;
  Received<Powertrain> powertrain;
  Received<EngineHealth> engine;
  Received<DriveByWireDiagnostics> diagnostics;
  Received<PerWheel> tyre_temperature_c;  // mean of the 16 sensors of each tyre
  Received<PerWheel> tyre_pressure_kpa;   // gauge
  Received<RivalReport> rival;
};

}  // namespace pitwall::world
