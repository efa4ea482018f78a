// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/drivetrain.hpp"

#include <algorithm>
#include <cmath>

#include "vehicle/envelope/throttle.hpp"

namespace pitwall::control {
namespace {

constexpr double kSpeedFloor_mps = 1.0;  // below it, power / speed means nothing

double rpm_of(const envelope::Engine& engine, const Motion& m) {
  return envelope::engine_rpm(engine, m.gear, m.speed_mps);
}

// Below the first row of the engine's table the clutch slips: nothing drags.
double engine_drag_mps2(const DrivetrainParams& p, const Motion& m) {
  const envelope::Engine& engine = p.car.engine;
  if (m.gear == 0 || !has_gears(engine)) return 0.0;
  const double rpm = rpm_of(engine, m);
  if (rpm < engine.rpm.front()) return 0.0;
  return envelope::drag_torque_nm(engine, rpm) * envelope::mps2_per_nm(engine, m.gear);
}

double drive_max_mps2(const DrivetrainParams& p, const Motion& m) {
  const envelope::Engine& engine = p.car.engine;
  if (m.gear == 0) return 0.0;
  if (has_gears(engine))
    return envelope::full_torque_nm(engine, rpm_of(engine, m)) *
           envelope::mps2_per_nm(engine, m.gear);
  return std::min(p.car.accel_max_mps2,
                  p.car.power_w_per_kg / std::max(m.speed_mps, kSpeedFloor_mps));
}

double throttle_for(const DrivetrainParams& p, const Motion& m, double drive_mps2) {
  const envelope::Engine& engine = p.car.engine;
  if (m.gear == 0) return 0.0;
  if (!has_gears(engine)) return std::clamp(drive_mps2 / drive_max_mps2(p, m), 0.0, 1.0);
  const double rpm = std::max(rpm_of(engine, m), engine.rpm.front());
  return envelope::throttle_for(engine, rpm, drive_mps2 / envelope::mps2_per_nm(engine, m.gear));
}

}  // namespace

double resistance_mps2(const DrivetrainParams& p, const Motion& m) {
  const double rolling_mps2 = m.speed_mps > 0.0 ? p.rolling_mps2 : 0.0;
  return p.car.drag_per_m * m.speed_mps * m.speed_mps + rolling_mps2 +
         kGravity_mps2 * std::sin(m.climb_rad);
}

double coasting_mps2(const DrivetrainParams& p, const Motion& m) {
  return -resistance_mps2(p, m) - engine_drag_mps2(p, m);
}

double full_throttle_mps2(const DrivetrainParams& p, const Motion& m) {
  return drive_max_mps2(p, m) - resistance_mps2(p, m);
}

Pedals pedals_for(const DrivetrainParams& p, const Motion& m, double accel_mps2,
                  bool brakes_already) {
  const double coasting = coasting_mps2(p, m);
  const double brakes_from = brakes_already ? coasting : coasting - p.dead_zone_mps2;
  if (accel_mps2 < brakes_from) return {0.0, (coasting - accel_mps2) * p.brake_kpa_per_mps2};
  if (accel_mps2 <= coasting) return {};
  return {throttle_for(p, m, accel_mps2 + resistance_mps2(p, m)), 0.0};
}

}  // namespace pitwall::control
