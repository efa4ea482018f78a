// Small plant for the tests of control: a single-track car with saturating tyres on a banked road,
// with steering delay and lag, first-order brake and throttle, on a closed path. For tests only; it
// shares no code with the code under test or with the bench.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>
#include <vector>

#include "tests/vehicle/envelope/car.hpp"
#include "vehicle/autonomy/control/control.hpp"

namespace pitwall::control::testing {

constexpr double kStep_s = 0.001;
constexpr double kPathStep_m = 0.5;

struct Path {
  std::vector<world::TrajectoryPoint> points;  // closed

  world::Trajectory window(double s_m, double speed_mps, double spacing_m = 2.5) const {
    world::Trajectory t;
    const auto first = static_cast<std::size_t>(std::max(s_m, 0.0) / kPathStep_m);
    const auto stride = static_cast<std::size_t>(spacing_m / kPathStep_m);
    for (std::size_t i = 0; i < world::kTrajectoryPoints; ++i) {
      world::TrajectoryPoint p = points[(first + i * stride) % points.size()];
      p.s_m = static_cast<double>(i) * spacing_m;
      p.speed_mps = speed_mps;
      p.accel_mps2 = 0.0;
      if (!t.points.push(p)) break;
    }
    return t;
  }
};

// Two straights of `straight_m` with banking 9 degrees and two half turns of radius 220 m banked 20
// degrees, joined by clothoids of 120 m over which the banking rises as well.
inline Path oval(double straight_m = 500.0) {
  constexpr double kTurn_per_m = 1.0 / 220.0, kClothoid_m = 120.0;
  const double arc_m = std::numbers::pi / kTurn_per_m - kClothoid_m;
  const double half_m = straight_m + 2.0 * kClothoid_m + arc_m;
  const auto share = [&](double s_m) {  // of the full curvature
    const double s = std::fmod(s_m, half_m) - straight_m;
    if (s <= 0.0) return 0.0;
    if (s < kClothoid_m) return s / kClothoid_m;
    if (s < kClothoid_m + arc_m) return 1.0;
    return std::max(0.0, (2.0 * kClothoid_m + arc_m - s) / kClothoid_m);
  };
  Path path;
  double x = 0.0, y = 0.0, yaw = 0.0;
  const auto count = static_cast<std::size_t>(2.0 * half_m / kPathStep_m);
  for (std::size_t i = 0; i < count; ++i) {
    const double s = static_cast<double>(i) * kPathStep_m;
    const double turn = share(s);
    path.points.push_back({.s_m = s,
                           .x_m = x,
                           .y_m = y,
                           .yaw_rad = wrap_pi(yaw),
                           .curvature_per_m = kTurn_per_m * turn,
                           .bank_rad = from_deg(9.0 + 11.0 * turn)});
    const double mid = yaw + 0.5 * kPathStep_m * kTurn_per_m * turn;
    x += kPathStep_m * std::cos(mid);
    y += kPathStep_m * std::sin(mid);
    yaw += kPathStep_m * kTurn_per_m * 0.5 * (turn + share(s + kPathStep_m));
  }
  return path;
}

struct CarModel {
  double mass_kg = 790.0, yaw_inertia_kg_m2 = 900.0, front_m = 1.724, rear_m = 1.247;
  double front_per_load = 44.0, rear_per_load = 47.0;  // cornering stiffness / load [1/rad]
  double friction = 1.4;
  double downforce_front_per_m = 0.00046, downforce_rear_per_m = 0.00084;  // / mass v^2
  double drag_per_m = 0.00061, rolling_mps2 = 0.12;
  double steering_delay_s = 0.040, steering_lag_s = 0.060;
  double full_throttle_mps2 = 5.5, brake_mps2_per_kpa = 0.0027;
  double throttle_lag_s = 0.05, brake_lag_s = 0.1;
};

struct Car {
  CarModel model;
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0, vx_mps = 0.0, vy_mps = 0.0, yaw_rate_rad_per_s = 0.0;
  double angle_rad = 0.0, throttle = 0.0, brake_kpa = 0.0, ax_mps2 = 0.0;
  std::deque<double> delayed;

  // tanh tyre: the initial slope is the given one, the force saturates at friction * load.
  double tyre(double slip_rad, double per_load, double load_n) const {
    const double peak_n = model.friction * load_n;
    return -peak_n * std::tanh(per_load * load_n * slip_rad / peak_n);
  }

