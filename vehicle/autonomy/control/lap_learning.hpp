// Lap learning of the lateral law lqr_ff: iterative learning control by station. A table over the
// line holds a steering correction, and every lap corrects it by the lateral error that the lap
// before has left.
//   in     station on the line, speed, lateral error; whether the lap may teach
//   out    correction of the road-wheel angle [rad], left positive
//   rate   100 Hz
//   invariants
//          u'(s) = (1 - forget) Q u(s) - gain (k_e e + k_r de/dt + k_a d2e/dt2)(s + v lead_s)
//          u is the correction that was applied in the lap, e the lateral error, both as means over
//          a bin of the table. Q, and e with its derivatives, are local fits of a parabola with
//          Gaussian weights of smooth_s. The k are those of a car of the model under lqr_ff:
//            k_e = K_e1 / h, k_r = (K_e1' + K_e2 / v) / h, k_a = A / v^2,
//            h   = 1 + the gains of the wheel angle and of what was sent
//          With P from the steering to the error an error is multiplied from lap to lap by
//          |(1 - forget) Q - gain L P|, which is less than 1 for each car of the margins
//          |u| <= angle_max_rad, |du/dt| <= slew_rad_per_s
//          a bin is used in full up to half of speed_share from the speed that taught it, and not
//          at all from speed_share on; off the line the correction goes to 0
//          a bin changes kLapReach bins behind the car: never what is applied now
//   errors none: what is not a number does not teach
//   cost   O(1), in a new bin O(kLapReach); no allocation
//   source Bristow, Tharayil, Alleyne, A survey of iterative learning control, IEEE Control Systems
//          26, 2006 (Q filter, learning function, convergence)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/control/lqr_gains.hpp"
#include "vehicle/steering/path_steering.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::control {

inline constexpr std::size_t kLapBins = 512;  // over the line: 8 m at Indianapolis
inline constexpr std::size_t kLapReach = 20;  // bins before and after the one that is taught

struct LapParams {
  double gain = kUnset;    // of what a lap could correct; 0 turns lap learning off
  double forget = kUnset;  // share of the correction that a lap loses
  double lead_s = kUnset;  // from the steering to its error
  double smooth_s = kUnset;
  double angle_max_rad = kUnset, slew_rad_per_s = kUnset;
  double speed_share = kUnset;  // from the speed of the lap that taught
};

inline constexpr auto kLapRanges = std::to_array<world::NamedRange<LapParams>>({
    {"gain", &LapParams::gain, 0.0, 1.0},
    {"forget", &LapParams::forget, 0.0, 1.0},
    {"lead_s", &LapParams::lead_s, 0.0, 1.0},
    {"smooth_s", &LapParams::smooth_s, 0.1, 1.0},
    {"angle_max_rad", &LapParams::angle_max_rad, 0.0, 0.03},
    {"slew_rad_per_s", &LapParams::slew_rad_per_s, 0.001, 0.2},
    {"speed_share", &LapParams::speed_share, 0.01, 0.3},
});

// Means of a passage through a bin.
struct LapBin {
  double error_m = 0.0, applied_rad = 0.0, speed_mps = 0.0;
};

struct LapState {
  double length_m = 0.0;                           // of the line that taught
  std::array<float, kLapBins> angle_rad{};         // correction in the middle of each bin
  std::array<float, kLapBins> speed_mps{};         // that taught it; 0: nothing did
  std::array<LapBin, 2 * kLapReach + 1> passed{};  // the last ones, a ring
  std::size_t newest = 0;                          // in it
  std::size_t run = 0;                             // of it, passed in whole without a gap
  std::size_t bin = 0;                             // where the car is
  LapBin sums;                                     // of the ticks in it
  std::size_t ticks = 0;                           // in it; 0 while nothing is known
  bool whole = false;                              // the car has come from the bin before
  double applied_rad = 0.0;                        // in the last tick
};
static_assert(std::is_trivially_copyable_v<LapState>);

struct LapInputs {
  double s_m = kUnset, length_m = kUnset;  // station and length of the line; unset: off the line
  double speed_mps = kUnset, lateral_m = kUnset;
  bool drives = false, teaches = false;  // the correction is used; the error is what it left
};

double learn_lap(const LapParams& params, const steering::Params& steering, const LqrGains& gains,
                 LapState& state, const LapInputs& in, Duration dt);

}  // namespace pitwall::control
