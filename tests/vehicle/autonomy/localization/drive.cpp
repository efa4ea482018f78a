// SPDX-License-Identifier: Apache-2.0
#include "tests/vehicle/autonomy/localization/drive.hpp"

#include <Eigen/Geometry>
#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>
#include <numbers>

#include "protocol/vocabulary/check.hpp"
#include "tests/vehicle/autonomy/localization/course_geometry.hpp"

namespace pitwall::localization::testing {
namespace {

constexpr double kCgHeight_m = 0.28;
const GeographicLib::LocalCartesian kPlane{kLatitude_deg, kLongitude_deg, kHeight_m};

Eigen::Vector3d antenna_of(const Rig& rig, std::size_t unit) {
  const LeverArm& a = rig.mount(unit).antenna;
  return {a.x_m, a.y_m, a.z_m};
}

template <class Sample>
Sample named(const Rig& rig, std::size_t unit, std::int64_t at_ms) {
  Sample s;
  s.unit = rig.name[unit];
  s.at = Instant{at_ms * 1'000'000};
  return s;
}

}  // namespace

Eigen::Vector3d place(const Course& c, double t_s) {
  const double k = c.curvature_per_m, course = c.course_rad(t_s), way_m = c.speed_mps * t_s;
  const double z = kCgHeight_m / std::cos(c.bank_rad);
  if (k == 0.0) return {c.x0_m + way_m * std::cos(course), c.y0_m + way_m * std::sin(course), z};
  return {c.x0_m + (std::sin(course) - std::sin(c.course0_rad)) / k,
          c.y0_m - (std::cos(course) - std::cos(c.course0_rad)) / k, z};
}

Eigen::Vector3d left(const Course& c, double t_s) {
  return {-std::sin(c.course_rad(t_s)), std::cos(c.course_rad(t_s)), 0.0};
}

Eigen::Vector3d velocity(const Course& c, double t_s) {
  return c.speed_mps *
         Eigen::Vector3d{std::cos(c.course_rad(t_s)), std::sin(c.course_rad(t_s)), 0.0};
}

Eigen::Matrix3d attitude(const Course& c, double t_s) {
  const Eigen::Vector3d up{0.0, 0.0, 1.0}, along = velocity(c, t_s).normalized();
  const Eigen::Vector3d tangent =
      c.speed_mps > 0.0
          ? along
          : Eigen::Vector3d{std::cos(c.course_rad(t_s)), std::sin(c.course_rad(t_s)), 0};
  const Eigen::Vector3d across = std::cos(c.bank_rad) * left(c, t_s) - std::sin(c.bank_rad) * up;
  Eigen::Matrix3d r;
  r.col(0) = std::cos(c.slip_rad) * tangent - std::sin(c.slip_rad) * across;
  r.col(1) = std::sin(c.slip_rad) * tangent + std::cos(c.slip_rad) * across;
  r.col(2) = std::sin(c.bank_rad) * left(c, t_s) + std::cos(c.bank_rad) * up;
  return r;
}

Eigen::Vector3d rate(const Course& c, double t_s) {
  return attitude(c, t_s).transpose() * Eigen::Vector3d{0.0, 0.0, c.turn_rate()};
}

Eigen::Vector3d force(const Course& c, double t_s) {
  const Eigen::Vector3d accel = c.speed_mps * c.turn_rate() * left(c, t_s);
  return attitude(c, t_s).transpose() * (accel + Eigen::Vector3d{0.0, 0.0, kGravity_mps2});
}

world::EgoState Course::at(double t_s) const {
  const Eigen::Matrix3d r = attitude(*this, t_s);
  const Eigen::Vector3d p = place(*this, t_s), f = force(*this, t_s);
  world::EgoState e;
  e.x_m = p.x(), e.y_m = p.y(), e.z_m = p.z();
  e.yaw_rad = std::atan2(r(1, 0), r(0, 0));
  e.pitch_rad = -std::asin(r(2, 0));
  e.roll_rad = std::atan2(r(2, 1), r(2, 2));
  e.vx_mps = speed_mps * std::cos(slip_rad), e.vy_mps = speed_mps * std::sin(slip_rad);
  e.yaw_rate_rad_per_s = rate(*this, t_s).z();
  e.ax_mps2 = f.x(), e.ay_mps2 = f.y();
  return e;
}

Surroundings Course::surroundings(double t_s) const {
  const Eigen::Vector3d p = place(*this, t_s);
  return {.road = {.x_m = p.x(),
                   .y_m = p.y(),
                   .height_m = 0.0,
                   .bank_rad = bank_rad,
                   .climb_rad = 0.0,
                   .direction_rad = wrap_pi(course_rad(t_s))},
          .at = Instant{std::llround(t_s * 1e9)}};
}

Course banked_turn(double speed_mps) {
  Course c{.curvature_per_m = 1.0 / 220.0, .bank_rad = from_deg(20.0), .speed_mps = speed_mps};
  const double lateral =
      speed_mps * speed_mps / 220.0 * std::cos(c.bank_rad) - kGravity_mps2 * std::sin(c.bank_rad);
  c.slip_rad = 1.247 * rate(c, 0.0).z() / speed_mps - 0.0014 * lateral;
  return c;
}

world::GnssPosition Rig::position(std::size_t unit, std::int64_t at_ms) {
  const double t = seconds_at(at_ms);
  const Eigen::Vector3d at = place(course, t) + attitude(course, t) * antenna_of(*this, unit);
  auto p = named<world::GnssPosition>(*this, unit, at_ms);
  p.solution_status = sensors.no_fix ? 1 : world::kSolutionComputed;
  p.position_type = sensors.no_fix ? world::kPositionNone : world::kPositionNarrowInt;
  // As RTK has it: nine tenths of the variance wander within half a minute, the rest is white.
  const double sigma = sensors.position_sigma_m, white = 0.316 * sigma, step_s = 0.05;
  Random& r = random[unit];
  std::array<double, 3>& w = wander_m[unit];
  for (double& axis : w)
    axis += -axis * step_s / 30.0 + 0.949 * sigma * std::sqrt(2.0 * step_s / 30.0) * draw_normal(r);
  const double dx = w[0] + white * draw_normal(r) + sensors.east_m[unit];
  const double dy = w[1] + white * draw_normal(r), dz = w[2] + white * draw_normal(r);
  kPlane.Reverse(at.x() + dx, at.y() + dy, at.z() + dz, p.latitude_deg, p.longitude_deg,
                 p.height_m);
  p.latitude_sigma_m = p.longitude_sigma_m = p.height_sigma_m =
      sigma * sensors.reported_sigma_factor[unit];
  p.satellites = 16;
  p.differential_age_s = 1.0;
  p.solution_age_s = 0.0;
  return p;
}

world::GnssVelocity Rig::velocity(std::size_t unit, std::int64_t at_ms) {
  const double t = seconds_at(at_ms), h = 1e-4;
  const auto path = [&](double s) -> Eigen::Vector3d {
    return place(course, s) + attitude(course, s) * antenna_of(*this, unit);
  };
  Random& r = random[unit];
  const Eigen::Vector3d noise{draw_normal(r), draw_normal(r), draw_normal(r)};
  const Eigen::Vector3d speed =
      (path(t + h) - path(t - h)) / (2 * h) + sensors.velocity_sigma_mps * noise;
  auto v = named<world::GnssVelocity>(*this, unit, at_ms);
  v.solution_status = sensors.no_fix ? 1 : world::kSolutionComputed;
  v.velocity_type = sensors.no_fix ? world::kPositionNone : world::kPositionNarrowInt;
  v.horizontal_mps = speed.head<2>().norm();
  v.track_over_ground_rad = std::atan2(speed.x(), speed.y());
  v.vertical_mps = speed.z();
  return v;
}

world::GnssHeading Rig::heading(std::size_t unit, std::int64_t at_ms) {
  const double direction = mount(unit).baseline_yaw_rad;
  const Eigen::Vector3d line = attitude(course, seconds_at(at_ms)) *
                               Eigen::Vector3d{std::cos(direction), std::sin(direction), 0.0};
  auto h = named<world::GnssHeading>(*this, unit, at_ms);
  h.solution_status = sensors.no_fix ? 1 : world::kSolutionComputed;
  h.position_type = sensors.no_fix ? world::kPositionNone : world::kPositionNarrowInt;
  h.heading_rad = 0.5 * std::numbers::pi - std::atan2(line.y(), line.x()) +
                  sensors.turned_rad[unit] + sensors.heading_sigma_rad * draw_normal(random[unit]);
  h.heading_sigma_rad = sensors.heading_sigma_rad;
  h.baseline_m = mount(unit).baseline_m;
  return h;
}

world::ImuSample Rig::imu(std::size_t unit, std::int64_t at_ms) {
  const double t = seconds_at(at_ms);
  const Eigen::Vector3d arm{mount(unit).imu.x_m, mount(unit).imu.y_m, mount(unit).imu.z_m};
  const Eigen::Vector3d w = rate(course, t), f = force(course, t) + w.cross(w.cross(arm));
  Random& r = random[unit];
  auto s = named<world::ImuSample>(*this, unit, at_ms);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    s.rate_rad_per_s[axis] = w[i] + sensors.gyro_sigma_rad_per_s * draw_normal(r);
    s.specific_force_mps2[axis] = f[i] + sensors.accel_sigma_mps2 * draw_normal(r);
  }
  s.rate_rad_per_s[2] += sensors.gyro_bias_rad_per_s[unit];
  return s;
}

