// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/wheel_speeds.hpp"

#include <algorithm>
#include <cmath>

#include "hil/sensors/streams.hpp"

namespace pitwall::sensors {
namespace {

double troubled(const WheelFault& fault, double speed_mps) {
  switch (fault.trouble) {
    case WheelTrouble::kLost:
      return 0.0;
    case WheelTrouble::kLocked:
      return speed_mps * std::max(0.0, 1.0 - fault.since_s / kLocking_s);
    case WheelTrouble::kSpinning:
      return speed_mps * fault.factor;
    case WheelTrouble::kNone:
      break;
  }
  return speed_mps;
}

}  // namespace

WheelState make_wheels(const WheelParams& params, std::uint64_t seed, Instant start) {
  WheelState state;
  state.noise = Noise(seed, kWheelStream);
  for (double& error : state.radius_error) error = params.radius_sigma * state.noise.normal();
  state.next = start;
  return state;
}

plant::Wheels step_wheels(const WheelParams& params, WheelState& state, const plant::Wheels& truth,
                          Instant now) {
  if (now >= state.next) {
    while (state.next <= now) state.next += params.period;
    for (std::size_t i = 0; i < world::kCorners; ++i)
      state.scatter[i] = params.sigma_mps[i] * state.noise.normal();
  }
  plant::Wheels reported{};
  for (std::size_t i = 0; i < world::kCorners; ++i) {
    const double turning_mps = troubled(state.fault[i], truth[i]);
    if (std::abs(turning_mps) < kSlowest_mps) continue;
    const double grown = params.growth_s2_per_m2 * (turning_mps * turning_mps -
                                                    params.calibrated_mps * params.calibrated_mps);
    const double shaken = std::min(1.0, std::abs(turning_mps) / 10.0);
    reported[i] = turning_mps * (1.0 - grown + state.radius_error[i]) + shaken * state.scatter[i];
  }
  return reported;
}

}  // namespace pitwall::sensors
