// A car of which everything is known in closed form, and the sensors that watch it: a circle of any
// radius on a banked road at constant speed, or a straight. Written for the tests alone.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "vehicle/autonomy/localization/localization.hpp"

namespace pitwall::localization::testing {

constexpr double kLatitude_deg = 36.2722, kLongitude_deg = -115.0103, kHeight_m = 594.0;

// splitmix64; the sum of twelve uniform numbers is normal enough for 6 sigma.
struct Random {
  std::uint64_t state = 1;

  double uniform() {
    std::uint64_t z = (state += 0x9E3779B97F4A7C15ULL);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
  }
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += uniform();
    return sum;
  }
};

inline Params recommended() {
  Params p;
  p.units[0] = {.antenna = {-0.005, 0.0, 0.676}, .baseline_yaw_rad = 0.0};
  p.units[1] = {.antenna = {0.758, -0.497, 0.109}, .baseline_yaw_rad = std::numbers::pi / 2.0};
  p.timeline = {.noise = {.gyro_rad_per_sqrt_s = 5e-4,
                          .accel_mps_per_sqrt_s = 0.1,
                          .lateral_mps_per_sqrt_s = 0.3,
                          .gyro_bias_rad_per_s_sqrt_s = 5e-5,
                          .position_m_per_sqrt_s = 0.005},
                .gate_nis = {12.0, 16.0},
                .window_s = 0.25};
  p.position_sigma_floor_m = 0.02, p.position_sigma_max_m = 1.0;
  p.velocity_sigma_mps = 0.06;
  p.heading_sigma_floor_rad = 0.002, p.heading_sigma_max_rad = 0.05;
  p.wheel_sigma_mps = 0.2, p.wheel_sigma_per_speed = 0.08;
  p.slip_sigma_mps = 1.5, p.slip_after_s = 0.3;
  p.cg_to_rear_m = 1.247, p.rear_slip_rad_per_mps2 = 0.0014;
  p.steering_ratio = 19.5, p.wheelbase_m = 2.971, p.understeer_rad_per_mps2 = 0.0006;
  p.imu_timeout_s = 0.05;
  p.good_age_max_s = 0.3, p.dead_reckoning_max_s = 15.0;
  p.good_sigma_max_m = 0.5, p.lost_sigma_max_m = 5.0;
  p.reset_after_s = 2.0;
  return p;
}

// Constant motion: a straight when curvature is zero.
struct Course {
  double curvature_per_m = 0.0, bank_rad = 0.0;
  double vx_mps = 30.0, vy_mps = 0.0, yaw0_rad = 0.4, x0_m = 120.0, y0_m = -80.0;

  double over_ground_mps() const { return std::hypot(vx_mps, vy_mps * std::cos(bank_rad)); }
  double heading_rate() const { return over_ground_mps() * curvature_per_m; }
  double yaw_rate() const { return heading_rate() * std::cos(bank_rad); }
  double slip_rad() const { return std::atan2(vy_mps * std::cos(bank_rad), vx_mps); }

  world::EgoState at(double t_s) const {
    const double course = yaw0_rad + slip_rad() + heading_rate() * t_s;
    const double start = yaw0_rad + slip_rad();
    world::EgoState e;
    e.yaw_rad = wrap_pi(yaw0_rad + heading_rate() * t_s);
    if (curvature_per_m == 0.0) {
      e.x_m = x0_m + over_ground_mps() * t_s * std::cos(start);
      e.y_m = y0_m + over_ground_mps() * t_s * std::sin(start);
    } else {
      e.x_m = x0_m + (std::sin(course) - std::sin(start)) / curvature_per_m;
      e.y_m = y0_m - (std::cos(course) - std::cos(start)) / curvature_per_m;
    }
    e.vx_mps = vx_mps, e.vy_mps = vy_mps;
    e.yaw_rate_rad_per_s = yaw_rate();
    e.ax_mps2 = -yaw_rate() * vy_mps;  // specific force
    e.ay_mps2 = yaw_rate() * vx_mps - kGravity_mps2 * std::sin(bank_rad);
    return e;
  }
};

