// Learned steering correction: the steering angle that this car on these tyres needs beyond the
// steady-state bicycle model of its file, estimated from the commanded angles and the yaw rate,
// for every controller that steers.
//   in     the last commanded angle, speed, slip, yaw rate, banking of the road
//   out    Learned: a constant angle, an understeer gradient, its change with the lateral
//          acceleration, and a lag, each in addition to the model; their covariance; the slip
//          gradient of the rear axle
//   units  rad, rad/(m/s2), rad/(m/s2)^3, s; lateral acceleration in the plane of the road,
//          positive left
//   invariants
//          with d the commanded angle after the lag of steering and tyres, r the yaw rate,
//             z = d - L r / v - K a = d' + K' a + C' a^3 + T' dd/dt + noise,
//             a = v r - g sin(bank)
//          (d', K', C', T') is a random walk, estimated by a Kalman filter. Its initial standard
//          deviations are half of the largest values that the parameters give for any car. The
//          noise is that of the steady-state bicycle: residual_sigma with a correlation time, and a
//          share of the rate of the wheel angle. All four stay within their limits. They do not
//          change at low speed or if a value is not a number
//          with beta the slip angle, lr r / v - beta = (G + G') a + noise: G' is a random walk,
//          estimated by another filter
//   errors none
//   cost   O(1), no allocation
//   source Rajamani, Vehicle Dynamics and Control, 2nd ed., eq. 3.12 (steady-state bicycle);
//          Bar-Shalom, Li, Kirubarajan, Estimation with Applications to Tracking and Navigation,
//          eq. 5.2.3 (Kalman filter)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/steering/road_load.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::steering {

inline constexpr double kTickMax_s = 0.05;  // a longer pause counts as this

inline double tick_s(Duration dt) { return std::clamp(dt.seconds(), 0.0, kTickMax_s); }

struct Bicycle {
  double wheelbase_m = 2.971;
  double understeer_rad_per_mps2 = 0.0002;
  double cg_to_rear_m = 1.247;
  double rear_slip_rad_per_mps2 = 0.0014;  // slip angle of the rear axle per lateral acceleration
};

inline constexpr world::Range kUndersteer_rad_per_mps2{-0.002, 0.01};

inline constexpr auto kBicycleRanges = std::to_array<world::NamedRange<Bicycle>>({
    {"wheelbase_m", &Bicycle::wheelbase_m, 2.5, 3.5},
    {"understeer_rad_per_mps2", &Bicycle::understeer_rad_per_mps2, kUndersteer_rad_per_mps2.least,
     kUndersteer_rad_per_mps2.most},
    {"cg_to_rear_m", &Bicycle::cg_to_rear_m, 0.5, 2.0},
    {"rear_slip_rad_per_mps2", &Bicycle::rear_slip_rad_per_mps2, 0.0, 0.02},
});

inline constexpr std::size_t kLearnedNumbers = 4;

struct Learned {
  double commanded_rad = 0.0;      // command after the lag of params: the angle in effect
  double turning_rad_per_s = 0.0;  // rate of commanded_rad
  double offset_rad = 0.0, understeer_rad_per_mps2 = 0.0, bend_rad_s6_per_m3 = 0.0, lag_s = 0.0;
  double rear_slip_rad_per_mps2 = 0.0;  // in addition to the model
  double rear_slip_variance = kUnset;
  // Covariance of the first four, upper triangle by rows; unset before the first measurement.
  std::array<double, kLearnedNumbers*(kLearnedNumbers + 1) / 2> covariance{kUnset};
  // Innovation of this tick's update (the residual before it), and its standard deviation by the
  // covariance and the noise; unset where nothing is learned.
  double innovation_rad = kUnset, innovation_sigma_rad = kUnset;
};
static_assert(std::is_trivially_copyable_v<Learned>);

struct LearningParams {
  double lag_s = 0.15;  // command to yaw rate: delay, actuator, tyres
  // Largest values of any car, for the initial standard deviations.
  double offset_most_rad = 0.004;
  double understeer_most_rad_per_mps2 = 0.0025;
  double bend_most_rad_s6_per_m3 = 1.5e-6;
  double residual_sigma_rad = 0.001;  // of the residual of the steady-state model
};

inline constexpr auto kLearningRanges = std::to_array<world::NamedRange<LearningParams>>({
    {"lag_s", &LearningParams::lag_s, 0.02, 0.5},
    {"offset_most_rad", &LearningParams::offset_most_rad, 0.0001, 0.02},
    {"understeer_most_rad_per_mps2", &LearningParams::understeer_most_rad_per_mps2,
     kUndersteer_rad_per_mps2.least, kUndersteer_rad_per_mps2.most},
    {"bend_most_rad_s6_per_m3", &LearningParams::bend_most_rad_s6_per_m3, 1e-8, 1e-4},
    {"residual_sigma_rad", &LearningParams::residual_sigma_rad, 0.0001, 0.02},
});

// Motion of the centre of gravity: speed forward, yaw rate about body z, slip to the left.
struct Turning {
  double speed_mps = kUnset, yaw_rate_rad_per_s = kUnset, bank_rad = 0.0;
  double slip_mps = kUnset;
};

double lateral_mps2(const Turning& at);

// Steady-state angle for a curvature in the plane of the road.
double angle_rad(const Bicycle& car, const Learned& learned, double curvature_per_m,
                 double lateral_mps2);
double angle_rad(const Bicycle& car, const Learned& learned, const RoadLoad& at);

// Secant understeer gradient from zero to a lateral acceleration. Beyond 18 m/s2 it is constant.
double understeer_at(const Bicycle& car, const Learned& learned, double lateral_mps2);

// Uncertainty of the steady-state angle at a lateral acceleration: two standard deviations of K' a
// + C' a^3. It grows beyond the accelerations that were learned from.
double doubt_rad(const LearningParams& params, const Bicycle& car, const Learned& learned,
                 double lateral_mps2);

// Effective steering angle: the command after the learned lag.
inline double turned_rad(const Learned& learned) {
  return learned.commanded_rad - learned.lag_s * learned.turning_rad_per_s;
}

// Difference between the effective angle and the angle that the yaw rate needs by the model with
// the learned correction.
double residual_rad(const Bicycle& car, const Learned& learned, const Turning& at);

// Steady-state slip angle of the centre of gravity, lr k - (G + G') a.
double slip_rad(const Bicycle& car, const Learned& learned, const RoadLoad& at);

// Steady-state yaw rate of an angle, for use without a gyroscope.
double yaw_rate_rad_per_s(const Bicycle& car, const Learned& learned, double angle_rad,
                          double speed_mps, double bank_rad);

// To be called in every tick, for every controller that steers.
void follow_command(const LearningParams& params, Learned& learned, double commanded_rad,
                    Duration dt);
// To be called in every tick in which the car is driven along its line.
void learn(const LearningParams& params, const Bicycle& car, Learned& learned, const Turning& at,
           Duration dt);

}  // namespace pitwall::steering
