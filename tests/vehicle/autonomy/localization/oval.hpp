// Car on a banked oval with hills, with an analytic motion, and models of its sensors: path and
// attitude are formulas, all other quantities are their differences over time. For tests only; it
// shares no code with the filter.
//   frames Map, Body; SI
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/vehicle/autonomy/localization/recommended.hpp"
#include "vehicle/autonomy/localization/filter/filter.hpp"

namespace pitwall::localization::testing {

struct Pose {
  Eigen::Vector3d at;  // position of the centre of gravity
  Eigen::Matrix3d attitude;
};

struct Oval {
  double half_length_m = 300.0, half_width_m = 230.0, round_rad_per_s = 0.25;
  double turned_rad = 0.0, east_m = 0.0, north_m = 0.0;  // rotation and position of the map
  double cg_height_m = 0.28;

  double angle(double t_s) const { return round_rad_per_s * t_s + 0.05 * std::sin(0.4 * t_s); }
  double height_m(double t_s) const { return 2.0 * std::sin(2.0 * angle(t_s)); }
  double bank_rad(double t_s) const { return 0.26 + 0.09 * std::cos(2.0 * angle(t_s)); }

  Eigen::Vector3d path(double t_s) const {
    const double u = angle(t_s), c = std::cos(turned_rad), s = std::sin(turned_rad);
    const double x = half_length_m * std::cos(u), y = half_width_m * std::sin(u);
    return {east_m + c * x - s * y, north_m + s * x + c * y, height_m(t_s)};
  }
  Eigen::Vector3d velocity(double t_s) const {
    constexpr double kStep_s = 5e-4;
    return (path(t_s + kStep_s) - path(t_s - kStep_s)) / (2.0 * kStep_s);
  }
  double direction(double t_s) const {
    const Eigen::Vector3d v = velocity(t_s);
    return std::atan2(v.y(), v.x());
  }
  // Side slip of a plausible size.
  double slip_rad(double t_s) const { return -0.02 + 0.004 * std::cos(2.0 * angle(t_s)); }

  Road road(double t_s) const {
    const Eigen::Vector3d v = velocity(t_s);
    Road r{.bank_rad = bank_rad(t_s),
           .climb_rad = std::atan2(v.z(), std::hypot(v.x(), v.y())),
           .direction_rad = direction(t_s)};
    const Eigen::Vector3d under = path(t_s) - cg_height_m * up(r);
    r.x_m = under.x(), r.y_m = under.y(), r.height_m = under.z();
    return r;
  }
  // Normal of the surface from its slopes along and across its direction, written independently.
  static Eigen::Vector3d up(const Road& r) {
    const Eigen::Vector3d along(std::cos(r.direction_rad), std::sin(r.direction_rad),
                                std::tan(r.climb_rad));
    const Eigen::Vector3d left(-std::sin(r.direction_rad), std::cos(r.direction_rad),
                               -std::tan(r.bank_rad));
    return along.cross(left).normalized();
  }
  Pose pose(double t_s) const {
    const Road r = road(t_s);
    const Eigen::Vector3d z = up(r);
    const double yaw = r.direction_rad - slip_rad(t_s);
    Eigen::Vector3d x(std::cos(yaw), std::sin(yaw), 0.0);
    x.z() = -(x.x() * z.x() + x.y() * z.y()) / z.z();
    x.normalize();
    Pose p{path(t_s), {}};
    p.attitude << x, z.cross(x), z;
    return p;
  }
  Eigen::Vector3d rate(double t_s) const {
    constexpr double kStep_s = 5e-4;
    const Eigen::AngleAxisd turn(pose(t_s - kStep_s).attitude.transpose() *
                                 pose(t_s + kStep_s).attitude);
    return turn.angle() * turn.axis() / (2.0 * kStep_s);
  }
  Eigen::Vector3d force(double t_s) const {
    constexpr double kStep_s = 2e-3;
    const Eigen::Vector3d accel =
        (path(t_s + kStep_s) - 2.0 * path(t_s) + path(t_s - kStep_s)) / (kStep_s * kStep_s);
    return pose(t_s).attitude.transpose() * (accel + Eigen::Vector3d(0.0, 0.0, kGravity_mps2));
  }
  double forward_mps(double t_s) const { return pose(t_s).attitude.col(0).dot(velocity(t_s)); }
};

// One sigma each. A slowly changing error is a Gauss-Markov process, as in the filter's model.
struct OvalSensors {
  double position_m = 0.010, height_m = 0.015, wander_share = 0.949, wander_s = 30.0,
         together = 0.6;
  double velocity_mps = 0.03, vertical_mps = 0.05, heading_rad = 0.0015;
  double gyro_rad_per_s = 0.0015, accel_mps2 = 0.05, gyro_bias_rad_per_s = 8.7e-4,
         accel_bias_mps2 = 0.03, scale = 1e-3;
  double wheel_scale = -0.014, wheel_mps = 0.13;
  double road_tilt_rad = 0.003, road_height_m = 0.02;  // errors of the map, constant in a run
};

struct Arrival {
  Measurement measurement;
  std::int64_t at_ms = 0;
};

// All measurements of a drive, in order of delivery.
class OvalDrive {
 public:
  OvalDrive(const Oval& oval, std::uint64_t seed, const OvalSensors& sensors = {})
      : oval_(oval), sensors_(sensors) {
    random_.state = seed * 7919 + 17;
    draw(gyro_bias_, sensors_.gyro_bias_rad_per_s);
    draw(accel_bias_, sensors_.accel_bias_mps2);
    draw(gyro_scale_, sensors_.scale);
    draw(accel_scale_, sensors_.scale);
    draw(sky_, 1.0);
    for (auto& own : own_) draw(own, 1.0);
    tilt_rad_ = sensors_.road_tilt_rad * draw_normal(random_);
    sunk_m_ = sensors_.road_height_m * draw_normal(random_);
  }