// Steady driving with the side slip that the tyre model of the recommended parameters gives.
inline Course banked_turn(double speed_mps = 55.0) {
  Course c{.curvature_per_m = 1.0 / 220.0, .bank_rad = from_deg(20.0), .vx_mps = speed_mps};
  const double lateral = c.at(0.0).ay_mps2;
  c.vy_mps = 1.247 * c.yaw_rate() - speed_mps * 0.0014 * lateral;
  return c;
}

struct SensorModel {
  double position_sigma_m = 0.015, velocity_sigma_mps = 0.03, heading_sigma_rad = 0.0017;
  double gyro_sigma_rad_per_s = 0.0017, gyro_bias_rad_per_s = 0.003, accel_sigma_mps2 = 0.05;
  double wheel_sigma_mps = 0.05;
  bool unit_silent[2] = {false, false};
  bool no_fix = false;
  double bias_east_m[2] = {0.0, 0.0};
};

// Runs the car and the filter side by side at 100 Hz.
struct Rig {
  Course course;
  SensorModel sensors;
  Params params = recommended();
  Datum datum = Datum::at(kLatitude_deg, kLongitude_deg, kHeight_m).value();
  GeographicLib::LocalCartesian plane{kLatitude_deg, kLongitude_deg, kHeight_m};
  Random random;
  State state;
  std::int64_t ms = 0;
  world::VehicleSignals signals;
  Output out;

  world::EgoState truth() const { return course.at(static_cast<double>(ms) * 1e-3); }

  // Where the antenna of a unit is, from the car's pose; the tilt of the bank leans the mast.
  void antenna(const world::EgoState& car, std::size_t unit, double& x, double& y) const {
    const LeverArm& a = params.units[unit].antenna;
    const double b = course.bank_rad;
    const double left = a.y_m * std::cos(b) + a.z_m * std::sin(b);
    x = car.x_m + a.x_m * std::cos(car.yaw_rad) - left * std::sin(car.yaw_rad);
    y = car.y_m + a.x_m * std::sin(car.yaw_rad) + left * std::cos(car.yaw_rad);
  }

  world::GnssPosition position(std::size_t unit, std::int64_t at_ms) {
    double x = 0.0, y = 0.0;
    antenna(course.at(static_cast<double>(at_ms) * 1e-3), unit, x, y);
    world::GnssPosition p;
    p.unit = static_cast<std::uint8_t>(unit);
    p.at = Instant{at_ms * 1'000'000};
    p.solution_status = sensors.no_fix ? 1 : world::kSolutionComputed;
    p.position_type = sensors.no_fix ? world::kPositionNone : world::kPositionNarrowInt;
    plane.Reverse(x + sensors.position_sigma_m * random.normal() + sensors.bias_east_m[unit],
                  y + sensors.position_sigma_m * random.normal(), 0.0, p.latitude_deg,
                  p.longitude_deg, p.height_m);
    p.latitude_sigma_m = p.longitude_sigma_m = p.height_sigma_m = sensors.position_sigma_m;
    p.satellites = 16;
    return p;
  }

  // Central difference of the antenna's own path: knows nothing of lever-arm formulas.
  world::GnssVelocity velocity(std::size_t unit, std::int64_t at_ms) {
    const double t = static_cast<double>(at_ms) * 1e-3, h = 1e-4;
    double x1 = 0.0, y1 = 0.0, x2 = 0.0, y2 = 0.0;
    antenna(course.at(t - h), unit, x1, y1);
    antenna(course.at(t + h), unit, x2, y2);
    const double east = (x2 - x1) / (2 * h) + sensors.velocity_sigma_mps * random.normal();
    const double north = (y2 - y1) / (2 * h) + sensors.velocity_sigma_mps * random.normal();
    world::GnssVelocity v;
    v.unit = static_cast<std::uint8_t>(unit);
    v.at = Instant{at_ms * 1'000'000};
    v.solution_status = sensors.no_fix ? 1 : world::kSolutionComputed;
    v.velocity_type = sensors.no_fix ? world::kPositionNone : world::kPositionNarrowInt;
    v.horizontal_mps = std::hypot(east, north);
    v.track_over_ground_rad = std::atan2(east, north);
    v.vertical_mps = 0.0;
    return v;
  }

