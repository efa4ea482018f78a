// A car of which everything is known in closed form, and the sensors that watch it: a circle of any
// radius on a banked road at constant speed, or a straight. Written for the tests alone.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <GeographicLib/LocalCartesian.hpp>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "tests/vehicle/autonomy/localization/recommended.hpp"
#include "vehicle/autonomy/localization/localization.hpp"

namespace pitwall::localization::testing {

constexpr double kLatitude_deg = 36.2722, kLongitude_deg = -115.0103, kHeight_m = 594.0;
constexpr double kCgHeight_m = 0.28;

// Constant motion: a straight when curvature is zero. The centre of gravity goes level along its
// circle; the car lies in the plane of the road and slips in it.
struct Course {
  double curvature_per_m = 0.0, bank_rad = 0.0;
  double speed_mps = 30.0, slip_rad = 0.0;  // velocity left of the car's axis, in the road's plane
  double course0_rad = 0.4, x0_m = 120.0, y0_m = -80.0;

  double turn_rate() const { return speed_mps * curvature_per_m; }
  double course_rad(double t_s) const { return course0_rad + turn_rate() * t_s; }
  Eigen::Vector3d place(double t_s) const {
    const double c = course_rad(t_s), z = kCgHeight_m / std::cos(bank_rad);
    if (curvature_per_m == 0.0)
      return {x0_m + speed_mps * t_s * std::cos(c), y0_m + speed_mps * t_s * std::sin(c), z};
    return {x0_m + (std::sin(c) - std::sin(course0_rad)) / curvature_per_m,
            y0_m - (std::cos(c) - std::cos(course0_rad)) / curvature_per_m, z};
  }
  Eigen::Vector3d left(double t_s) const {
    return {-std::sin(course_rad(t_s)), std::cos(course_rad(t_s)), 0.0};
  }
  Eigen::Vector3d velocity(double t_s) const {
    return speed_mps * Eigen::Vector3d{std::cos(course_rad(t_s)), std::sin(course_rad(t_s)), 0.0};
  }
  Eigen::Matrix3d attitude(double t_s) const {  // Body to Map
    const Eigen::Vector3d up{0.0, 0.0, 1.0}, along = velocity(t_s).normalized();
    const Eigen::Vector3d tangent =
        speed_mps > 0.0 ? along
                        : Eigen::Vector3d{std::cos(course_rad(t_s)), std::sin(course_rad(t_s)), 0};
    const Eigen::Vector3d across = std::cos(bank_rad) * left(t_s) - std::sin(bank_rad) * up;
    Eigen::Matrix3d r;
    r.col(0) = std::cos(slip_rad) * tangent - std::sin(slip_rad) * across;
    r.col(1) = std::sin(slip_rad) * tangent + std::cos(slip_rad) * across;
    r.col(2) = std::sin(bank_rad) * left(t_s) + std::cos(bank_rad) * up;
    return r;
  }
  Eigen::Vector3d rate(double t_s) const {
    return attitude(t_s).transpose() * Eigen::Vector3d{0.0, 0.0, turn_rate()};
  }
  Eigen::Vector3d force(double t_s) const {
    const Eigen::Vector3d accel = speed_mps * turn_rate() * left(t_s);
    return attitude(t_s).transpose() * (accel + Eigen::Vector3d{0.0, 0.0, kGravity_mps2});
  }

