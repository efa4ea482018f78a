// Open and closed loop of the lateral law lqr_ff with the linear cars of
// tests/vehicle/steering/steering_loop.hpp, on a straight.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>

#include "tests/vehicle/autonomy/control/single_track.hpp"
#include "tests/vehicle/steering/margin_family.hpp"
#include "vehicle/autonomy/control/lqr_ff.hpp"

namespace pitwall::control::testing {

using steering::testing::kMeasured;
using steering::testing::LoopCase;

// States of the law: trim, bump, turned wheels, two of the slip, what was sent, the command.
constexpr std::size_t kLqrStates = 5 + kLqrDelayTicks + 1;

inline std::array<double, kLqrStates> lqr_tick(const steering::Params& params,
                                               const LqrGains& gains, const LoopCase& c,
                                               const std::array<double, kLqrStates>& x,
                                               const std::array<double, kMeasured>& measured) {
  steering::Learned learned;
  if (c.learned)
    learned.understeer_rad_per_mps2 = c.understeer - params.bicycle.understeer_rad_per_mps2;
  LqrState state{.path = {.begun = true, .trim_rad = x[0], .bump_rad = x[1]},
                 .wheel_rad = x[2],
                 .model_slip_rad = x[3],
                 .slip_offset_rad = x[4]};
  std::copy_n(x.begin() + 5, kLqrDelayTicks, state.sent_rad.begin());
  const double angle_rad = steer_lqr(params, gains, learned, state,
                                     {.path = {.deviation = {measured[0], measured[1], 0.0, 0.0},
                                               .ahead = {0.0, 0.0, 0.0},
                                               .speed_mps = c.speed_mps,
                                               .yaw_rate_rad_per_s = measured[2],
                                               .last_angle_rad = x.back(),
                                               .angle_max_rad = 1.0},
                                      .slip_mps = measured[3]},
                                     kTick);
  std::array<double, kLqrStates> next{state.path.trim_rad, state.path.bump_rad, state.wheel_rad,
                                      state.model_slip_rad, state.slip_offset_rad};
  std::copy_n(state.sent_rad.begin(), kLqrDelayTicks, next.begin() + 5);
  next.back() = angle_rad;
  return next;
}

using LqrLoop = steering::testing::LoopOf<kLqrStates>;

inline LqrLoop lqr_loop_of(const LqrGains& gains, const LoopCase& c) {
  const steering::Params params = recommended().steering;
  return {steering::testing::car_of(c),
          steering::testing::linearised<kLqrStates>([&](const auto& x, const auto& measured) {
            return lqr_tick(params, gains, c, x, measured);
          }),
          steering::testing::delay_ticks(c)};
}

}  // namespace pitwall::control::testing
