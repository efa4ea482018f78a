// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/codec/lap.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pitwall::codec {
namespace {

using telemetry::field;
using telemetry::FieldIndex;
using telemetry::Values;

constexpr double kTurnRadius_m = 200.0, kStraight_m = 500.0, kBank_rad = 0.16;
constexpr double kHalfLap_m = kStraight_m + std::numbers::pi * kTurnRadius_m;
constexpr double kTop_mps = 76.0, kSlower_mps = 12.0;  // in the turns
constexpr double kGravity_mps2 = 9.81, kDragPerSpeed2 = 0.0011;
constexpr double kTrack_m = 1.6, kWheelBase_m = 2.97;

struct Motion {
  double t_s = 0.0, station_m = 0.0, x_m = 100.0, y_m = -40.0, yaw_rad = 0.3, speed_mps = kTop_mps;
  double acceleration_mps2 = 0.0, curvature_per_m = 0.0;
};

// 0 on the straight, 1 in the turn, with 80 m between.
double turning(double station_m) {
  const double s = std::fmod(station_m, kHalfLap_m);
  const double into = std::clamp((s - kStraight_m + 40.0) / 80.0, 0.0, 1.0);
  const double out = std::clamp((s - kHalfLap_m + 40.0) / 80.0, 0.0, 1.0);
  const double share = into - out;
  return share * share * (3.0 - 2.0 * share);
}

void advance(Motion& m, double dt_s) {
  const double wanted_mps = kTop_mps - kSlower_mps * turning(m.station_m + 90.0);
  m.acceleration_mps2 = std::clamp(1.5 * (wanted_mps - m.speed_mps), -9.0, 4.0);
  m.speed_mps += m.acceleration_mps2 * dt_s;
  m.curvature_per_m = turning(m.station_m) / kTurnRadius_m;
  m.yaw_rad =
      std::remainder(m.yaw_rad + m.curvature_per_m * m.speed_mps * dt_s, 2.0 * std::numbers::pi);
  m.x_m += m.speed_mps * std::cos(m.yaw_rad) * dt_s;
  m.y_m += m.speed_mps * std::sin(m.yaw_rad) * dt_s;
  m.station_m += m.speed_mps * dt_s;
  m.t_s += dt_s;
}

// What sensors add, within -1 to 1.
double noise(const Motion& m, int channel) {
  return 0.5 * std::sin(7.3 * m.t_s + channel) + 0.5 * std::sin(31.7 * m.t_s + 2.3 * channel);
}
double slow(const Motion& m, int channel) { return std::sin(0.05 * m.t_s + channel); }

struct Drive {
  double throttle = 0.0, brake_kpa = 0.0, steering_rad = 0.0, lateral_mps2 = 0.0;
};
Drive drive_of(const Motion& m) {
  const double force = m.acceleration_mps2 + kDragPerSpeed2 * m.speed_mps * m.speed_mps;
  return {.throttle = std::clamp(force / 11.0, 0.0, 1.0),
          .brake_kpa = std::max(0.0, -force * 420.0),
          .steering_rad = std::atan(kWheelBase_m * m.curvature_per_m) * 1.3 + 0.002 * noise(m, 1),
          .lateral_mps2 = m.speed_mps * m.speed_mps * m.curvature_per_m};
}

void set_motion(Values& v, const Motion& m, const Drive& d) {
  v[field("ego.x")] = m.x_m;
  v[field("ego.y")] = m.y_m;
  v[field("ego.yaw")] = m.yaw_rad;
  v[field("ego.vx")] = m.speed_mps;
  v[field("ego.vy")] = 0.02 * d.lateral_mps2 + 0.05 * noise(m, 2);
  v[field("ego.yaw_rate")] = m.speed_mps * m.curvature_per_m + 0.01 * noise(m, 3);
  v[field("ego.position_sigma")] = 0.03 + 0.01 * slow(m, 1);
  v[field("ego.validity")] = 1;
  v[field("track.station")] = std::fmod(m.station_m, 2 * kHalfLap_m);
  v[field("track.offset")] = 0.8 * slow(m, 2) + 0.05 * noise(m, 4);
  v[field("track.lap")] = 3 + std::floor(m.station_m / (2 * kHalfLap_m));
  v[field("track.last_lap_time")] = 31.214;
  v[field("track.target_speed")] = kTop_mps - kSlower_mps * turning(m.station_m + 90.0);
  v[field("dynamics.forward")] = m.acceleration_mps2 + 0.3 * noise(m, 5);
  v[field("dynamics.left")] = d.lateral_mps2 - kGravity_mps2 * kBank_rad + 0.3 * noise(m, 6);
  v[field("dynamics.up")] = kGravity_mps2 + d.lateral_mps2 * kBank_rad + 0.5 * noise(m, 7);
  v[field("dynamics.roll_rate")] = 0.05 * noise(m, 8);
  v[field("dynamics.pitch_rate")] = 0.04 * noise(m, 9);
  v[field("dynamics.roll")] = kBank_rad * turning(m.station_m) + 0.02 * noise(m, 10);
  v[field("dynamics.pitch")] = 0.004 * m.acceleration_mps2 + 0.003 * noise(m, 11);
  v[field("dynamics.bank")] = kBank_rad * turning(m.station_m) + 0.02;
  v[field("dynamics.lateral_error")] = 0.15 * noise(m, 12);
  v[field("dynamics.heading_error")] = 0.01 * noise(m, 13);
  v[field("dynamics.speed_error")] =
      v[field("track.target_speed")] - m.speed_mps + 0.2 * noise(m, 14);
}

void set_actuators(Values& v, const Motion& m, const Drive& d) {
  const bool braking = d.brake_kpa > 0.0;
  v[field("command.steering")] = d.steering_rad;
  v[field("command.throttle")] = d.throttle;
  v[field("command.brake")] = d.brake_kpa;
  v[field("command.gear")] = v[field("feedback.gear")] = m.speed_mps > 70.0 ? 6 : 5;
  v[field("command.actuate")] = 1;
  v[field("command.limited")] = braking && m.acceleration_mps2 < -8.5 ? 1 : 0;
  v[field("feedback.steering")] = d.steering_rad + 0.001 * noise(m, 15);
  v[field("feedback.throttle")] = d.throttle;
  v[field("feedback.brake_front")] = 0.97 * d.brake_kpa;
  v[field("feedback.brake_rear")] = 0.91 * d.brake_kpa;
  for (int i = 0; i < 3; ++i) {
    v[field("steering_unit.angle_1") + static_cast<FieldIndex>(i)] =
        d.steering_rad + 0.0008 * noise(m, 16 + i);
  }
  v[field("steering_unit.current")] = 8.0 + 60.0 * std::abs(d.steering_rad) + 4.0 * noise(m, 19);
  v[field("steering_unit.duty")] = d.steering_rad + 0.1 * noise(m, 20);
  v[field("steering_unit.voltage")] = 12.9 + 0.2 * noise(m, 21);
  v[field("steering_unit.temperature")] = 58.0 + 6.0 * slow(m, 3);
  v[field("steering_unit.torque")] = 20.0 + 300.0 * std::abs(d.steering_rad) + 3.0 * noise(m, 22);
  v[field("steering_unit.error")] = 0;
  v[field("brakes.front_position")] = 800.0 + 1.4 * d.brake_kpa;
  v[field("brakes.rear_position")] = 900.0 + 1.3 * d.brake_kpa;
  v[field("brakes.front_force")] = 30.0 + 0.3 * d.brake_kpa;
  v[field("brakes.rear_force")] = 28.0 + 0.25 * d.brake_kpa;
}

// Front left, front right, rear left, rear right.
void set_wheels(Values& v, const Motion& m, const Drive& d) {
  for (int i = 0; i < 4; ++i) {
    const auto at = static_cast<FieldIndex>(i);
    const double side = i % 2 == 0 ? -1.0 : 1.0, end = i < 2 ? 1.0 : -1.0;
    const double heavier = side * d.lateral_mps2 * 90.0 - end * m.acceleration_mps2 * 60.0;
    v[field("wheels.front_left") + at] =
        m.speed_mps * (1.0 + side * kTrack_m / 2.0 * m.curvature_per_m) + 0.1 * noise(m, 30 + i);
    v[field("suspension.travel_front_left") + at] = 95.0 + heavier * 0.012 + 4.0 * noise(m, 34 + i);
    v[field("suspension.load_front_left") + at] = 3'100.0 + heavier + 150.0 * noise(m, 38 + i);
    v[field("tyres.temperature_front_left") + at] = 82.0 + 9.0 * slow(m, 4 + i) + 3.0 * side;
    v[field("tyres.pressure_front_left") + at] = 172.0 + 5.0 * slow(m, 8 + i);
    v[field("tread.inner_front_left") + at] = 86.0 + 10.0 * slow(m, 12 + i);
    v[field("tread.outer_front_left") + at] = 78.0 + 10.0 * slow(m, 16 + i);
  }
  v[field("wheels.standstill")] = 0;
}

void set_engine(Values& v, const Motion& m, const Drive& d) {
  v[field("engine.speed")] = 4'000.0 + m.speed_mps * 38.0 + 30.0 * noise(m, 50);
  v[field("engine.running")] = 1;
  v[field("engine.fuel_pressure")] = 420.0 + 12.0 * noise(m, 51);
  v[field("engine.oil_pressure")] = 510.0 + 40.0 * d.throttle + 10.0 * noise(m, 52);
  v[field("engine.coolant")] = 91.0 + 3.0 * slow(m, 20);
  v[field("powertrain.throttle_position")] = d.throttle;
  v[field("powertrain.vehicle_speed")] = m.speed_mps + 0.1 * noise(m, 53);
  v[field("powertrain.torque")] = 60.0 + 380.0 * d.throttle + 8.0 * noise(m, 54);
  v[field("powertrain.oil")] = 104.0 + 4.0 * slow(m, 21);
  v[field("powertrain.transmission")] = 97.0 + 4.0 * slow(m, 22);
  v[field("powertrain.transmission_pressure")] = 640.0 + 20.0 * noise(m, 55);
  v[field("powertrain.shift_status")] = 1;
  v[field("powertrain.traction_aim")] = 3;
  v[field("powertrain.traction_range")] = 5;
  v[field("powertrain.switch_on")] = 1;
  v[field("fuel.level")] = 61.0 - 0.02 * m.t_s;
  v[field("fuel.used")] = 14.0 + 0.02 * m.t_s;
  v[field("fuel.flow")] = 20.0 + 90.0 * d.throttle;
  v[field("fuel.laps_left")] = 44.0 - 0.03 * m.t_s;
  v[field("electric.battery")] = 13.2 + 0.1 * noise(m, 56);
  v[field("electric.diagnostics")] = 0x000100;
  v[field("electric.mode_switch")] = 1;
  v[field("electric.safety_switch")] = 3;
}

}  // namespace

std::vector<Values> lap_of(Duration length, Duration step) {
  constexpr int kFiner = 10;
  const double dt_s = step.seconds() / kFiner;
  Motion motion;
  std::vector<Values> all;
  for (Duration t{}; t < length; t = t + step) {
    for (int i = 0; i < kFiner; ++i) advance(motion, dt_s);
    const Drive drive = drive_of(motion);
    Values& values = all.emplace_back();
    set_motion(values, motion, drive);
    set_actuators(values, motion, drive);
    set_wheels(values, motion, drive);
    set_engine(values, motion, drive);
  }
  return all;
}

}  // namespace pitwall::codec