  std::vector<Arrival> run(double for_s) {
    std::vector<Arrival> all;
    const auto end_ms = static_cast<std::int64_t>(for_s * 1000.0);
    for (std::int64_t ms = 0; ms < end_ms; ++ms) measure(ms, all);
    std::stable_sort(all.begin(), all.end(),
                     [](const Arrival& a, const Arrival& b) { return a.at_ms < b.at_ms; });
    return all;
  }

  Seed seed() {
    const double t = 0.0;
    const Pose pose = oval_.pose(t);
    const Eigen::Vector3d antenna = pose.at + pose.attitude * arm(0);
    return {.at = Instant{},
            .antenna_m = {antenna.x() + sensors_.position_m * draw_normal(random_),
                          antenna.y() + sensors_.position_m * draw_normal(random_), antenna.z()},
            .antenna_sigma_m = sensors_.position_m,
            .arm = recommended().units[0].antenna,
            .yaw_rad =
                std::atan2(pose.attitude(1, 0), pose.attitude(0, 0)) + 0.01 * draw_normal(random_),
            .yaw_sigma_rad = 0.01,
            .speed_mps = oval_.forward_mps(t),
            .road = road(t)};
  }

  // Times without positions, velocities and headings of a unit; times with a bias of its position.
  struct Span {
    double from_s = 1e9, to_s = 1e9;
    bool holds(double t_s) const { return t_s >= from_s && t_s < to_s; }
  };
  std::array<Span, 2> silent, stepped;
  double step_m = 0.3;

 private:
  void draw(Eigen::Vector3d& v, double sigma) {
    for (int i = 0; i < 3; ++i) v[i] = sigma * draw_normal(random_);
  }
  Eigen::Vector3d noise(double sigma) { return noise(sigma, sigma); }
  Eigen::Vector3d noise(double level, double vertical) {
    const double x = draw_normal(random_), y = draw_normal(random_), z = draw_normal(random_);
    return {level * x, level * y, vertical * z};
  }
  static Eigen::Vector3d arm(std::size_t unit) {
    const LeverArm a = recommended().units[unit].antenna;
    return {a.x_m, a.y_m, a.z_m};
  }
  Road road(double t_s) const {
    Road r = oval_.road(t_s);
    r.bank_rad += tilt_rad_;
    r.height_m += sunk_m_;
    return r;
  }
  void stir(Eigen::Vector3d& wander, double since_s) {
    const double keep = std::exp(-since_s / sensors_.wander_s);
    wander = keep * wander + noise(std::sqrt(1.0 - keep * keep));
  }

