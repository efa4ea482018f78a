// Open and closed loop of the steering control law with a linear car on a straight road, in
// discrete time. The loop is cut at the steering command. The car has a zero-order hold of one tick
// and a delay of whole ticks; the control law is linearised by finite differences of its own code.
// The internal loop of the law over its own command (the observer) stays closed.
//   units  SI; from the car to the law: distance to the left, course, yaw rate, slip (speed to the
//          left)
//   source Rajamani, Vehicle Dynamics and Control, 2nd ed., eq. 2.31 (single track) and 3.12
//          (critical speed); Pacejka, Tire and Vehicle Dynamics, 2012, ch. 7 (relaxation)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

#include "tests/support/eigenvalues.hpp"
#include "tests/support/tick.hpp"
#include "tests/vehicle/steering/discrete_system.hpp"
#include "tests/vehicle/steering/linear_car.hpp"
#include "vehicle/steering/path_steering.hpp"

namespace pitwall::steering::testing {

constexpr double kComputerAndBus_s = 0.02;
constexpr double kRelaxation_m = 0.5;      // longest relaxation length of tests/hil/plant/family
constexpr double kFrictionOfSlopes = 1.3;  // where the rear slope is kRearSlope_n_per_rad

struct LoopCase {
  double speed_mps = 65.0;
  double understeer = 0.0002;  // rad/(m/s^2), with undamaged tyres
  double friction = kFrictionOfSlopes;
  double front_share = 1.0, rear_share = 1.0;  // share of the cornering stiffness
  double delay_s = 0.04, lag_s = 0.06;         // of the steering actuator
  bool learned = true;                         // the law knows `understeer`
};

struct Slopes {
  double front_n_per_rad, rear_n_per_rad;
};

inline Slopes slopes_of(const LoopCase& c) {
  const double rear = kRearSlope_n_per_rad * c.friction / kFrictionOfSlopes;
  return {c.front_share * front_slope(c.understeer, rear), c.rear_share * rear};
}

// Critical speed: above it the car with a fixed steering angle is unstable. Infinite for a car that
// understeers.
inline double critical_speed_mps(const LoopCase& c) {
  const Slopes slopes = slopes_of(c);
  const double length_m = kFront_m + kRear_m;
  const double gradient =
      kMass_kg / length_m * (kRear_m / slopes.front_n_per_rad - kFront_m / slopes.rear_n_per_rad);
  return gradient < 0.0 ? std::sqrt(length_m / -gradient) : std::numeric_limits<double>::infinity();
}

constexpr std::size_t kMeasured = 4;
using CarSystem = DiscreteSystem<7, 1, kMeasured>;
template <std::size_t kStates>
using LawSystemOf = DiscreteSystem<kStates, kMeasured, 1>;
using LawSystem = LawSystemOf<5>;

// The car without the delay. States: steering angle, built-up slip of the front and of the rear
// tyres, lateral speed, yaw rate, yaw, distance from the path.
inline CarSystem car_of(const LoopCase& c) {
  const Slopes slopes = slopes_of(c);
  const double v = c.speed_mps, builds_per_s = v / kRelaxation_m;
  Matrix<7, 7> a{};
  a[0][0] = -1.0 / c.lag_s;
  a[1] = {builds_per_s, -builds_per_s, 0.0, -builds_per_s / v, -builds_per_s * kFront_m / v};
  a[2] = {0.0, 0.0, -builds_per_s, -builds_per_s / v, builds_per_s * kRear_m / v};
  a[3] = {0.0, slopes.front_n_per_rad / kMass_kg, slopes.rear_n_per_rad / kMass_kg, 0.0, -v};
  a[4] = {0.0, kFront_m * slopes.front_n_per_rad / kInertia_kg_m2,
          -kRear_m * slopes.rear_n_per_rad / kInertia_kg_m2};
  a[5][4] = 1.0;
  a[6] = {0.0, 0.0, 0.0, 1.0, 0.0, v};
  Matrix<kMeasured, 7> out{};
  out[0][6] = 1.0;
  out[1] = {0.0, 0.0, 0.0, 1.0 / v, 0.0, 1.0};
  out[2][4] = 1.0;
  out[3][3] = 1.0;
  return held(a, {1.0 / c.lag_s}, out, kTick.seconds());
}

inline std::size_t delay_ticks(const LoopCase& c) {
  return static_cast<std::size_t>(std::lround((c.delay_s + kComputerAndBus_s) / kTick.seconds()));
}

// One tick of the law, called as in a stop, near a straight. State: d, trim, bump, the filtered
// command, the command.
inline std::array<double, 5> law_tick(const Params& params, const LoopCase& c,
                                      const std::array<double, 5>& x,
                                      const std::array<double, kMeasured>& measured) {
  Learned learned{.commanded_rad = x[3]};
  if (c.learned)
    learned.understeer_rad_per_mps2 = c.understeer - params.bicycle.understeer_rad_per_mps2;
  State state{.begun = true, .unknown_rad = x[0], .trim_rad = x[1], .bump_rad = x[2]};
  follow_command(params.learning, learned, x[4], kTick);
  const double angle_rad = steer(params, learned, state,
                                 {.deviation = {measured[0], measured[1], 0.0, 0.0},
                                  .ahead = {0.0, 0.0, 0.0},
                                  .speed_mps = c.speed_mps,
                                  .yaw_rate_rad_per_s = measured[2],
                                  .last_angle_rad = x[4],
                                  .angle_max_rad = 1.0},
                                 kTick);
  return {state.unknown_rad, state.trim_rad, state.bump_rad, learned.commanded_rad, angle_rad};
}

// Linearisation at zero of a law: of its states and what is measured, its next states, the last of
// which is its command. Exact except for rounding while the law is linear within `step`.
template <std::size_t kStates, class Tick>
LawSystemOf<kStates> linearised(const Tick& tick, double step = 1e-4) {
  LawSystemOf<kStates> law;
  for (std::size_t i = 0; i < kStates + kMeasured; ++i) {
    const auto moved = [&](double by) {
      std::array<double, kStates> x{};
      std::array<double, kMeasured> measured{};
      (i < kStates ? x[i] : measured[i - kStates]) = by;
      return tick(x, measured);
    };
    const std::array<double, kStates> high = moved(step), low = moved(-step);
    const auto slope = [&](std::size_t k) { return (high[k] - low[k]) / (2.0 * step); };
    for (std::size_t k = 0; k < kStates; ++k)
      (i < kStates ? law.a[k][i] : law.b[k][i - kStates]) = slope(k);
    (i < kStates ? law.c[0][i] : law.d[0][i - kStates]) = slope(kStates - 1);
  }
  return law;
}

inline LawSystem law_of(const Params& params, const LoopCase& c, double step = 1e-4) {
  return linearised<5>(
      [&](const auto& x, const auto& measured) { return law_tick(params, c, x, measured); }, step);
}

template <std::size_t kLaw>
struct LoopOf {
  CarSystem car;
  LawSystemOf<kLaw> law;
  std::size_t delay_ticks = 0;
};
using Loop = LoopOf<5>;

inline Loop loop_of(const Params& params, const LoopCase& c) {
  return {car_of(c), law_of(params, c), delay_ticks(c)};
}

// Frequency response of the open loop. The closed loop is on the stability limit where this is -1.
template <std::size_t kLaw>
std::complex<double> response(const LoopOf<kLaw>& loop, double rad_per_s) {
  const std::complex<double> z = std::polar(1.0, rad_per_s * kTick.seconds());
  const auto car = response(loop.car, z);
  const auto law = response(loop.law, z);
  std::complex<double> sum = 0.0;
  for (std::size_t i = 0; i < kMeasured; ++i) sum -= law[0][i] * car[i][0];
  return sum * std::pow(z, -static_cast<int>(loop.delay_ticks));
}

// Largest modulus of the poles of the closed loop, with an additional gain and additional ticks of
// delay. States: those of the car, the delayed commands, those of the law.
template <std::size_t kLaw>
double spectral_radius(const LoopOf<kLaw>& loop, double gain = 1.0, std::size_t more_ticks = 0) {
  const std::size_t ticks = loop.delay_ticks + more_ticks, size = 7 + ticks + kLaw, law = 7 + ticks;
  std::vector<double> m(size * size, 0.0);
  const auto at = [&](std::size_t row, std::size_t column) -> double& {
    return m[column * size + row];
  };
  for (std::size_t i = 0; i < 7; ++i) {
    for (std::size_t j = 0; j < 7; ++j) at(i, j) = loop.car.a[i][j];
    at(i, law - 1) = gain * loop.car.b[i][0];
  }
  for (std::size_t i = 8; i < law; ++i) at(i, i - 1) = 1.0;
  const auto measured_into = [&](std::size_t row, const std::array<double, kMeasured>& weights) {
    for (std::size_t o = 0; o < kMeasured; ++o)
      for (std::size_t j = 0; j < 7; ++j) at(row, j) += weights[o] * loop.car.c[o][j];
  };
  measured_into(7, loop.law.d[0]);
  for (std::size_t j = 0; j < kLaw; ++j) at(7, law + j) = loop.law.c[0][j];
  for (std::size_t i = 0; i < kLaw; ++i) {
    measured_into(law + i, loop.law.b[i]);
    for (std::size_t j = 0; j < kLaw; ++j) at(law + i, law + j) = loop.law.a[i][j];
  }
  return pitwall::testing::largest_modulus(m);
}

}  // namespace pitwall::steering::testing
