// SPDX-License-Identifier: Apache-2.0
#include "vehicle/envelope/friction.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::envelope {
namespace {

constexpr double kSpeedFloor_mps = 1.0;  // below it, power / speed means nothing

double left_over(double grip_mps2, double lateral_mps2) {
  const double rest = grip_mps2 * grip_mps2 - lateral_mps2 * lateral_mps2;
  return rest > 0.0 ? std::sqrt(rest) : 0.0;
}

// The largest deceleration that both axles carry when `left` of the friction is theirs.
double braked_axles_mps2(const FrictionParams& car, double load_mps2, double left) {
  const double m = left * car.long_friction;
  const double front = m * car.load_front * load_mps2 / (car.brake_front - m * car.load_shift);
  const double rear =
      m * (1.0 - car.load_front) * load_mps2 / (1.0 - car.brake_front + m * car.load_shift);
  // A front axle that gains load faster than the brakes need it never limits.
  return car.brake_front > m * car.load_shift ? std::min(front, rear) : rear;
}

// The largest acceleration that the rear axle carries when `left` of the friction is its own.
double driven_axle_mps2(const FrictionParams& car, double load_mps2, double left) {
  const double m = left * car.long_friction;
  // A rear axle that gains load faster than the drive needs it never limits.
  const double gains = m * car.load_shift;
  return gains < 1.0 ? m * (1.0 - car.load_front) * load_mps2 / (1.0 - gains) : HUGE_VAL;
}

}  // namespace

FrictionParams on_tyres(const FrictionParams& car, double tyre_c) {
  FrictionParams out = car;
  out.friction *= world::share_at(car.tyres, tyre_c);
  return out;
}

double grip_mps2(const FrictionParams& car, const RoadLoad& at) {
  return car.friction * std::max(normal_load_mps2(at, car.downforce_per_m), 0.0);
}

double carried_mps(const FrictionParams& car, const RoadLoad& point, double share,
                   double most_mps) {
  const auto spare_mps2 = [&](double speed2) {
    RoadLoad at = point;
    at.speed_mps = std::sqrt(speed2);
    return share * car.friction * normal_load_mps2(at, car.downforce_per_m) -
           std::abs(lateral_demand_mps2(at));
  };
  const double most2 = most_mps * most_mps, beyond_mps2 = spare_mps2(most2);
  if (beyond_mps2 >= 0.0) return most_mps;
  // Linear in the square of the speed from there on where the bank alone turns the car.
  const double fall_mps2 = kGravity_mps2 * point.sin_bank, turn = turn_per_m(point);
  const double neutral2 = fall_mps2 * turn > 0.0 ? fall_mps2 / turn : 0.0;
  const double spare = neutral2 < most2 ? spare_mps2(neutral2) : beyond_mps2;
  if (!(spare >= 0.0)) return 0.0;
  return std::sqrt(neutral2 + (most2 - neutral2) * spare / (spare - beyond_mps2));
}

double brake_available_mps2(const FrictionParams& car, const RoadLoad& at, double share) {
  const double grip = grip_mps2(car, at);
  const double rest = left_over(share * grip, lateral_demand_mps2(at));
  if (!(rest > 0.0)) return 0.0;
  const double load = grip / car.friction;
  return std::min({rest, braked_axles_mps2(car, load, rest / load), car.brake_max_mps2});
}

double traction_mps2(const FrictionParams& car, const RoadLoad& at, double share) {
  const double grip = grip_mps2(car, at);
  const double rest = left_over(share * grip, lateral_demand_mps2(at));
  if (!has_gears(car.engine) || !(rest > 0.0)) return rest;
  const double load = grip / car.friction;
  return std::min(rest, driven_axle_mps2(car, load, rest / load));
}

double drive_available_mps2(const FrictionParams& car, const RoadLoad& at, double share) {
  const double power = car.power_w_per_kg / std::max(at.speed_mps, kSpeedFloor_mps);
  double drive = std::min({traction_mps2(car, at, share), power, car.accel_max_mps2});
  if (has_gears(car.engine)) drive = std::min(drive, drive_mps2(car.engine, at.speed_mps));
  return drive - car.drag_per_m * at.speed_mps * at.speed_mps;
}

}  // namespace pitwall::envelope
