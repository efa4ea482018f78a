// What this car on these tyres needs at the wheel beyond the steady-state bicycle of its file:
// learned from what was commanded and how the car turned, whoever steered.
//   in     the angle that was commanded last, speed, yaw rate, banking of the road
//   out    Learned: a constant angle and an understeer gradient, on top of the model's
//   units  rad, rad/(m/s2); lateral acceleration in the plane of the road, positive left
//   invariants
//          with d the commanded angle behind the lag of steering and tyres, r the yaw rate,
//            residual = d - (L r / v + (K + K') a + d'),  a = v r - g sin(bank)
//            (d', K') += residual * phi / (phi' phi + 1/4) * dt / T,
//            phi = (c, a / a0)        (normalised gradient)
//          T begins as learn_s and grows with the time spent in turns: at first it learns, later
//          it averages. What is to be expected of a gradient goes over from the most to the learned
//          one with the time in turns. Both stay within their limits; where the car is slow, or
//          a value is not a number, they stay as they are
//   errors none
//   cost   O(1), no allocation
//   source Rajamani, Vehicle Dynamics and Control, 2nd ed., eq. 3.12 (steady-state bicycle);
//          Haykin, Adaptive Filter Theory, 4th ed., ch. 6 (normalised LMS)
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

struct Learned {
  double commanded_rad = 0.0;  // behind the lag: what the wheels have done by now
  double offset_rad = 0.0, understeer_rad_per_mps2 = 0.0;
  double turned_s = 0.0;  // how long it was learned from turns
};
static_assert(std::is_trivially_copyable_v<Learned>);

struct LearningParams {
  double lag_s = 0.2;  // command to yaw rate: delay, actuator, tyres
  double learn_s = 3.0;
  double understeer_most_rad_per_mps2 = 0.0025;  // of any car, until its own is known
};

inline constexpr auto kLearningRanges = std::to_array<world::NamedRange<LearningParams>>({
    {"lag_s", &LearningParams::lag_s, 0.02, 0.5},
    {"learn_s", &LearningParams::learn_s, 0.5, 60.0},
    {"understeer_most_rad_per_mps2", &LearningParams::understeer_most_rad_per_mps2,
     kUndersteer_rad_per_mps2.least, kUndersteer_rad_per_mps2.most},
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

// The gradient to be prepared for: the learned one, and more as long as little was learned.
double understeer_to_expect(const LearningParams& params, const Bicycle& car,
                            const Learned& learned);

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
