// Lateral law lqr_ff: the feed-forward of steering/path_steering.hpp, and the regulator of
// lqr_gains.hpp on the error at the present projection of the car.
//   in     deviation and course of the car, its slip and yaw rate, the path a lag ahead
//   out    road-wheel angle [rad], left positive
//   rate   100 Hz, the tick of the gains
//   invariants
//          angle = L k + K a + d' + A / A0 u + lap + trim + bump, see path_steering.hpp; A0 is A
//          with nothing learned, lap the correction of lap_learning.hpp
//          u     = -(gains of e1, e1', e2, e2', angle of the road wheels, u within the delay):
//                  e1' = v chi, e2' = r / cos(bank) - v k_yaw, e2 = chi - s
//          s     = what the car slips beyond the steady slip angle of its path, high-pass of the
//                  measured one over slip_s and low-pass of the model's: G v s' = (lr / v - G v)
//                  e2' - s. The steady slip angle of a car is not known to a milliradian, and the
//                  gain of e2 is 40 times that of e1
//          trim' = -trim_per_s A / A0 (gain of e1) e1, held while the angle is at its limit; what
//          the limit takes from u was not sent
//   errors as in path_steering.hpp; while the law does not follow nothing counts as sent
//   cost   O(speeds + delay), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/control/feed_forward.hpp"
#include "vehicle/autonomy/control/lqr_gains.hpp"
#include "vehicle/steering/path_steering.hpp"

namespace pitwall::control {

struct LqrState {
  steering::State path;
  std::array<double, kLqrDelayTicks> sent_rad{};       // u of the ticks before, newest first
  double wheel_rad = 0.0;                              // what of it the road wheels have turned
  double model_slip_rad = 0.0, slip_offset_rad = 0.0;  // s by the model; what is measured beyond it
};
static_assert(std::is_trivially_copyable_v<LqrState>);

struct LqrInputs {
  steering::SteeringInputs path;
  double slip_mps = kUnset;  // of the centre of gravity, to the left, in the plane of the road
  double lap_rad = 0.0;      // of lap_learning.hpp
};

double steer_lqr(const steering::Params& params, const LqrGains& gains,
                 const steering::Learned& learned, LqrState& state, const LqrInputs& in,
                 Duration dt);

}  // namespace pitwall::control
