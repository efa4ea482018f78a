// Equations of motion of the plant: the forces on the car in one state, and the derivative of the
// state.
//   in     the continuous state, its discrete state, the road, set points of the actuators (after
//          delay and quantisation)
//   out    every force and slip, and the derivative of the continuous state
//   frames as in plant.hpp
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/plant/plant.hpp"

namespace pitwall::plant {

struct SetPoints {
  double steering_motor_rad = 0.0, throttle_fraction = 0.0;
  double brake_front_kpa = 0.0, brake_rear_kpa = 0.0;
};

struct Forces {
  Wheels load_n{}, long_n{}, lat_n{};  // of the tyres, in the wheel's frame
  Wheels slip_ratio{}, slip_sine{}, use{};
  Wheels slip_power_w{}, rolling_power_w{};  // turned into heat: in the contact patch, by rolling
  Wheels drive_nm{}, hold_nm{};  // at the wheel: of the engine; of brake and rolling resistance
  double body_x_n = 0.0, body_y_n = 0.0;  // without gravity, in the plane of the road
  double normal_n = 0.0;                  // sum of the tyre loads minus downforce
  double yaw_moment_nm = 0.0;
  double steering_nm = 0.0;  // of both front tyres about their steering axes; 0 with rigid steering
  double heading_rate_rad_per_s = 0.0;                           // of the map yaw
  double roll_rate_rad_per_s = 0.0, pitch_rate_rad_per_s = 0.0;  // about body x and y
};

struct MapVelocity {
  double east_mps = 0.0, north_mps = 0.0, up_mps = 0.0;
};
MapVelocity map_velocity(const Motion& motion, const Surface& surface);

Forces forces_of(const Params& params, const State& discrete, const Motion& motion,
                 const Surface& surface);

Motion derivative_of(const Params& params, const State& discrete, const Motion& motion,
                     const Surface& surface, const SetPoints& set);

// Angle of the front wheels relative to the body.
double road_wheel_rad(const Params& params, const Motion& motion);

// Sets the springs to the state of a constant acceleration.
void settle_loads(const Params& params, double mass_kg, double ax_mps2, double ay_mps2,
                  Motion& motion);

// Moment of engine and road on a wheel that does not turn; the wheel stays locked while it is
// within hold_nm.
inline double turning_moment_nm(const Forces& f, std::size_t wheel, double radius_m) {
  return f.drive_nm[wheel] - radius_m * f.long_n[wheel];
}

inline const Tyre& tyre_of(const Params& p, std::size_t wheel) {
  return wheel < 2 ? p.front : p.rear;
}

}  // namespace pitwall::plant