  void move(const world::ActuatorCommand& command, double bank_rad) {
    const CarModel& c = model;
    delayed.push_back(command.road_wheel_rad);
    if (static_cast<double>(delayed.size()) * kStep_s > c.steering_delay_s) {
      angle_rad += kStep_s / c.steering_lag_s * (delayed.front() - angle_rad);
      delayed.pop_front();
    }
    throttle += kStep_s / c.throttle_lag_s * (command.throttle_fraction - throttle);
    brake_kpa += kStep_s / c.brake_lag_s * (command.brake_kpa - brake_kpa);
    const double v = std::max(vx_mps, 0.5), l = c.front_m + c.rear_m;
    const double heading_rate = yaw_rate_rad_per_s / std::cos(bank_rad);
    const double n = kGravity_mps2 * std::cos(bank_rad) + v * heading_rate * std::sin(bank_rad);
    const double load_f = c.mass_kg * (n * c.rear_m / l + c.downforce_front_per_m * v * v);
    const double load_r = c.mass_kg * (n * c.front_m / l + c.downforce_rear_per_m * v * v);
    const double slip_f = std::atan2(vy_mps + c.front_m * yaw_rate_rad_per_s, v) - angle_rad;
    const double slip_r = std::atan2(vy_mps - c.rear_m * yaw_rate_rad_per_s, v);
    const double ff = tyre(slip_f, c.front_per_load, load_f);
    const double fr = tyre(slip_r, c.rear_per_load, load_r);
    const double resist = c.drag_per_m * v * v + c.rolling_mps2 + c.brake_mps2_per_kpa * brake_kpa;
    ax_mps2 = c.full_throttle_mps2 * throttle - resist - ff * std::sin(angle_rad) / c.mass_kg;
    const double ay = (ff * std::cos(angle_rad) + fr) / c.mass_kg;
    vx_mps = std::max(0.0, vx_mps + kStep_s * (ax_mps2 + vy_mps * yaw_rate_rad_per_s));
    vy_mps += kStep_s * (ay + kGravity_mps2 * std::sin(bank_rad) - vx_mps * yaw_rate_rad_per_s);
    yaw_rate_rad_per_s +=
        kStep_s * (c.front_m * ff * std::cos(angle_rad) - c.rear_m * fr) / c.yaw_inertia_kg_m2;
    if (vx_mps < 1.0) vy_mps *= 0.99, yaw_rate_rad_per_s *= 0.99;
    const double across = vy_mps * std::cos(bank_rad);
    x_m += kStep_s * (vx_mps * std::cos(yaw_rad) - across * std::sin(yaw_rad));
    y_m += kStep_s * (vx_mps * std::sin(yaw_rad) + across * std::cos(yaw_rad));
    yaw_rad += kStep_s * heading_rate;
  }

