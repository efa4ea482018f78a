// Position estimator of the guardian while the car process is silent. It starts from the car
// process's last estimate, propagates it with a gyroscope and the wheel speeds, and corrects it
// with GNSS positions and headings within their gates. It is small and has fixed gains on purpose:
// it must last for the twenty seconds of a stop.
//   in     the car's estimate while the car process runs; IMU samples, positions and headings of
//          the guardian's own receivers, wheel speeds and steering angle from the bus, the banking
//          of the path
//   out    Pose at `now`
//   frames Map, Body; banking positive where the left side is lower
//   invariants
//          with r the yaw rate about body z, phi the banking:
//             yaw' = r / cos(phi);  vy = b r - v C a_y,  a_y = v r - g sin(phi)
//             (the rear axle slips by C a_y)
//             x' = v cos(yaw) - vy cos(phi) sin(yaw), y' likewise
//          if two gyroscopes are available and differ, the one that agrees better with the steering
//          is used; the bias of each is its mean difference from the car's own estimate. Without a
//          gyroscope the yaw rate is the steady-state one of the steering angle
//          (steering/learned_steering.hpp)
//          a position corrects the position by a share of its innovation, and the yaw by the
//          lateral part of it (alpha-beta filter, beta = alpha^2 / (2 - alpha))
//   errors a sample outside its gate, or without a fixed solution, changes nothing and is counted
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
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;  // primary antenna, from the centre of gravity
  double baseline_yaw_rad = 0.0;           // direction of the antenna baseline in Body
};

struct ReckoningParams {
  std::array<ReceiverMounting, world::kGnssUnits> units;
  steering::Bicycle bicycle;
  double steering_ratio = 19.5;              // [10, 25]
  Duration gyro_age_max = milliseconds(50);  // [10, 200] ms
  double gyro_differ_rad_per_s = 0.05;       // above it the steering decides; [0.01, 0.5]
  double position_share = 0.15;              // alpha; [0.02, 0.5]
  double position_sigma_max_m = 0.3;         // [0.05, 2]
  double position_gate_m = 0.6;              // directly after an accepted position; [0.2, 3]
  double position_gate_mps = 0.5;            // growth of the gate with time; [0, 2]
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
  bool gyro_used = false;     // in the last step
  steering::Learned learned;  // for use without a gyroscope
  Instant position_at{};      // last accepted position; before it, last estimate of the car
  bool positioned = false;    // a position was accepted since that estimate
  std::uint32_t used = 0, refused = 0;  // positions and headings
};
static_assert(std::is_trivially_copyable_v<ReckoningState>);

// Motion of the car from the bus.
struct Motion {
  double speed_mps = kUnset;           // from the wheels; unset: the last value is kept
  double steering_motor_rad = kUnset;  // unset: not known
};

// Takes the gyroscope rates, in every tick.
void store_gyro_rates(ReckoningState& state, const world::SensorInput& sensors);

// Takes the car's estimate and updates the gyroscope biases from it, while the car process runs.
void follow_car(const ReckoningParams& params, ReckoningState& state, const world::EgoState& ego);

// Propagates to `now` and takes the receivers' samples, while the car process is silent. Requires
// `begun`.
void reckon(const ReckoningParams& params, ReckoningState& state, const Motion& motion,
            const world::SensorInput& sensors, const Geodetic& datum, double bank_rad, Instant now);

}  // namespace pitwall::guardian