  world::GnssHeading heading(std::size_t unit, std::int64_t at_ms) {
    const double yaw = course.at(static_cast<double>(at_ms) * 1e-3).yaw_rad;
    world::GnssHeading h;
    h.unit = static_cast<std::uint8_t>(unit);
    h.at = Instant{at_ms * 1'000'000};
    h.solution_status = sensors.no_fix ? 1 : world::kSolutionComputed;
    h.position_type = sensors.no_fix ? world::kPositionNone : world::kPositionNarrowInt;
    h.heading_rad = 0.5 * std::numbers::pi - yaw - params.units[unit].baseline_yaw_rad +
                    sensors.heading_sigma_rad * random.normal();
    h.heading_sigma_rad = sensors.heading_sigma_rad;
    return h;
  }

  world::ImuSample imu(std::size_t unit, std::int64_t at_ms) {
    const world::EgoState car = course.at(static_cast<double>(at_ms) * 1e-3);
    world::ImuSample s;
    s.unit = static_cast<std::uint8_t>(unit);
    s.at = Instant{at_ms * 1'000'000};
    s.rate_rad_per_s = {0.0, 0.0,
                        car.yaw_rate_rad_per_s + sensors.gyro_bias_rad_per_s +
                            sensors.gyro_sigma_rad_per_s * random.normal()};
    s.specific_force_mps2 = {car.ax_mps2 + sensors.accel_sigma_mps2 * random.normal(),
                             car.ay_mps2 + sensors.accel_sigma_mps2 * random.normal(), 9.8};
    return s;
  }

  // What arrives in the tick that ends at `ms`: positions 30 ms late, headings 50 ms late.
  world::SensorInput arrivals() {
    constexpr std::int64_t kPositionLate_ms = 30, kHeadingLate_ms = 50;
    world::SensorInput in;
    for (std::int64_t m = ms - 9; m <= ms; ++m) {
      for (std::size_t u = 0; u < world::kGnssUnits; ++u) {
        if (sensors.unit_silent[u]) continue;
        const std::int64_t phase = static_cast<std::int64_t>(u) * 25, fix = m - kPositionLate_ms;
        if (m % 8 == 0) CHECK(in.imu.push(imu(u, m)));
        if (fix >= 0 && fix % 50 == phase) CHECK(in.positions.push(position(u, fix)));
        if (fix >= 0 && fix % 50 == phase) CHECK(in.velocities.push(velocity(u, fix)));
        const std::int64_t turn = m - kHeadingLate_ms;
        if (turn >= 0 && turn % 1000 == 100 + phase) CHECK(in.headings.push(heading(u, turn)));
      }
    }
    return in;
  }

  const Output& tick() {
    ms += 10;
    const Instant now{ms * 1'000'000};
    signals.wheel_speed_mps = {.value = {}, .at = now, .heard = true};
    for (double& w : signals.wheel_speed_mps.value.at)
      w = course.vx_mps + sensors.wheel_sigma_mps * random.normal();
    out = step(params, datum, state, arrivals(), signals, course.bank_rad, now);
    state = out.next;
    return out;
  }

  void run(double for_s) {
    for (int i = 0; i < static_cast<int>(for_s * 100.0 + 0.5); ++i) tick();
  }

  double position_error_m() const {
    return std::hypot(out.ego.x_m - truth().x_m, out.ego.y_m - truth().y_m);
  }
};

}  // namespace pitwall::localization::testing