world::SensorInput Rig::arrivals() {
  constexpr std::int64_t kPositionLate_ms = 30, kHeadingLate_ms = 50;
  world::SensorInput in;
  for (std::int64_t m = ms - 9; m <= ms; ++m) {
    for (std::size_t u = 0; u < world::kGnssUnits; ++u) {
      const std::int64_t phase = static_cast<std::int64_t>(u) * 25, fix = m - kPositionLate_ms;
      const std::int64_t turn = m - kHeadingLate_ms;
      const bool received = !sensors.silent[u];
      if (m % 8 == 0) {
        const auto sample = imu(u, m);
        if (received && !sensors.imu_silent[u]) CHECK(in.imu.push(sample));
      }
      if (fix >= 0 && fix % 50 == phase) {
        const auto p = position(u, fix);
        const auto v = velocity(u, fix);
        if (received && !sensors.no_position[u]) CHECK(in.positions.push(p));
        if (received) CHECK(in.velocities.push(v));
      }
      if (turn >= 0 && turn % 1000 == 100 + phase) {
        const auto h = heading(u, turn);
        if (received && !sensors.no_heading[u]) CHECK(in.headings.push(h));
      }
    }
  }
  return in;
}

void Rig::turn_wheels() {
  const double t = seconds_at(ms);
  const double side = 0.82 * rate(course, t).z(), forward = course.at(t).vx_mps;
  signals.wheel_speed_mps = {.value = {}, .at = now(), .received = true};
  constexpr std::array kLeft{1.0, -1.0, 1.0, -1.0};
  for (std::size_t i = 0; i < world::kCorners; ++i)
    signals.wheel_speed_mps.value.at[i] = (forward - kLeft[i] * side) * sensors.wheel_factor[i] +
                                          sensors.wheel_sigma_mps * draw_normal(wheel_random);
}

const Output& Rig::take(const world::SensorInput& in) {
  out =
      step(params, datum, state, in, signals, course.surroundings(seconds_at(ms - 10)), use, now());
  return out;
}

}  // namespace pitwall::localization::testing
