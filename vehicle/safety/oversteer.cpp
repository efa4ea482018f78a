// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/oversteer.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::safety {

double rear_slip(const OversteerParams& params, const OversteerInputs& in) {
  using enum world::Corner;
  const auto& wheel = in.wheel_mps;
  for (const double v_mps : wheel.at)
    if (!std::isfinite(v_mps)) return 0.0;
  if (!std::isfinite(in.speed_mps)) return 0.0;
  const double front_mps = (wheel[kFrontLeft] + wheel[kFrontRight]) / 2.0;
  const double fastest_mps = std::max(front_mps, in.speed_mps);
  const double slowest_mps = std::min(front_mps, in.speed_mps);
  if (slowest_mps < params.speed_min_mps) return 0.0;
  const double spin = std::min(wheel[kRearLeft], wheel[kRearRight]) / fastest_mps - 1.0;
  const double lock = 1.0 - std::max(wheel[kRearLeft], wheel[kRearRight]) / slowest_mps;
  return std::max({0.0, spin / params.rear_spin_max, lock / params.rear_lock_max});
}

double yaw_excess(const OversteerParams& params, const OversteerInputs& in) {
  const double v = in.speed_mps;
  if (!(v >= params.speed_min_mps)) return 0.0;
  const double steered =
      steering::yaw_rate_rad_per_s(params.bicycle, {}, in.road_wheel_rad, v, 0.0);
  if (!std::isfinite(steered) || !std::isfinite(in.yaw_rate_rad_per_s)) return 0.0;
  const double turns = std::abs(in.yaw_rate_rad_per_s);
  const bool as_steered = steered * in.yaw_rate_rad_per_s > 0.0;
  const double excess = as_steered ? turns - std::abs(steered) : turns;
  return std::max(0.0, excess / params.yaw_excess_max_rad_per_s);
}

double oversteer(const OversteerParams& params, OversteerState& state, const OversteerInputs& in) {
  const double worse = std::max(rear_slip(params, in), yaw_excess(params, in));
  const bool now = worse > 1.0;
  state.ticks = now ? static_cast<std::uint8_t>(std::min(state.ticks + 1, +kOversteerTicks))
                    : std::uint8_t{0};
  return state.ticks >= kOversteerTicks ? worse : 0.0;
}

}  // namespace pitwall::safety
