// Car with an analytic motion, and models of its sensors: a circle of any radius on a banked road
// at constant speed, or a straight. For tests only.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "tests/vehicle/autonomy/localization/recommended.hpp"
#include "vehicle/autonomy/localization/localization.hpp"

namespace pitwall::localization::testing {

constexpr double kLatitude_deg = 36.2722, kLongitude_deg = -115.0103, kHeight_m = 594.0;

// Constant motion; a straight if the curvature is zero. The centre of gravity moves level along its
// circle; the car lies in the plane of the road and slips in it. As vectors: course_geometry.hpp.
struct Course {
  double curvature_per_m = 0.0, bank_rad = 0.0;
  // Slip: angle of the velocity to the left of the car's axis, in the plane of the road.
  double speed_mps = 30.0, slip_rad = 0.0;
  double course0_rad = 0.4, x0_m = 120.0, y0_m = -80.0;

  double turn_rate() const { return speed_mps * curvature_per_m; }
  double course_rad(double t_s) const { return course0_rad + turn_rate() * t_s; }
  world::EgoState at(double t_s) const;
  Surroundings surroundings(double t_s) const;
};

// Steady driving with the side slip of the recommended parameters' tyre model.
Course banked_turn(double speed_mps = 55.0);

struct SensorModel {
  double position_sigma_m = 0.010, velocity_sigma_mps = 0.03, heading_sigma_rad = 0.0017;
  double gyro_sigma_rad_per_s = 0.0017, accel_sigma_mps2 = 0.05, wheel_sigma_mps = 0.05;
  std::array<double, 2> gyro_bias_rad_per_s{0.001, 0.001};
  std::array<bool, 2> silent{}, imu_silent{}, no_heading{}, no_position{};
  bool no_fix = false;
  std::array<double, 2> east_m{}, reported_sigma_factor{1.0, 1.0}, turned_rad{};
  std::array<double, world::kCorners> wheel_factor{1.0, 1.0, 1.0, 1.0};
};

// Runs the car and the filter together at 100 Hz. `name` renames the units: unit u of the car is
// reported to the filter as unit name[u].
struct Rig {
  Course course;
  SensorModel sensors;
  Params params = recommended();
  Datum datum = Datum::at(kLatitude_deg, kLongitude_deg, kHeight_m).value();
  std::array<Random, 2> random{Random{11}, Random{22}};  // one per unit of the car
  Random wheel_random{33};
  std::array<std::array<double, 3>, 2> wander_m{};  // slow position error of each unit
  std::array<std::uint8_t, 2> name{0, 1};           // reported name of each unit of the car
  State state;
  world::SensorUse use;
  std::int64_t ms = 0;
  world::VehicleSignals signals;
  Output out;

  double seconds_at(std::int64_t at_ms) const { return static_cast<double>(at_ms) * 1e-3; }
  Instant now() const { return Instant{ms * 1'000'000}; }
  world::EgoState truth() const { return course.at(seconds_at(ms)); }

  const UnitParams& mount(std::size_t unit) const { return params.units[name[unit]]; }

  // Measurement of a unit of the car at an instant, with its noise. The velocity is the central
  // difference of the antenna's path, so it does not depend on a lever-arm formula.
  world::GnssPosition position(std::size_t unit, std::int64_t at_ms);
  world::GnssVelocity velocity(std::size_t unit, std::int64_t at_ms);
  world::GnssHeading heading(std::size_t unit, std::int64_t at_ms);
  world::ImuSample imu(std::size_t unit, std::int64_t at_ms);

  // Samples that arrive in the tick that ends at `ms`: positions 30 ms late, headings 50 ms late.
  world::SensorInput arrivals();
  void turn_wheels();
  const Output& take(const world::SensorInput& in);
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
