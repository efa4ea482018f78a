// Linear single-track car with steering delay and lag, at constant speed along a straight, under
// the control law of steering. It shares no code with the code under test.
//   source Rajamani, Vehicle Dynamics and Control, 2nd ed., eq. 2.31 (single track)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>

#include "tests/support/tick.hpp"
#include "vehicle/steering/path_steering.hpp"

namespace pitwall::steering::testing {

constexpr double kMass_kg = 790.0, kInertia_kg_m2 = 1000.0, kFront_m = 1.724, kRear_m = 1.247;
constexpr double kRearSlope_n_per_rad = 260e3;  // cornering stiffness of both rear tyres

// Cornering stiffness of the front tyres that gives the understeer gradient with that of the rear.
constexpr double front_slope(double understeer, double rear_n_per_rad) {
  return kRear_m / (understeer * (kFront_m + kRear_m) / kMass_kg + kFront_m / rear_n_per_rad);
}

struct CarCase {
  double speed_mps = 65.0;
  double understeer = 0.0002;  // rad/(m/s^2)
  double tyre_share = 1.0;  // factor of the rear tyres' stiffness; the front follows `understeer`
  double delay_s = 0.04, lag_s = 0.06;
  bool learned = true;  // the control law has learned the understeer
};

class LinearCar {
 public:
  explicit LinearCar(const CarCase& c) : case_(c) {
    rear_ = c.tyre_share * kRearSlope_n_per_rad;
    front_ = front_slope(c.understeer, rear_);
    delayed_.assign(static_cast<std::size_t>(std::lround(c.delay_s / kStep_s)), 0.0);
  }

  double y_m = 0.0, yaw_rad = 0.0, vy_mps = 0.0, yaw_rate_rad_per_s = 0.0, angle_rad = 0.0;

  double course_rad() const { return yaw_rad + std::atan2(vy_mps, case_.speed_mps); }

  void tick(double command_rad) {
    for (double t = 0.0; t < kTick.seconds() - 0.5 * kStep_s; t += kStep_s) move(command_rad);
  }

 private:
  static constexpr double kStep_s = 0.001;

  void move(double command_rad) {
    delayed_.push_back(command_rad);
    angle_rad += kStep_s / case_.lag_s * (delayed_.front() - angle_rad);
    delayed_.pop_front();
    const double v = case_.speed_mps;
    const double front_n = front_ * (angle_rad - (vy_mps + kFront_m * yaw_rate_rad_per_s) / v);
    const double rear_n = -rear_ * (vy_mps - kRear_m * yaw_rate_rad_per_s) / v;
    vy_mps += kStep_s * ((front_n + rear_n) / kMass_kg - v * yaw_rate_rad_per_s);
    yaw_rate_rad_per_s += kStep_s * (kFront_m * front_n - kRear_m * rear_n) / kInertia_kg_m2;
    yaw_rad += kStep_s * yaw_rate_rad_per_s;
    y_m += kStep_s * (v * std::sin(yaw_rad) + vy_mps * std::cos(yaw_rad));
  }

  CarCase case_;
  double front_ = 0.0, rear_ = 0.0;
  std::deque<double> delayed_;
};

// Parameters of the earlier control law: stiffer, and without the lead of the yaw rate.
inline Params stiff() {
  Params p;
  p.bandwidth_rad_per_s = 2.5, p.damping = 0.9, p.lead_s = 0.0, p.gain_share = 0.0;
  p.observer_s = 0.3, p.observer_share = 1.0, p.trim_per_s = 0.3, p.settle_s = 0.4;
  p.learning.lag_s = 0.1;
  return p;
}

// Result of a start beside the path: the largest distance in each span of five seconds.
struct Settling {
  std::array<double, 6> worst_m{};
  double angle_rate_late_rad_per_s = 0.0;  // largest, in the last span
};

inline Settling settle(const Params& params, const CarCase& c, double beside_m) {
  LinearCar car{c};
  car.y_m = beside_m;
  Learned learned;
  if (c.learned)
    learned.understeer_rad_per_mps2 = c.understeer - params.bicycle.understeer_rad_per_mps2;
  State state;
  Settling out;
  double angle_rad = 0.0;
  constexpr std::size_t kSpan = 500;
  for (std::size_t i = 0; i < kSpan * out.worst_m.size(); ++i) {
    follow_command(params.learning, learned, angle_rad, kTick);
    const double before_rad = angle_rad;
    angle_rad = steer(params, learned, state,
                      {.deviation = {std::clamp(car.y_m, -1e3, 1e3), car.course_rad(), 0.0, 0.0},
                       .ahead = {0.0, 0.0, 0.0},
                       .speed_mps = c.speed_mps,
                       .yaw_rate_rad_per_s = car.yaw_rate_rad_per_s,
                       .last_angle_rad = angle_rad,
                       .angle_max_rad = 0.2},
                      kTick);
    car.tick(angle_rad);
    double& worst = out.worst_m[i / kSpan];
    worst = std::max(worst, std::abs(car.y_m));
    if (i >= kSpan * (out.worst_m.size() - 1))
      out.angle_rate_late_rad_per_s =
          std::max(out.angle_rate_late_rad_per_s, std::abs(angle_rad - before_rad) / 0.01);
  }
  return out;
}

}  // namespace pitwall::steering::testing
