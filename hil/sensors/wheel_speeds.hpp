// Model of the four wheel-speed sensors as the drive-by-wire computer reads them.
//   in     circumferential speeds of the unloaded tyres (rotation times nominal radius), the time
//   out    reported speeds: rotation times the radius that the team set, with the errors by tyre
//          growth, spread of the radii and scatter of the sensors
//   invariants
//          the radius of a tyre grows with the square of its speed: the reported speed is too low
//          by growth (v^2 - calibrated^2). Below kSlowest_mps a sensor detects no teeth
//   rate   a new scatter is drawn every 10 ms
//   source README.md beside this file (fitted to a recorded AV-21 drive)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "hil/plant/plant.hpp"
#include "hil/sensors/noise.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::sensors {

struct WheelParams {
  double growth_s2_per_m2 = 3.8e-6;
  double calibrated_mps = 30.0;
  double radius_sigma = 0.001;  // relative; one draw per tyre and run
  std::array<double, world::kCorners> sigma_mps{0.06, 0.06, 0.13, 0.13};
  Duration period = milliseconds(10);
};

enum class WheelTrouble : std::uint8_t {
  kNone,
  kLost,     // reads zero
  kLocked,   // reads as a wheel that stops within kLocking_s
  kSpinning  // reads `factor` times its speed
};

struct WheelFault {
  WheelTrouble trouble = WheelTrouble::kNone;
  double factor = 1.0;
  double since_s = 0.0;  // how long it has lasted
};

struct WheelState {
  Noise noise;
  plant::Wheels radius_error{}, scatter{};
  Instant next{};
  std::array<WheelFault, world::kCorners> fault{};
};

inline constexpr double kSlowest_mps = 0.3;
inline constexpr double kLocking_s = 0.1;

WheelState make_wheels(const WheelParams& params, std::uint64_t seed, Instant start);
plant::Wheels step_wheels(const WheelParams& params, WheelState& state, const plant::Wheels& truth,
                          Instant now);

}  // namespace pitwall::sensors
