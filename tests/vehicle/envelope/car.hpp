// Friction of the AV-21 as its car file has it, without an engine and with one.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vehicle/envelope/friction.hpp"

namespace pitwall::envelope::testing {

inline FrictionParams av21() {
  return {.friction = 1.3,
          .downforce_per_m = 0.0013,
          .drag_per_m = 0.00061,
          .accel_max_mps2 = 6.0,
          .power_w_per_kg = 320.0,
          .brake_max_mps2 = 9.0,
          .brake_front = 0.615,
          .load_front = 0.40,
          .load_shift = 0.094,
          .long_friction = 0.8,
          .tyres = {},
          .engine = {}};
}

inline Engine av21_engine() {
  return {
      .rpm = {2800, 3000, 3500, 3717, 4308, 4930, 5500, 5900, 6500, 6780, 7200},
      .torque_nm = {255, 303, 400, 459, 479, 480, 467, 458, 422, 395, 365},
      .part_throttle =
          {PartThrottle{
               0.30, {0.431, 0.347, 0.225, 0.183, 0.130, 0.102, 0.074, 0.055, 0.031, 0.020, 0.019}},
           PartThrottle{
               0.50, {0.700, 0.620, 0.492, 0.493, 0.642, 0.575, 0.523, 0.503, 0.367, 0.294, 0.293}},
           PartThrottle{
               0.65, {0.900, 0.880, 0.838, 0.802, 0.781, 0.801, 0.833, 0.843, 0.857, 0.863, 0.862}},
           PartThrottle{
               0.70, {0.950, 0.940, 0.924, 0.920, 0.909, 0.891, 0.916, 0.923, 0.919, 0.915, 0.916}},
           PartThrottle{
               0.80,
               {0.987, 0.985, 0.985, 0.994, 0.987, 0.986, 0.987, 0.982, 0.989, 0.994, 0.993}}},
      .drag_nm = 30.0,
      .drag_nm_per_rpm = 0.004,
      .ratio = {2.9167, 1.875, 1.3809, 1.1154, 0.96, 0.8889},
      .final_drive = 3.0,
      .efficiency = 0.93,
      .wheel_radius_m = 0.3118,
      .shift_s = 0.08,
      .mass_kg = 790.0,
      .up_above_mps = {21.5, 33.5, 45.5, 56.5, 65.5},
      .down_below_mps = {19.0, 30.5, 42.0, 52.5, 61.0}};
}

}  // namespace pitwall::envelope::testing