  Measurement position(std::size_t unit, double t_s) {
    const Pose pose = oval_.pose(t_s);
    const double share = sensors_.wander_share;
    const Eigen::Vector3d sigma(sensors_.position_m, sensors_.position_m, sensors_.height_m);
    const Eigen::Vector3d wander =
        std::sqrt(sensors_.together) * sky_ + std::sqrt(1.0 - sensors_.together) * own_[unit];
    const Eigen::Vector3d z =
        pose.at + pose.attitude * arm(unit) +
        sigma.cwiseProduct(share * wander + std::sqrt(1.0 - share * share) * noise(1.0));
    return {.kind = Kind::kPosition,
            .a = z.x() + (stepped[unit].holds(t_s) ? step_m : 0.0),
            .b = z.y(),
            .c = z.z(),
            .sigma_a = sigma.x(),
            .sigma_b = sigma.y(),
            .sigma_c = sigma.z(),
            .arm = recommended().units[unit].antenna};
  }
  Measurement velocity(std::size_t unit, double t_s) {
    constexpr double kStep_s = 5e-4;
    const auto antenna = [&](double t) -> Eigen::Vector3d {
      const Pose pose = oval_.pose(t);
      return pose.at + pose.attitude * arm(unit);
    };
    const Eigen::Vector3d z = (antenna(t_s + kStep_s) - antenna(t_s - kStep_s)) / (2.0 * kStep_s) +
                              noise(sensors_.velocity_mps, sensors_.vertical_mps);
    return {.kind = Kind::kVelocity,
            .a = z.x(),
            .b = z.y(),
            .c = z.z(),
            .arm = recommended().units[unit].antenna};
  }
  Measurement heading(std::size_t unit, double t_s) {
    const double direction = recommended().units[unit].baseline_yaw_rad;
    const Eigen::Vector3d line =
        oval_.pose(t_s).attitude * Eigen::Vector3d(std::cos(direction), std::sin(direction), 0.0);
    return {.kind = Kind::kHeading,
            .a = wrap_pi(std::atan2(line.y(), line.x()) - direction +
                         sensors_.heading_rad * draw_normal(random_)),
            .sigma_a = sensors_.heading_rad,
            .direction_rad = direction};
  }
  // The IMU is not at the centre of gravity; its samples come from the motion of its own position.
  Measurement imu(double t_s) {
    constexpr double kStep_s = 2e-3;
    const Eigen::Vector3d place(-0.2, 0.1, 0.0);
    const auto there = [&](double t) -> Eigen::Vector3d {
      const Pose pose = oval_.pose(t);
      return pose.at + pose.attitude * place;
    };
    const Eigen::Vector3d accel =
        (there(t_s + kStep_s) - 2.0 * there(t_s) + there(t_s - kStep_s)) / (kStep_s * kStep_s);
    const Eigen::Vector3d true_force =
        oval_.pose(t_s).attitude.transpose() * (accel + Eigen::Vector3d(0.0, 0.0, kGravity_mps2));
    const Eigen::Vector3d true_rate = oval_.rate(t_s);
    const Eigen::Vector3d rate = true_rate + true_rate.cwiseProduct(gyro_scale_) + gyro_bias_ +
                                 noise(sensors_.gyro_rad_per_s);
    const Eigen::Vector3d force = true_force + true_force.cwiseProduct(accel_scale_) + accel_bias_ +
                                  noise(sensors_.accel_mps2);
    return {.kind = Kind::kImu,
            .arm = {place.x(), place.y(), place.z()},
            .imu = {{rate.x(), rate.y(), rate.z()}, {force.x(), force.y(), force.z()}}};
  }

  void measure(std::int64_t ms, std::vector<Arrival>& all) {
    const double t = static_cast<double>(ms) * 1e-3;
    const auto say = [&](Measurement m, std::size_t unit, std::int64_t late_ms) {
      m.unit = static_cast<std::uint8_t>(unit);
      m.at = Instant{ms * 1'000'000};
      all.push_back({m, ms + late_ms});
    };
    if (ms % 8 == 1) say(imu(t), 0, 2);
    if (ms % 10 == 5) {
      say({.kind = Kind::kWheelSpeed,
           .a = (1.0 + sensors_.wheel_scale) * oval_.forward_mps(t) +
                sensors_.wheel_mps * draw_normal(random_)},
          0, 3);
      say({.kind = Kind::kSlip}, 0, 3);
    }
    if (ms % 10 == 0) say({.kind = Kind::kRoad, .road = road(t)}, 0, 10);
    if (ms % 50 == 10) {
      stir(sky_, 0.05);
      for (auto& own : own_) stir(own, 0.05);
    }
    for (std::size_t unit = 0; unit < 2; ++unit) {
      const auto phase = static_cast<std::int64_t>(10 + 25 * unit);
      if (ms % 50 == phase) {
        const Measurement p = position(unit, t), v = velocity(unit, t);
        if (!silent[unit].holds(t)) say(p, unit, 30), say(v, unit, 35);
      }
      if (ms % 1000 == 10 * phase) {
        const Measurement h = heading(unit, t);
        if (!silent[unit].holds(t)) say(h, unit, 50);
      }
    }
  }

  Oval oval_;
  OvalSensors sensors_;
  Random random_;
  Eigen::Vector3d gyro_bias_, accel_bias_, gyro_scale_, accel_scale_, sky_;
  std::array<Eigen::Vector3d, 2> own_;
  double tilt_rad_ = 0.0, sunk_m_ = 0.0;
};

}  // namespace pitwall::localization::testing
