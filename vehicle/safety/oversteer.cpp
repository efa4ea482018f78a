// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/oversteer.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace pitwall::safety {
namespace {

constexpr double kMoves_mps = 5.0;
constexpr double kReleased_kpa = 50.0;
constexpr double kAgreesShare = 0.5;  // of the slip at which a wheel locks

bool is_known(const world::PerWheel& wheel) {
  return std::ranges::all_of(wheel.at, [](double v_mps) { return std::isfinite(v_mps); });
}

double above_limit(double indicator) { return indicator > 1.0 ? indicator : 0.0; }

// Of one frame, each 1 at its limit.
struct RearSlip {
  double spin = 0.0, lock = 0.0;
};

RearSlip rear_slip(const OversteerParams& params, const world::PerWheel& wheel, double speed_mps) {
  using enum world::Corner;
  if (!is_known(wheel) || !std::isfinite(speed_mps)) return {};
  const double front_mps = (wheel[kFrontLeft] + wheel[kFrontRight]) / 2.0;
  const double fastest_mps = std::max(front_mps, speed_mps);
  const double slowest_mps = std::min(front_mps, speed_mps);
  if (slowest_mps < params.speed_min_mps) return {};
  const double spin = std::min(wheel[kRearLeft], wheel[kRearRight]) / fastest_mps - 1.0;
  const double lock = 1.0 - std::max(wheel[kRearLeft], wheel[kRearRight]) / slowest_mps;
  return {spin / params.rear_spin_max, lock / params.rear_lock_max};
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

// Slip of the left and the right front wheel in one frame. The fastest wheel may have a wrong
// sensor, and a rear wheel that spins is faster than the car.
std::array<double, 2> front_slips(const world::PerWheel& wheel, double speed_mps) {
  auto sorted = wheel.at;
  std::ranges::sort(sorted, std::greater{});
  const double reference_mps = std::fmin(sorted[1], speed_mps);  // unset: the wheel
  if (!(reference_mps > kMoves_mps)) return {};
  const auto slip = [&](double v_mps) { return 1.0 - v_mps / reference_mps; };
  return {slip(wheel.at[0]), slip(wheel.at[1])};
}

}  // namespace

WheelFrames wheel_frames(const world::VehicleSignals& signals, Instant now) {
  const auto &newest = signals.wheel_speed_mps, &before = signals.wheel_speed_before_mps;
  if (!newest.fresh(now, kSlipAgeMax) || !before.fresh(now, kSlipAgeMax)) return {};
  return {newest.value, before.value};
}

Oversteer detect_oversteer(const OversteerParams& params, OversteerState& state,
                           const OversteerInputs& in) {
  const RearSlip newest = rear_slip(params, in.wheel_mps[0], in.speed_mps);
  const RearSlip before = rear_slip(params, in.wheel_mps[1], in.speed_mps);
  const double excess = yaw_excess(params, in);
  state.yaw_ticks = excess > 1.0
                        ? static_cast<std::uint8_t>(std::min(state.yaw_ticks + 1, +kOversteerTicks))
                        : std::uint8_t{0};
  return {.rear_spin = above_limit(std::min(newest.spin, before.spin)),
          .rear_lock = above_limit(std::min(newest.lock, before.lock)),
          .yaw_excess = state.yaw_ticks >= kOversteerTicks ? excess : 0.0};
}

double front_slip(FrontWheelState& state, const FrontWheelInputs& in) {
  if (!is_known(in.wheel_mps[0]) || !is_known(in.wheel_mps[1])) return kUnset;
  const auto newest = front_slips(in.wheel_mps[0], in.speed_mps);
  const auto before = front_slips(in.wheel_mps[1], in.speed_mps);
  std::array<double, 2> slip{};
  for (std::size_t i = 0; i < slip.size(); ++i) {
    slip[i] = std::max(0.0, std::min(newest[i], before[i]));
    if (in.brake_kpa <= kReleased_kpa)
      state.agreed[i] = std::abs(newest[i]) < kAgreesShare * in.lock_slip;
  }
  const bool both = std::min(slip[0], slip[1]) > in.lock_slip;
  double most = 0.0;
  for (std::size_t i = 0; i < slip.size(); ++i)
    if (both || state.agreed[i]) most = std::max(most, slip[i]);
  return most;
}

FrontWheelInputs front_wheels_of(const world::VehicleSignals& signals, double lock_slip,
                                 double speed_mps, Instant now) {
  const auto& brake = signals.brake;
  return {.wheel_mps = wheel_frames(signals, now),
          .speed_mps = speed_mps,
          .brake_kpa = brake.fresh(now, kSlipAgeMax) ? brake.value.front_kpa : kUnset,
          .lock_slip = lock_slip};
}

}  // namespace pitwall::safety
