// Cars and roads for the tests of speed profiles.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/vehicle/envelope/car.hpp"
#include "vehicle/envelope/lap_profile.hpp"

namespace pitwall::envelope::testing {

// Without wing, drag and load transfer: 5 m/s2 forward, 8 m/s2 of brake, on tyres that carry more.
inline EnvelopeParams block_envelope() {
  FrictionParams f = av21();
  f.friction = 2.5, f.downforce_per_m = 0.0, f.drag_per_m = 0.0;
  f.accel_max_mps2 = 5.0, f.power_w_per_kg = 1e6, f.brake_max_mps2 = 8.0;
  f.load_shift = 0.0, f.long_friction = 1.5, f.brake_front = 0.5, f.load_front = 0.5;
  return {.friction = f,
          .grip_share = 1.0,
          .speed_max_mps = 100.0,
          .bank_most_rad = 0.0,
          .steering = std::nullopt};
}

inline EnvelopeParams av21_envelope() {
  FrictionParams f = av21();
  f.engine = av21_engine();
  return {.friction = f,
          .grip_share = 0.8,
          .speed_max_mps = 80.0,
          .bank_most_rad = from_deg(20.0),
          .steering = std::nullopt};
}

inline std::vector<RoadStep> straight(std::size_t points) {
  return std::vector<RoadStep>(points, RoadStep{0.0, 0.0, kNoCap_mps, 1.0});
}

// A lap of 2400 m with four corners of 30 to 120 m to both sides, one of them banked.
inline std::vector<RoadStep> lap() {
  std::vector<RoadStep> road = straight(2400);
  const auto corner = [&](std::size_t from, std::size_t to, double curvature, double bank) {
    for (std::size_t i = from; i < to; ++i) {
      const double t = static_cast<double>(i - from) / static_cast<double>(to - from);
      const double ramp = std::min(1.0, 4.0 * std::min(t, 1.0 - t));
      road[i] = {curvature * ramp, bank * ramp, kNoCap_mps, 1.0};
    }
  };
  corner(400, 520, 1.0 / 30.0, 0.0), corner(800, 1000, 1.0 / 60.0, from_deg(15.0));
  corner(1300, 1400, -1.0 / 45.0, 0.0), corner(1900, 2300, 1.0 / 120.0, from_deg(-3.0));
  return road;
}

}  // namespace pitwall::envelope::testing
