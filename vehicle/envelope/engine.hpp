// Force of the engine at the wheels by speed: its full-throttle torque through the gear that the
// shift points choose. Start-up computes, then it is read-only.
//   in     torque over engine speed; ratios, wheel radius and mass; the speeds of upward shifts
//   out    driving acceleration in the gear of a speed; the gear; how long a shift cuts the torque
//   invariants
//          the gear of a speed is that of a car which speeds up: shifts to gear i + 1 above
//          up_above[i - 1]. Who slows down keeps the higher gear to down_below[i - 1]: that is
//          left out of the force
//          torque is linear between the rows, the first one's below (the clutch slips), and zero
//          above the last
//   errors none; is_legal() says whether the tables are usable
//   cost   O(rows), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::envelope {

inline constexpr std::size_t kTorqueRows = 11;
inline constexpr std::size_t kGears = 6;
inline constexpr std::size_t kPartThrottles = 5;

// Torque at a throttle between closed and full, over the torque at full throttle.
struct PartThrottle {
  double throttle = kUnset;
  std::array<double, kTorqueRows> share{};  // at the engine speeds of the torque
};

struct Engine {
  std::array<double, kTorqueRows> rpm{};                     // rising
  std::array<double, kTorqueRows> torque_nm{};               // at full throttle
  std::array<PartThrottle, kPartThrottles> part_throttle{};  // rising in both
  double drag_nm = kUnset, drag_nm_per_rpm = kUnset;         // at closed throttle
  std::array<double, kGears> ratio{};                        // falling
  double final_drive = kUnset;                               // unset: no engine is known
  double efficiency = kUnset;                                // of the drivetrain
  double wheel_radius_m = kUnset;
  double shift_s = kUnset;  // without torque, of an upward shift
  // Written elsewhere in the car file: the mass, and the shifts of its gear selection.
  double mass_kg = kUnset;
  std::array<double, kGears - 1> up_above_mps{}, down_below_mps{};
};

inline constexpr auto kEngineRanges = std::to_array<world::NamedRange<Engine>>({
    {"drag_nm", &Engine::drag_nm, 0.0, 200.0},
    {"drag_nm_per_rpm", &Engine::drag_nm_per_rpm, 0.0, 0.05},
    {"final_drive", &Engine::final_drive, 1.0, 8.0},
    {"efficiency", &Engine::efficiency, 0.5, 1.0},
    {"wheel_radius_m", &Engine::wheel_radius_m, 0.2, 0.5},
    {"shift_s", &Engine::shift_s, 0.0, 1.0},
});
inline constexpr world::Range kEngineSpeed_rpm{0.0, 20'000.0}, kEngineTorque_nm{0.0, 2000.0},
    kGearRatio{0.3, 6.0}, kThrottle{0.01, 0.99}, kTorqueShare{0.0, 1.0};

inline bool has_gears(const Engine& engine) { return !std::isnan(engine.final_drive); }
bool is_legal(const Engine& engine);

std::size_t gear_at(const Engine& engine, double speed_mps);  // from 1
double engine_rpm(const Engine& engine, std::size_t gear, double speed_mps);
// Between the rows of the table; beyond its ends the value of the end.
double at_rpm(const Engine& engine, const std::array<double, kTorqueRows>& values, double rpm);
double full_torque_nm(const Engine& engine, double rpm);
// Acceleration of the car per torque at the crankshaft, 1 / (kg m).
double mps2_per_nm(const Engine& engine, std::size_t gear);
double drive_mps2(const Engine& engine, double speed_mps);

}  // namespace pitwall::envelope