  world::EgoState at(double t_s) const {
    const Eigen::Matrix3d r = attitude(t_s);
    const Eigen::Vector3d p = place(t_s), f = force(t_s);
    world::EgoState e;
    e.x_m = p.x(), e.y_m = p.y(), e.z_m = p.z();
    e.yaw_rad = std::atan2(r(1, 0), r(0, 0));
    e.pitch_rad = -std::asin(r(2, 0));
    e.roll_rad = std::atan2(r(2, 1), r(2, 2));
    e.vx_mps = speed_mps * std::cos(slip_rad), e.vy_mps = speed_mps * std::sin(slip_rad);
    e.yaw_rate_rad_per_s = rate(t_s).z();
    e.ax_mps2 = f.x(), e.ay_mps2 = f.y();
    return e;
  }
  Surroundings surroundings(double t_s) const {
    const Eigen::Vector3d p = place(t_s);
    return {.road = {.x_m = p.x(),
                     .y_m = p.y(),
                     .height_m = 0.0,
                     .bank_rad = bank_rad,
                     .climb_rad = 0.0,
                     .direction_rad = wrap_pi(course_rad(t_s))},
            .at = Instant{std::llround(t_s * 1e9)}};
  }
};

// Steady driving with the side slip that the tyre model of the recommended parameters gives.
inline Course banked_turn(double speed_mps = 55.0) {
  Course c{.curvature_per_m = 1.0 / 220.0, .bank_rad = from_deg(20.0), .speed_mps = speed_mps};
  const double lateral =
      speed_mps * speed_mps / 220.0 * std::cos(c.bank_rad) - kGravity_mps2 * std::sin(c.bank_rad);
  c.slip_rad = 1.247 * c.rate(0.0).z() / speed_mps - 0.0014 * lateral;
  return c;
}

struct SensorModel {
  double position_sigma_m = 0.010, velocity_sigma_mps = 0.03, heading_sigma_rad = 0.0017;
  double gyro_sigma_rad_per_s = 0.0017, accel_sigma_mps2 = 0.05, wheel_sigma_mps = 0.05;
  std::array<double, 2> gyro_bias_rad_per_s{0.001, 0.001};
  std::array<bool, 2> silent{}, imu_silent{}, no_heading{}, no_position{};
  bool no_fix = false;
  std::array<double, 2> east_m{}, reported_sigma_factor{1.0, 1.0}, turned_rad{};
  std::array<double, world::kCorners> wheel_factor{1.0, 1.0, 1.0, 1.0};
};

// Runs the car and the filter side by side at 100 Hz. `units` renames the units: what the filter
// knows as unit u stands where unit units[u] of the car stands.
struct Rig {
  Course course;
  SensorModel sensors;
  Params params = recommended();
  Datum datum = Datum::at(kLatitude_deg, kLongitude_deg, kHeight_m).value();
  GeographicLib::LocalCartesian plane{kLatitude_deg, kLongitude_deg, kHeight_m};
  std::array<Random, 2> random{Random{11}, Random{22}};  // of each unit of the car
  Random wheel_random{33};
  std::array<std::array<double, 3>, 2> wander_m{};  // of each unit's positions
  std::array<std::uint8_t, 2> name{0, 1};           // of each unit of the car, as it is reported
  State state;
  world::SensorUse use;
  std::int64_t ms = 0;
  world::VehicleSignals signals;
  Output out;

  double seconds_at(std::int64_t at_ms) const { return static_cast<double>(at_ms) * 1e-3; }
  Instant now() const { return Instant{ms * 1'000'000}; }
  world::EgoState truth() const { return course.at(seconds_at(ms)); }

  const UnitParams& mount(std::size_t unit) const { return params.units[name[unit]]; }
  Eigen::Vector3d arm(std::size_t unit) const {
    const LeverArm& a = mount(unit).antenna;
    return {a.x_m, a.y_m, a.z_m};
  }

  template <class Sample>
  Sample begin(std::size_t unit, std::int64_t at_ms) const {
    Sample s;
    s.unit = name[unit];
    s.at = Instant{at_ms * 1'000'000};
    return s;
  }

  world::GnssPosition position(std::size_t unit, std::int64_t at_ms) {
    const double t = seconds_at(at_ms);
    const Eigen::Vector3d at = course.place(t) + course.attitude(t) * arm(unit);
    auto p = begin<world::GnssPosition>(unit, at_ms);
    p.solution_status = sensors.no_fix ? 1 : world::kSolutionComputed;
    p.position_type = sensors.no_fix ? world::kPositionNone : world::kPositionNarrowInt;
    // As RTK has it: nine tenths of the variance wander within half a minute, the rest is white.
    const double sigma = sensors.position_sigma_m, white = 0.316 * sigma, step_s = 0.05;
    Random& r = random[unit];
    std::array<double, 3>& w = wander_m[unit];
    for (double& axis : w)
      axis += -axis * step_s / 30.0 + 0.949 * sigma * std::sqrt(2.0 * step_s / 30.0) * r.normal();
    const double dx = w[0] + white * r.normal() + sensors.east_m[unit];
    const double dy = w[1] + white * r.normal(), dz = w[2] + white * r.normal();
    plane.Reverse(at.x() + dx, at.y() + dy, at.z() + dz, p.latitude_deg, p.longitude_deg,
                  p.height_m);
    p.latitude_sigma_m = p.longitude_sigma_m = p.height_sigma_m =
        sigma * sensors.reported_sigma_factor[unit];
    p.satellites = 16;
    p.differential_age_s = 1.0;
    p.solution_age_s = 0.0;
    return p;
  }

  // Central difference of the antenna's own path: knows nothing of lever-arm formulas.
  world::GnssVelocity velocity(std::size_t unit, std::int64_t at_ms) {
    const double t = seconds_at(at_ms), h = 1e-4;
    const auto path = [&](double s) -> Eigen::Vector3d {
      return course.place(s) + course.attitude(s) * arm(unit);
    };
    Random& r = random[unit];
    const Eigen::Vector3d noise{r.normal(), r.normal(), r.normal()};
    const Eigen::Vector3d speed =
        (path(t + h) - path(t - h)) / (2 * h) + sensors.velocity_sigma_mps * noise;
    auto v = begin<world::GnssVelocity>(unit, at_ms);
    v.solution_status = sensors.no_fix ? 1 : world::kSolutionComputed;
    v.velocity_type = sensors.no_fix ? world::kPositionNone : world::kPositionNarrowInt;
    v.horizontal_mps = speed.head<2>().norm();
    v.track_over_ground_rad = std::atan2(speed.x(), speed.y());
    v.vertical_mps = speed.z();
    return v;
  }

