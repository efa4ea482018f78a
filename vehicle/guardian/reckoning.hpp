// Position estimator of the guardian for when the car process is silent: begun with the car
// process's last estimate, moved on by a gyroscope and the wheel speeds, corrected by GNSS
// positions and headings that fit. Small and with fixed gains on purpose: it has to hold for the
// twenty seconds of a stop.
//   in     the car's estimate while it lives; IMU samples, positions and headings of the guardian's
//          own receivers, wheel speeds and steering angle off the bus, the banking of the path
//   out    Pose at `now`
//   frames Map, Body; banking positive where the left side is lower
//   invariants
//          with r the yaw rate about body z, phi the banking:
//            yaw' = r / cos(phi);  vy = b r - v C a_y,  a_y = v r - g sin(phi)
//            (the rear axle slips by C a_y)
//            x' = v cos(yaw) - vy cos(phi) sin(yaw), y' likewise
//          The gyroscope is the one that agrees better with the steering when two are there and
//          differ; its bias is the mean difference from the car's own estimate while it lived.
//          Without any, the steady-state yaw rate of the angle (steering/learned_steering.hpp)
//          A position corrects by a share of its innovation, and the yaw by the lateral part of it
//          (alpha-beta filter, beta = alpha^2 / (2 - alpha))
//   errors a sample outside its gate, or not fixed, changes nothing and is counted
//   source Kalata, "The tracking index", 1984 (alpha-beta)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/guardian/tangent_plane.hpp"
#include "vehicle/steering/learned_steering.hpp"
#include "vehicle/world/ego_state.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::guardian {

struct ReceiverMounting {
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;  // of the primary antenna, from the centre of gravity
  double baseline_yaw_rad = 0.0;           // of the antenna baseline, in Body
};

struct ReckoningParams {
  std::array<ReceiverMounting, world::kGnssUnits> units;
  double cg_to_rear_m = 1.247;             // [0.5, 3]
  double rear_slip_rad_per_mps2 = 0.0014;  // [0, 0.02]
  steering::Bicycle bicycle;
  double steering_ratio = 19.5;              // [10, 25]
  Duration gyro_age_max = milliseconds(50);  // [10, 200] ms
  double gyro_differ_rad_per_s = 0.05;       // beyond this the steering decides; [0.01, 0.5]
  double position_share = 0.15;              // alpha; [0.02, 0.5]
  double position_sigma_max_m = 0.3;         // [0.05, 2]
  double position_gate_m = 0.6;              // just after an accepted one; [0.2, 3]
  double position_gate_mps = 0.5;            // grows by this since then; [0, 2]
  double heading_share = 0.05;               // [0, 0.5]
  double heading_gate_rad = 0.05;            // [0.01, 0.3]
};

struct Pose {
  Instant at{};
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;
  double speed_mps = kUnset, slip_mps = 0.0;  // forward, to the left; in the plane of the road
  double yaw_rate_rad_per_s = 0.0;            // about body z
};

struct Gyroscope {
  double rate_rad_per_s = kUnset, bias_rad_per_s = 0.0;
  Instant at{};
  std::uint32_t learned = 0;  // samples in the bias
};

struct ReckoningState {
  bool begun = false;
  Pose pose;
  std::array<Gyroscope, world::kGnssUnits> gyros;
  bool gyro_used = false;               // in the last step
  steering::Learned learned;            // of the car's steering, for when no gyroscope is there
  Instant position_at{};                // of the last accepted one; of the car's last word before
  bool positioned = false;              // a position was accepted since the car's last word
  std::uint32_t used = 0, refused = 0;  // positions and headings
};
static_assert(std::is_trivially_copyable_v<ReckoningState>);

// What the car says of itself on the bus.
struct Motion {
  double speed_mps = kUnset;           // by its wheels; unset: nothing new, the last is kept
  double steering_motor_rad = kUnset;  // unset: not known
};

// In every tick: what the gyroscopes say.
void listen(ReckoningState& state, const world::SensorInput& sensors);

// While the car process lives: its word is taken, the gyroscopes are compared with it.
void follow_car(const ReckoningParams& params, ReckoningState& state, const world::EgoState& ego);

// Alone: moves on to `now` and takes what the receivers say. Begun before.
void reckon(const ReckoningParams& params, ReckoningState& state, const Motion& motion,
            const world::SensorInput& sensors, const Geodetic& datum, double bank_rad, Instant now);

}  // namespace pitwall::guardian
