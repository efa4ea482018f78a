// Gains of the lateral law lqr_ff: a linear-quadratic regulator on the path error of the bicycle
// model with the actuator of the steering, one gain per speed of a grid, linear in between.
//   state  (e1, e1', e2, e2') of bicycle_model.hpp, and the angle of the road wheels, which follows
//          the command after a delay with a lag; the commands within the delay are known
//   invariants
//          u = -K x(t + delay): K is the gain of the Riccati equation without the delay, and
//          x(t + delay) the state that the model predicts from the present one and the commands
//          within the delay. This is the optimum with the delay
//          cost  e1^2 + turn (v e2')^2 + angle u^2
//   errors Problem; its place names the speed
//   cost   O(states^3) per speed, allocates: start-up only
//   source Rajamani, Vehicle Dynamics and Control, 2nd ed., eq. 2.45 (model); Artstein, Linear
//          systems with delayed controls: a reduction, IEEE TAC 27, 1982 (delay)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/control/bicycle_params.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::control {

inline constexpr std::size_t kLqrSpeeds = 9;
inline constexpr std::array<double, kLqrSpeeds> kLqrSpeed_mps{10, 15, 22, 30, 37, 45, 55, 65, 80};
inline constexpr Duration kLqrTick = milliseconds(10);  // of the commands within the delay
inline constexpr std::size_t kLqrDelayTicks = 20;       // at most

struct LqrWeights {
  double turn = kUnset;   // [s^4]
  double angle = kUnset;  // [m^2/rad^2]
};

struct LqrParams {
  std::array<LqrWeights, kLqrSpeeds> weights;
  double delay_s = kUnset;     // computer, bus and actuator, from a command to its first effect
  double lag_s = kUnset;       // of the actuator
  double tyre_share = kUnset;  // of the cornering stiffness of the bicycle: worn tyres
  double slip_s = kUnset;      // over which a measured slip angle is compared with the model's
  double trim_per_s = kUnset;  // rate of the integral, in gains of e1
};

inline constexpr auto kLqrWeightRanges = std::to_array<world::NamedRange<LqrWeights>>({
    {"turn", &LqrWeights::turn, 0.0, 100.0},
    {"angle", &LqrWeights::angle, 1.0, 1e6},
});

inline constexpr auto kLqrRanges = std::to_array<world::NamedRange<LqrParams>>({
    {"delay_s", &LqrParams::delay_s, 0.01, 0.2},
    {"lag_s", &LqrParams::lag_s, 0.02, 0.3},
    {"tyre_share", &LqrParams::tyre_share, 0.2, 1.5},
    {"slip_s", &LqrParams::slip_s, 0.2, 20.0},
    {"trim_per_s", &LqrParams::trim_per_s, 0.0, 1.0},
});

struct LqrGain {
  std::array<double, 4> error{};              // of e1, e1', e2, e2'
  double wheel = 0.0;                         // of the angle of the road wheels
  std::array<double, kLqrDelayTicks> sent{};  // of the commands within the delay, newest first
};

struct LqrGains {
  std::array<LqrGain, kLqrSpeeds> at_speed;
  std::size_t delay_ticks = 0;
  double wheel_share = 0.0;  // of the way to the command that the wheels turn in a tick
  double rear_slip_rad_per_mps2 = kUnset;    // of the model, G
  double slip_s = kUnset, trim_per_s = 0.0;  // of the parameters
};

Result<LqrGains, Problem> design(const LqrParams& params, const BicycleParams& car);

// Outside of the grid that of its nearest speed.
LqrGain gain_at(const LqrGains& gains, double speed_mps);

}  // namespace pitwall::control
