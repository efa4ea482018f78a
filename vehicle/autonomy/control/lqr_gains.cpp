// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/lqr_gains.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "vehicle/autonomy/control/bicycle_model.hpp"
#include "vehicle/autonomy/control/riccati.hpp"

namespace pitwall::control {
namespace {

using ActuatedMatrix = Eigen::Matrix<double, 5, 5>;
using ActuatedVector = Eigen::Matrix<double, 5, 1>;
using HeldMatrix = Eigen::Matrix<double, 6, 6>;

struct ActuatedCar {
  ActuatedMatrix a;
  ActuatedVector b;
};

ActuatedCar actuated(const LqrParams& params, BicycleParams car, double speed_mps) {
  car.cornering_front_n_per_rad *= params.tyre_share;
  car.cornering_rear_n_per_rad *= params.tyre_share;
  ActuatedCar out{ActuatedMatrix::Zero(), ActuatedVector::Zero()};
  out.a.topLeftCorner<4, 4>() = error_dynamics(car, speed_mps);
  out.a.topRightCorner<4, 1>() = steering_input(car);
  out.a(4, 4) = -1.0 / params.lag_s;
  out.b(4) = 1.0 / params.lag_s;
  return out;
}

// By its series, until a term is nothing: of a tick, the matrix is small.
HeldMatrix exponential(const HeldMatrix& m) {
  constexpr double kNothing = 1e-18;
  HeldMatrix sum = HeldMatrix::Identity(), term = HeldMatrix::Identity();
  for (int i = 1; term.cwiseAbs().maxCoeff() > kNothing; ++i) {
    term = (term.lazyProduct(m) / i).eval();
    sum += term;
  }
  return sum;
}

// Over one tick with a held command.
ActuatedCar held(const ActuatedCar& car) {
  HeldMatrix m = HeldMatrix::Zero();
  m.topLeftCorner<5, 5>() = car.a;
  m.topRightCorner<5, 1>() = car.b;
  const HeldMatrix e = exponential(m * kLqrTick.seconds());
  return {e.topLeftCorner<5, 5>(), e.topRightCorner<5, 1>()};
}

LqrGain over_delay(ActuatedVector k, const ActuatedCar& tick, std::size_t ticks) {
  LqrGain gain;
  for (std::size_t i = 0; i < ticks; ++i) {
    gain.sent[i] = k.dot(tick.b);
    k = tick.a.transpose().lazyProduct(k).eval();
  }
  std::copy_n(k.data(), gain.error.size(), gain.error.begin());
  gain.wheel = k(4);
  return gain;
}

Result<ActuatedVector, RiccatiFailure> without_delay(const ActuatedCar& car,
                                                     const LqrWeights& weights, double speed_mps) {
  RiccatiProblem problem;
  problem.a = car.a;
  problem.g = car.b * car.b.transpose() / weights.angle;
  ActuatedVector q = ActuatedVector::Zero();
  q(0) = 1.0;
  q(3) = weights.turn * speed_mps * speed_mps;
  problem.q = q.asDiagonal();
  const auto x = solve(problem);
  if (!x) return Unexpected{x.error()};
  return ActuatedVector{x->lazyProduct(car.b) / weights.angle};
}

}  // namespace

Result<LqrGains, Problem> design(const LqrParams& params, const BicycleParams& car) {
  if (auto problem = world::first_illegal(kLqrRanges, params, "lqr_ff."))
    return Unexpected{*problem};
  LqrGains gains;
  gains.delay_ticks = static_cast<std::size_t>(std::lround(params.delay_s / kLqrTick.seconds()));
  gains.wheel_share = 1.0 - std::exp(-kLqrTick.seconds() / params.lag_s);
  gains.rear_slip_rad_per_mps2 =
      car.mass_kg * car.cg_to_front_m /
      ((car.cg_to_front_m + car.cg_to_rear_m) * params.tyre_share * car.cornering_rear_n_per_rad);
  gains.slip_s = params.slip_s;
  gains.trim_per_s = params.trim_per_s;
  for (std::size_t i = 0; i < kLqrSpeeds; ++i) {
    const std::string place = "lqr_ff.weights[" + std::to_string(i) + "].";
    if (auto problem = world::first_illegal(kLqrWeightRanges, params.weights[i], place))
      return Unexpected{*problem};
    const ActuatedCar moving = actuated(params, car, kLqrSpeed_mps[i]);
    const auto k = without_delay(moving, params.weights[i], kLqrSpeed_mps[i]);
    if (!k) return Unexpected{Problem{place, to_string(k.error())}};
    gains.at_speed[i] = over_delay(*k, held(moving), gains.delay_ticks);
  }
  return gains;
}

LqrGain gain_at(const LqrGains& gains, double speed_mps) {
  std::size_t above = 1;
  while (above + 1 < kLqrSpeeds && kLqrSpeed_mps[above] < speed_mps) ++above;
  const LqrGain &low = gains.at_speed[above - 1], &high = gains.at_speed[above];
  const double share = std::clamp(
      (speed_mps - kLqrSpeed_mps[above - 1]) / (kLqrSpeed_mps[above] - kLqrSpeed_mps[above - 1]),
      0.0, 1.0);
  LqrGain gain;
  for (std::size_t i = 0; i < gain.error.size(); ++i)
    gain.error[i] = std::lerp(low.error[i], high.error[i], share);
  gain.wheel = std::lerp(low.wheel, high.wheel, share);
  for (std::size_t i = 0; i < gains.delay_ticks; ++i)
    gain.sent[i] = std::lerp(low.sent[i], high.sent[i], share);
  return gain;
}

}  // namespace pitwall::control
