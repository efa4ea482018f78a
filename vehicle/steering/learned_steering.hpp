// What this car on these tyres needs at the wheel beyond the steady-state bicycle of its file:
// learned from what was commanded and how the car turned, whoever steered.
//   in     the angle that was commanded last, speed, yaw rate, banking of the road
//   out    Learned: a constant angle, an understeer gradient, how that bends with the lateral
//          acceleration, and a lag, on top of the model's; how well they are known
//   units  rad, rad/(m/s2), rad/(m/s2)^3, s; lateral acceleration in the plane of the road,
//          positive left
//   invariants
//          with d the commanded angle behind the lag of steering and tyres, r the yaw rate,
//            z = d - L r / v - K a = d' + K' a + C' a^3 + T' dd/dt + noise,
//            a = v r - g sin(bank)
//          (d', K', C', T') is a random walk, estimated by a Kalman filter. Before anything is
//          measured its deviations are half of what the parameters say a car has at most.
//          The noise is that of the steady-state bicycle: residual_sigma over a correlation time,
//          and a share of the rate at which the wheel turns. All stay within their limits;
//          where the car is slow, or a value is not a number, they stay as they are
//   errors none
//   cost   O(1), no allocation
//   source Rajamani, Vehicle Dynamics and Control, 2nd ed., eq. 3.12 (steady-state bicycle);
//          Bar-Shalom, Li, Kirubarajan, Estimation with Applications to Tracking and Navigation,
//          eq. 5.2.3 (Kalman filter)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/steering/road_load.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::steering {

inline constexpr double kTickMax_s = 0.05;  // a longer pause is no longer step

struct Bicycle {
  double wheelbase_m = 2.971;
  double understeer_rad_per_mps2 = 0.0002;
};

inline constexpr world::Range kUndersteer_rad_per_mps2{-0.002, 0.01};

inline constexpr auto kBicycleRanges = std::to_array<world::NamedRange<Bicycle>>({
    {"wheelbase_m", &Bicycle::wheelbase_m, 2.5, 3.5},
    {"understeer_rad_per_mps2", &Bicycle::understeer_rad_per_mps2, kUndersteer_rad_per_mps2.least,
     kUndersteer_rad_per_mps2.most},
});

inline constexpr std::size_t kLearnedNumbers = 4;

struct Learned {
  double commanded_rad = 0.0;      // behind the lag: what the wheels have done by now
  double turning_rad_per_s = 0.0;  // of commanded_rad
  double offset_rad = 0.0, understeer_rad_per_mps2 = 0.0, bend_rad_s6_per_m3 = 0.0, lag_s = 0.0;
  // Covariance of these four, the upper triangle row by row; not yet set: nothing was measured.
  std::array<double, kLearnedNumbers*(kLearnedNumbers + 1) / 2> covariance{kUnset};
};
static_assert(std::is_trivially_copyable_v<Learned>);

struct LearningParams {
  double lag_s = 0.15;  // command to yaw rate: delay, actuator, tyres
  // Of any car, until its own are known.
  double offset_most_rad = 0.004;
  double understeer_most_rad_per_mps2 = 0.0025;
  double bend_most_rad_s6_per_m3 = 1.5e-6;
  double residual_sigma_rad = 0.001;  // of what the steady state does not explain
};

inline constexpr auto kLearningRanges = std::to_array<world::NamedRange<LearningParams>>({
    {"lag_s", &LearningParams::lag_s, 0.02, 0.5},
    {"offset_most_rad", &LearningParams::offset_most_rad, 0.0001, 0.02},
    {"understeer_most_rad_per_mps2", &LearningParams::understeer_most_rad_per_mps2,
     kUndersteer_rad_per_mps2.least, kUndersteer_rad_per_mps2.most},
    {"bend_most_rad_s6_per_m3", &LearningParams::bend_most_rad_s6_per_m3, 1e-8, 1e-4},
    {"residual_sigma_rad", &LearningParams::residual_sigma_rad, 0.0001, 0.02},
});

// How the car moves: speed forward, yaw rate about body z.
struct Turning {
  double speed_mps = kUnset, yaw_rate_rad_per_s = kUnset, bank_rad = 0.0;
};

double lateral_mps2(const Turning& at);

// The steady-state angle of a curvature in the plane of the road.
double angle_rad(const Bicycle& car, const Learned& learned, double curvature_per_m,
                 double lateral_mps2);
double angle_rad(const Bicycle& car, const Learned& learned, const RoadLoad& at);

// The gradient from the origin to a lateral acceleration. It bends no further than to 18 m/s2.
double understeer_at(const Bicycle& car, const Learned& learned, double lateral_mps2);

// How much more angle the car may need at a lateral acceleration than what was learned says: twice
// the deviation of K' a + C' a^3. It grows beyond the accelerations from which it was learned.
double doubt_rad(const LearningParams& params, const Bicycle& car, const Learned& learned,
                 double lateral_mps2);

// The angle that the car has turned by so far: the commanded one behind the lag that was learned.
inline double turned_rad(const Learned& learned) {
  return learned.commanded_rad - learned.lag_s * learned.turning_rad_per_s;
}

// What that angle has beyond what the car's turning needs by what was learned.
double residual_rad(const Bicycle& car, const Learned& learned, const Turning& at);

// The yaw rate of an angle, in steady state: for whoever has no gyroscope.
double yaw_rate_rad_per_s(const Bicycle& car, const Learned& learned, double angle_rad,
                          double speed_mps, double bank_rad);

// In every tick, whoever steers.
void follow_command(const LearningParams& params, Learned& learned, double commanded_rad,
                    Duration dt);
// In every tick in which the car is driven along its line.
void learn(const LearningParams& params, const Bicycle& car, Learned& learned, const Turning& at,
           Duration dt);

}  // namespace pitwall::steering
