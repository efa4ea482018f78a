// SPDX-License-Identifier: Apache-2.0
#include "tests/hil/plant/family/steady_turn.hpp"

#include "hil/plant/plant.hpp"

namespace pitwall::plant {
namespace {

constexpr double kTurn_mps2 = 2.0;  // of a car that steers neutrally
constexpr double kPeriod_s = 0.01;
constexpr int kSettling = 100, kAveraged = 20;  // periods

}  // namespace

double understeer_of(const Params& params, double speed_mps) {
  Params p = params;
  p.steering.delay_s = p.steering.quantum_rad = 0.0;
  const double wheelbase_m = p.chassis.front_axle_m + p.chassis.rear_axle_m;
  const double angle_rad = wheelbase_m * kTurn_mps2 / (speed_mps * speed_mps);
  const Actuation held{.steering_motor_rad = angle_rad * p.steering.ratio};
  State s = rolling(p, standing(p, 0.0, 0.0, 0.0), speed_mps, 0);
  s.motion.steering_motor_rad = held.steering_motor_rad;
  double yaw_rate_sum = 0.0;
  for (int i = 0; i < kSettling + kAveraged; ++i) {
    s = step(p, s, held, {}, kPeriod_s);
    s.motion.vx_mps = speed_mps;
    if (i >= kSettling) yaw_rate_sum += s.motion.yaw_rate_rad_per_s;
  }
  const double yaw_rate = yaw_rate_sum / kAveraged;
  return (angle_rad - wheelbase_m * yaw_rate / speed_mps) / (speed_mps * yaw_rate);
}

}  // namespace pitwall::plant