  world::EgoState ego(Instant now) const {
    return {.at = now,
            .validity = world::Validity::kGood,
            .x_m = x_m,
            .y_m = y_m,
            .yaw_rad = wrap_pi(yaw_rad),
            .vx_mps = vx_mps,
            .vy_mps = vy_mps,
            .yaw_rate_rad_per_s = yaw_rate_rad_per_s,
            .ax_mps2 = ax_mps2,
            .ay_mps2 = 0.0,
            .position_sigma_m = 0.02,
            .yaw_sigma_rad = 0.002};
  }
};

struct Lap {
  double cross_track_max_m = 0.0, cross_track_mean_m = 0.0, angle_rate_rms_rad_per_s = 0.0;
  double speed_error_max_mps = 0.0;
  bool lost = false;  // more than 5 m from the path, or spun
};

// Drives for `duration_s` from the start of the path; the first `settle_s` are not graded.
inline Lap drive(const Params& params, const LateralGains& gains, const Path& path,
                 const CarModel& model, double speed_mps, double duration_s,
                 double settle_s = 4.0) {
  Car car;
  car.model = model;
  car.vx_mps = speed_mps;
  car.x_m = path.points[0].x_m;
  car.y_m = path.points[0].y_m;
  car.yaw_rad = path.points[0].yaw_rad;
  State state;
  state.gear.gear = 3;
  steering::Learned learned;
  Lap lap;
  std::size_t near = 0, graded = 0;
  double angle_rate2 = 0.0;
  const auto ticks = static_cast<int>(duration_s * 100.0);
  for (int i = 0; i < ticks; ++i) {
    const Instant now{static_cast<std::int64_t>(i) * 10'000'000};
    const auto distance = [&](std::size_t k) {
      const auto& p = path.points[k % path.points.size()];
      return std::hypot(p.x_m - car.x_m, p.y_m - car.y_m);
    };
    while (distance(near + 1) < distance(near)) ++near;
    const std::size_t start = (near + path.points.size() - 10) % path.points.size();
    const world::Trajectory t = path.window(static_cast<double>(start) * kPathStep_m, speed_mps);
    const world::EgoState ego = car.ego(now);
    const double bank_rad = path.points[near % path.points.size()].bank_rad;
    const steering::Params& p = params.steering;
    steering::follow_command(p.learning, learned, state.road_wheel_rad, milliseconds(10));
    steering::learn(p.learning, p.bicycle, learned, {ego.vx_mps, ego.yaw_rate_rad_per_s, bank_rad},
                    milliseconds(10));
    const Output out = step(params, gains, state, {.ego = ego, .trajectory = t, .learned = learned},
                            now, milliseconds(10));
    const double rate = (out.next.road_wheel_rad - state.road_wheel_rad) / 0.01;
    state = out.next;
    for (int k = 0; k < 10; ++k) car.move(out.command, bank_rad);
    if (distance(near) > 5.0 || std::abs(car.vy_mps) > 0.5 * car.vx_mps)
      return lap.lost = true, lap;
    if (i < static_cast<int>(settle_s * 100.0)) continue;
    ++graded;
    const double cross = std::abs(out.lateral.cross_track_m);
    lap.cross_track_max_m = std::max(lap.cross_track_max_m, cross);
    lap.cross_track_mean_m += cross;
    lap.speed_error_max_mps = std::max(lap.speed_error_max_mps, std::abs(car.vx_mps - speed_mps));
    angle_rate2 += rate * rate;
  }
  lap.cross_track_mean_m /= static_cast<double>(std::max<std::size_t>(graded, 1));
  lap.angle_rate_rms_rad_per_s =
      std::sqrt(angle_rate2 / static_cast<double>(std::max<std::size_t>(graded, 1)));
  return lap;
}

inline LqrParams recommended_lqr_ff() {
  return {.weights = {{{0.001, 1400.0},
                       {0.001, 1400.0},
                       {0.02, 1500.0},
                       {0.24, 2800.0},
                       {0.24, 4000.0},
                       {0.014, 2400.0},
                       {0.013, 2900.0},
                       {0.011, 4600.0},
                       {0.017, 20000.0}}},
          .delay_s = 0.06,
          .lag_s = 0.06,
          .tyre_share = 0.5,
          .slip_s = 1.0,
          .trim_per_s = 0.05};
}

inline LapParams recommended_lap() {
  return {.gain = 0.62,
          .forget = 0.04,
          .lead_s = 0.395,
          .smooth_s = 0.2,
          .angle_max_rad = 0.01,
          .slew_rad_per_s = 0.03,
          .speed_share = 0.1};
}

// Recommended parameters of the AV-21.
inline Params recommended() {
  Params p;
  p.controller = controller_named("paper_lqr");
  p.bicycle = {.mass_kg = 790.0,
               .yaw_inertia_kg_m2 = 1000.0,
               .cg_to_front_m = 1.724,
               .cg_to_rear_m = 1.247,
               .cornering_front_n_per_rad = 180e3,
               .cornering_rear_n_per_rad = 260e3};
  for (std::size_t i = 0; i < kSpeedBrackets; ++i) {
    const double from_mps = kBracketFrom_mps[i];
    p.lateral.weights[i] = {.state = {1.0, 0.0, 1.0, 0.0},
                            .steering = from_mps < 20.0   ? 400.0
                                        : from_mps < 45.0 ? 1000.0
                                                          : 2500.0};
  }
  p.lateral.lookahead_base_m = 4.0;
  p.lateral.lookahead_per_speed_s = 0.2;
  p.lateral.angle_max_rad = 0.1;
  p.lateral.gain_speed_floor_mps = 5.0;
  p.lateral.deviation_max_m = 5.0;
  p.lqr_ff = recommended_lqr_ff();
  p.lap = recommended_lap();
  p.longitudinal = {.kp_per_mps = 0.2,
                    .feedforward_per_mps = 0.008,
                    .brake_kpa_per_command = 7000.0,
                    .speed_preview_s = 0.2,
                    .throttle_max = 1.0,
                    .throttle_rise_per_s = 2.0,
                    .throttle_fall_per_s = 5.0,
                    .brake_max_kpa = 5500.0,
                    .brake_rise_kpa_per_s = 10000.0,
                    .brake_fall_kpa_per_s = 20000.0,
                    .hold_speed_mps = 0.5,
                    .hold_brake_kpa = 800.0};
  p.steering = {.bicycle = {.wheelbase_m = 2.971, .understeer_rad_per_mps2 = 0.0002},
                .learning = {},
                .bandwidth_rad_per_s = 1.4,
                .damping = 0.85,
                .lead_s = 0.3,
                .gain_share = 0.3,
                .observer_s = 0.5,
                .observer_share = 0.5,
                .trim_per_s = 0.05,
                .settle_s = 1.0,
                .correction_max_rad = 0.03,
                .gain_speed_least_mps = 8.0,
                .hold_speed_mps = 0.5};
  p.gear = {.up_above_mps = {21.5, 33.5, 45.5, 56.5, 65.5},
            .down_below_mps = {19.0, 30.5, 42.0, 52.5, 61.0},
            .dwell_s = 0.8,
            .confirm_s = 0.7};
  p.speed = {.accel_preview_s = 0.1,
             .kp_per_s = 1.5,
             .ki_per_s2 = 0.4,
             .feedback_max_mps2 = 3.0,
             .integral_max_mps2 = 1.5,
             .rolling_mps2 = 0.13,
             .dead_zone_mps2 = 0.3,
             .grip_share = 0.9,
             .car = envelope::testing::av21(),  // its engine unknown, as that of the model here
             .brake_kpa_per_mps2 = 350.0};

  return p;
}

}  // namespace pitwall::control::testing
