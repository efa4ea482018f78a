// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/tracking/race_traffic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pitwall::tracking_bench {
namespace {

constexpr double kDecision_s = 0.05, kChange_s = 3.0;
constexpr double kBrakeEvery_s = 40.0, kChangeEvery_s = 25.0, kBrakes_s = 1.6;  // means; length
constexpr double kSpeedGain_per_s = 0.8, kPlaceGain_per_s2 = 0.15;
constexpr double kBeside_m = 2.6;     // lanes that are closer are one
constexpr double kGap_m = 14.0;       // of the centres, one behind the other
constexpr double kGentle_mps2 = 2.5;  // closes a gap without full braking
constexpr double kSpeedLeast_mps = 40.0;
constexpr double kTwoPi = 2.0 * std::numbers::pi;

double drawn_s(Random& random, double mean_s) { return -mean_s * std::log(1.0 - random.uniform()); }

}  // namespace

RaceTraffic::Target RaceTraffic::swinging(double middle, double swing, double period_s,
                                          double phase_rad, double now_s) {
  const double angle_rad = kTwoPi * now_s / period_s + phase_rad;
  return {middle + swing * std::sin(angle_rad), swing * kTwoPi / period_s * std::cos(angle_rad)};
}

RaceTraffic::RaceTraffic(const TrafficPlan& plan, std::uint64_t seed) : plan_(plan), random_{seed} {
  const auto add = [&](double s_m, double lane_m) {
    Driver d;
    d.motion = {.s_m = s_m, .lane_m = lane_m, .speed_mps = plan.speed_mps};
    d.from_m = d.to_m = lane_m;
    d.next_brake_s = drawn_s(random_, kBrakeEvery_s);
    d.next_change_s = drawn_s(random_, kChangeEvery_s);
    drivers_.push_back(d);
  };
  add(0.0, plan.our_lane_m);
  for (const Aim& aim : plan.others)
    add(swinging(aim.ahead_m, aim.swing_m, aim.period_s, aim.phase_rad, 0.0).value, aim.lane_m);
}

// In our lane or the one that we change to, or coming there.
const RaceTraffic::Driver* RaceTraffic::leader(std::size_t car) const {
  const Driver& own = drivers_[car];
  const Driver* nearest = nullptr;
  for (const Driver& other : drivers_) {
    const double ahead_m = other.motion.s_m - own.motion.s_m;
    if (&other == &own || ahead_m <= 0.0) continue;
    const bool is_beside = std::abs(other.motion.lane_m - own.motion.lane_m) > kBeside_m &&
                           std::abs(other.to_m - own.to_m) > kBeside_m &&
                           std::abs(other.motion.lane_m - own.to_m) > kBeside_m;
    if (is_beside || (nearest && ahead_m > nearest->motion.s_m - own.motion.s_m)) continue;
    nearest = &other;
  }
  return nearest;
}

bool RaceTraffic::is_free_lane(std::size_t car, double lane_m) const {
  const Driver& own = drivers_[car];
  return std::ranges::none_of(drivers_, [&](const Driver& other) {
    if (&other == &own) return false;
    const double nearest_m =
        std::min(std::abs(other.to_m - lane_m), std::abs(other.motion.lane_m - lane_m));
    if (nearest_m > kBeside_m) return false;
    const double ahead_m = other.motion.s_m - own.motion.s_m;
    const double closing_mps = ahead_m > 0.0 ? own.motion.speed_mps - other.motion.speed_mps
                                             : other.motion.speed_mps - own.motion.speed_mps;
    return std::abs(ahead_m) < 2.0 * kGap_m + kChange_s * std::max(0.0, closing_mps);
  });
}

void RaceTraffic::change_lane(std::size_t car) {
  Driver& own = drivers_[car];
  if (own.from_m != own.to_m) return;
  const double first = random_.uniform() < 0.5 ? -kLaneWidth_m : kLaneWidth_m;
  for (const double lane_m : {own.to_m + first, own.to_m - first}) {
    if (lane_m < kLanes_m[0] - 1.0 || lane_m > kLanes_m[3] + 1.0) continue;
    if (!is_free_lane(car, lane_m)) continue;
    own.to_m = lane_m, own.change_s = 0.0;
    return;
  }
}

