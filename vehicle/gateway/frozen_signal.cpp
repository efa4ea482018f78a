// SPDX-License-Identifier: Apache-2.0
#include "vehicle/gateway/frozen_signal.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::gateway {
namespace {

constexpr double kMoving_mps = 5.0;
constexpr Duration kActuatorLag = milliseconds(100);
constexpr double kWheelJump_mps = 1.0;         // within a tick: ten times what tyres can do
constexpr Duration kFresh = milliseconds(50);  // of a speed that bears witness
// In the order of Watched: rad at the road wheel, kPa, share, m/s, m/s.
constexpr std::array<double, kWatched> kLimits{0.0015, 300.0, 0.1, 0.3, 1.0};

// Mean of the commands around kActuatorLag ago, because an actuator smooths the noise of its
// command; unset without any.
world::ActuatorCommand reported_then(const FrozenState& state, Instant now) {
  world::ActuatorCommand mean{.road_wheel_rad = 0.0, .throttle_fraction = 0.0, .brake_kpa = 0.0};
  double count = 0.0;
  for (std::size_t i = 0; i < FrozenState::kCommands; ++i) {
    const Duration age = now - state.reported_at[i];
    if (age < kActuatorLag / 2 || age > kActuatorLag + kActuatorLag / 2) continue;
    mean.road_wheel_rad += state.commands[i].road_wheel_rad;
    mean.throttle_fraction += state.commands[i].throttle_fraction;
    mean.brake_kpa += state.commands[i].brake_kpa;
    count += 1.0;
  }
  if (count == 0.0) return {};
  mean.road_wheel_rad /= count;
  mean.throttle_fraction /= count;
  mean.brake_kpa /= count;
  return mean;
}

// The mean of the middle two: one wheel that lies must not bear witness against the powertrain.
double middle_mps(const world::VehicleSignals& signals) {
  auto wheels = signals.wheel_speed_mps.value.at;
  for (const double wheel : wheels)
    if (!std::isfinite(wheel)) return kUnset;
  std::ranges::sort(wheels);
  return (wheels[1] + wheels[2]) / 2.0;
}

// One number that changes when any wheel does.
double mark_of(const world::PerWheel& wheels) {
  double mark = 0.0;
  for (const double wheel : wheels.at) mark = mark * 1009.0 + wheel;
  return mark;
}

struct Judge {
  FrozenState& state;
  Instant now;
  bool moving;

  template <class T>
  void operator()(Watched which, world::Received<T>& signal, double value, double witness) {
    FrozenTrack& track = state.tracks[static_cast<std::size_t>(which)];
    if (!moving || !signal.received || !std::isfinite(witness) || !std::isfinite(value)) {
      track = {};
      return;
    }
    if (value != track.value || !std::isfinite(track.witness)) {
      track = {.value = value, .witness = witness};
      return;
    }
    const double moved = std::abs(witness - track.witness);
    if (!track.frozen && moved < kLimits[static_cast<std::size_t>(which)]) return;
    if (!track.frozen) track.frozen_since = now;
    track.frozen = true;
    const bool is_speed = which == Watched::kWheels || which == Watched::kPowertrain;
    if (is_speed) signal.at = std::min(signal.at, track.frozen_since);
  }
};

template <class T>
double fresh_or_unset(const world::Received<T>& signal, double value, Instant now) {
  return signal.fresh(now, kFresh) ? value : kUnset;
}

}  // namespace

void store(FrozenState& state, const world::ActuatorCommand& command, bool reported, Instant now) {
  state.commands[state.next] = reported ? command : world::ActuatorCommand{};
  state.reported_at[state.next] = now;
  state.next = (state.next + 1) % FrozenState::kCommands;
}

void judge_frozen(FrozenState& state, world::VehicleSignals& signals, Instant now) {
  const double wheels_mps = middle_mps(signals);
  const double powertrain_mps = signals.powertrain.value.vehicle_speed_mps;
  const world::ActuatorCommand reported = reported_then(state, now);
  // Of the other speed as well: frozen wheels must not tell that the car stands.
  const bool moving = wheels_mps > kMoving_mps || powertrain_mps > kMoving_mps;
  const bool jumps = std::abs(wheels_mps - state.wheels_mps) > kWheelJump_mps;
  state.wheels_mps = wheels_mps;
  const double wheels_fresh =
      jumps ? kUnset : fresh_or_unset(signals.wheel_speed_mps, wheels_mps, now);
  const double powertrain_fresh = fresh_or_unset(signals.powertrain, powertrain_mps, now);
  Judge judge{state, now, moving};
  judge(Watched::kSteering, signals.steering_motor_rad, signals.steering_motor_rad.value,
        reported.road_wheel_rad);
  judge(Watched::kBrake, signals.brake, signals.brake.value.front_kpa, reported.brake_kpa);
  judge(Watched::kThrottle, signals.throttle_fraction, signals.throttle_fraction.value,
        reported.throttle_fraction);
  // Wheels that stand while the car slides are locked, not frozen.
  if (wheels_mps > kMoving_mps)
    judge(Watched::kWheels, signals.wheel_speed_mps, mark_of(signals.wheel_speed_mps.value),
          powertrain_fresh);
  else
    state.tracks[static_cast<std::size_t>(Watched::kWheels)] = {};
  judge(Watched::kPowertrain, signals.powertrain, powertrain_mps, wheels_fresh);
}

}  // namespace pitwall::gateway
