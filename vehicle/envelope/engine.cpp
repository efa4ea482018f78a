// SPDX-License-Identifier: Apache-2.0
#include "vehicle/envelope/engine.hpp"

#include <algorithm>

namespace pitwall::envelope {
namespace {

double ratio_of(const Engine& engine, std::size_t gear) {
  return engine.ratio[gear - 1] * engine.final_drive;
}

bool rises(const std::array<PartThrottle, kPartThrottles>& part) {
  for (std::size_t i = 1; i < kPartThrottles; ++i) {
    if (!(part[i].throttle > part[i - 1].throttle)) return false;
    for (std::size_t k = 0; k < kTorqueRows; ++k)
      if (!(part[i].share[k] > part[i - 1].share[k])) return false;
  }
  return true;
}

}  // namespace

bool is_legal(const Engine& engine) {
  if (!rises(engine.part_throttle)) return false;
  for (std::size_t i = 1; i < kTorqueRows; ++i)
    if (!(engine.rpm[i] > engine.rpm[i - 1])) return false;
  for (std::size_t i = 1; i < kGears; ++i)
    if (!(engine.ratio[i] < engine.ratio[i - 1])) return false;
  return true;
}

std::size_t gear_at(const Engine& engine, double speed_mps) {
  std::size_t gear = 1;
  while (gear < kGears && speed_mps > engine.up_above_mps[gear - 1]) ++gear;
  return gear;
}

double engine_rpm(const Engine& engine, std::size_t gear, double speed_mps) {
  return to_rpm(speed_mps / engine.wheel_radius_m * ratio_of(engine, gear));
}

double at_rpm(const Engine& engine, const std::array<double, kTorqueRows>& values, double rpm) {
  if (rpm <= engine.rpm.front()) return values.front();
  for (std::size_t i = 1; i < kTorqueRows; ++i) {
    if (rpm > engine.rpm[i]) continue;
    const double t = (rpm - engine.rpm[i - 1]) / (engine.rpm[i] - engine.rpm[i - 1]);
    return values[i - 1] + t * (values[i] - values[i - 1]);
  }
  return values.back();
}

double full_torque_nm(const Engine& engine, double rpm) {
  return rpm > engine.rpm.back() ? 0.0 : at_rpm(engine, engine.torque_nm, rpm);
}

double mps2_per_nm(const Engine& engine, std::size_t gear) {
  return ratio_of(engine, gear) * engine.efficiency / (engine.wheel_radius_m * engine.mass_kg);
}

double drive_mps2(const Engine& engine, double speed_mps) {
  const std::size_t gear = gear_at(engine, speed_mps);
  return full_torque_nm(engine, engine_rpm(engine, gear, speed_mps)) * mps2_per_nm(engine, gear);
}

}  // namespace pitwall::envelope