RaceTraffic::Target RaceTraffic::reference_speed() const {
  return swinging(plan_.speed_mps, plan_.speed_swing_mps, plan_.speed_period_s, 0.0, now_s_);
}

double RaceTraffic::wanted_accel(std::size_t car) const {
  const Driver& own = drivers_[car];
  const Aim aim = car > 0 ? plan_.others[car - 1] : Aim{};
  const Target speed = reference_speed();
  const Target place = swinging(aim.ahead_m, aim.swing_m, aim.period_s, aim.phase_rad, now_s_);
  double wanted_mps2 = speed.rate +
                       kSpeedGain_per_s * (speed.value + place.rate - own.motion.speed_mps) +
                       kPlaceGain_per_s2 * (reference_m_ + place.value - own.motion.s_m);
  if (own.motion.speed_mps > kSpeedLeast_mps && now_s_ < own.brakes_until_s)
    wanted_mps2 = -plan_.brake_most_mps2;
  if (const Driver* const ahead = plan_.is_free ? leader(car) : nullptr) {
    const double gap_m = ahead->motion.s_m - own.motion.s_m - kGap_m;
    const double closing_mps = own.motion.speed_mps - ahead->motion.speed_mps;
    const double margin_m =
        0.5 * std::max(0.0, closing_mps) * std::max(0.0, closing_mps) / kGentle_mps2;
    if (gap_m < margin_m + 8.0)
      wanted_mps2 =
          std::min(wanted_mps2, ahead->motion.accel_mps2 - 0.6 * (margin_m + 8.0 - gap_m));
  }
  return std::clamp(wanted_mps2, -plan_.brake_most_mps2, plan_.accel_most_mps2);
}

void RaceTraffic::decide(std::size_t car) {
  Driver& own = drivers_[car];
  if (plan_.is_free) {
    if (now_s_ >= own.next_brake_s) {
      own.brakes_until_s = now_s_ + kBrakes_s;
      own.next_brake_s = own.brakes_until_s + drawn_s(random_, kBrakeEvery_s);
    }
    const Driver* const ahead = leader(car);
    const double closing_mps = ahead ? own.motion.speed_mps - ahead->motion.speed_mps : 0.0;
    const bool is_held_up =
        ahead && ahead->motion.s_m - own.motion.s_m < 25.0 + 3.0 * std::max(0.0, closing_mps);
    const bool is_time = now_s_ >= own.next_change_s;
    if (is_time) own.next_change_s = now_s_ + drawn_s(random_, kChangeEvery_s);
    if (is_time || is_held_up) change_lane(car);
  }
  own.wanted_mps2 = wanted_accel(car);
}

// Least jerk: 10 t^3 - 15 t^4 + 6 t^5.
void RaceTraffic::steer(Driver& driver, double dt_s) const {
  if (driver.from_m == driver.to_m) return;
  driver.change_s += dt_s;
  const double t = std::min(1.0, driver.change_s / kChange_s);
  const double way_m = driver.to_m - driver.from_m;
  driver.motion.lane_m = driver.from_m + way_m * t * t * t * (10.0 + t * (-15.0 + 6.0 * t));
  driver.motion.lane_rate_mps = way_m * 30.0 * t * t * (1.0 - t) * (1.0 - t) / kChange_s;
  if (t < 1.0) return;
  driver.from_m = driver.to_m;
  driver.motion.lane_rate_mps = 0.0;
}

void RaceTraffic::step(const RaceLanes& lanes, Duration dt) {
  if (now_s_ >= next_decision_s_) {
    for (std::size_t car = 0; car < drivers_.size(); ++car) decide(car);
    next_decision_s_ += kDecision_s;
  }
  for (Driver& d : drivers_) {
    const double most = kJerk_mps3 * dt.seconds();
    d.motion.accel_mps2 += std::clamp(d.wanted_mps2 - d.motion.accel_mps2, -most, most);
    steer(d, dt.seconds());
    lanes.advance(d.motion, dt.seconds());
  }
  reference_m_ += dt.seconds() * reference_speed().value;
  now_s_ += dt.seconds();
}

}  // namespace pitwall::tracking_bench