  world::GnssHeading heading(std::size_t unit, std::int64_t at_ms) {
    const double direction = mount(unit).baseline_yaw_rad;
    const Eigen::Vector3d line = course.attitude(seconds_at(at_ms)) *
                                 Eigen::Vector3d{std::cos(direction), std::sin(direction), 0.0};
    auto h = begin<world::GnssHeading>(unit, at_ms);
    h.solution_status = sensors.no_fix ? 1 : world::kSolutionComputed;
    h.position_type = sensors.no_fix ? world::kPositionNone : world::kPositionNarrowInt;
    h.heading_rad = 0.5 * std::numbers::pi - std::atan2(line.y(), line.x()) +
                    sensors.turned_rad[unit] + sensors.heading_sigma_rad * random[unit].normal();
    h.heading_sigma_rad = sensors.heading_sigma_rad;
    h.baseline_m = mount(unit).baseline_m;
    return h;
  }

  world::ImuSample imu(std::size_t unit, std::int64_t at_ms) {
    const double t = seconds_at(at_ms);
    const Eigen::Vector3d place{mount(unit).imu.x_m, mount(unit).imu.y_m, mount(unit).imu.z_m};
    const Eigen::Vector3d w = course.rate(t), f = course.force(t) + w.cross(w.cross(place));
    Random& r = random[unit];
    auto s = begin<world::ImuSample>(unit, at_ms);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      s.rate_rad_per_s[axis] = w[i] + sensors.gyro_sigma_rad_per_s * r.normal();
      s.specific_force_mps2[axis] = f[i] + sensors.accel_sigma_mps2 * r.normal();
    }
    s.rate_rad_per_s[2] += sensors.gyro_bias_rad_per_s[unit];
    return s;
  }

  // What arrives in the tick that ends at `ms`: positions 30 ms late, headings 50 ms late.
  world::SensorInput arrivals() {
    constexpr std::int64_t kPositionLate_ms = 30, kHeadingLate_ms = 50;
    world::SensorInput in;
    for (std::int64_t m = ms - 9; m <= ms; ++m) {
      for (std::size_t u = 0; u < world::kGnssUnits; ++u) {
        const std::int64_t phase = static_cast<std::int64_t>(u) * 25, fix = m - kPositionLate_ms;
        const std::int64_t turn = m - kHeadingLate_ms;
        const bool heard = !sensors.silent[u];
        if (m % 8 == 0) {
          const auto sample = imu(u, m);
          if (heard && !sensors.imu_silent[u]) CHECK(in.imu.push(sample));
        }
        if (fix >= 0 && fix % 50 == phase) {
          const auto p = position(u, fix);
          const auto v = velocity(u, fix);
          if (heard && !sensors.no_position[u]) CHECK(in.positions.push(p));
          if (heard) CHECK(in.velocities.push(v));
        }
        if (turn >= 0 && turn % 1000 == 100 + phase) {
          const auto h = heading(u, turn);
          if (heard && !sensors.no_heading[u]) CHECK(in.headings.push(h));
        }
      }
    }
    return in;
  }

  void turn_wheels() {
    const double t = seconds_at(ms);
    const double side = 0.82 * course.rate(t).z(), forward = course.at(t).vx_mps;
    signals.wheel_speed_mps = {.value = {}, .at = now(), .heard = true};
    constexpr std::array kLeft{1.0, -1.0, 1.0, -1.0};
    for (std::size_t i = 0; i < world::kCorners; ++i)
      signals.wheel_speed_mps.value.at[i] = (forward - kLeft[i] * side) * sensors.wheel_factor[i] +
                                            sensors.wheel_sigma_mps * wheel_random.normal();
  }

  const Output& take(const world::SensorInput& in) {
    out = step(params, datum, state, in, signals, course.surroundings(seconds_at(ms - 10)), use,
               now());
    return out;
  }
  const Output& tick() {
    ms += 10;
    turn_wheels();
    return take(arrivals());
  }
  void run(double for_s) {
    for (int i = 0; i < static_cast<int>(for_s * 100.0 + 0.5); ++i) tick();
  }

  double position_error_m() const {
    return std::hypot(out.ego.x_m - truth().x_m, out.ego.y_m - truth().y_m);
  }
  const Tally& tally(Source source, std::size_t unit) const {
    return state.tally[static_cast<std::size_t>(source)][unit];
  }
  std::uint32_t count(Source source, std::size_t unit, Gate gate) const {
    return tally(source, unit).by_gate[static_cast<std::size_t>(gate)];
  }
};

}  // namespace pitwall::localization::testing
