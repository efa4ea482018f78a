// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/checks/wheel_watch.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/fixed_vector.hpp"

namespace pitwall::localization {
namespace {

using Speeds = std::array<double, world::kCorners>;
constexpr std::array kLeft{1.0, -1.0, 1.0, -1.0};  // side of the car, by world::Corner

// A left wheel of a car that turns left is slower than its middle.
Speeds in_the_middle(const CheckParams& params, const WheelFacts& facts) {
  Speeds out{};
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = facts.speed_mps.at[i] + kLeft[i] * params.half_track_m * facts.yaw_rate_rad_per_s;
  return out;
}

// Of the wheels that are numbers: the mean of the middle two, of three the middle one.
double middle_of(const Speeds& speeds) {
  FixedVector<double, world::kCorners> sorted;
  for (const double v : speeds)
    if (std::isfinite(v)) (void)sorted.push(v);
  if (sorted.empty()) return kUnset;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t n = sorted.size();
  return 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
}

bool near(double a, double b, double limit, double share) {
  return std::abs(a - b) <= limit + share * std::abs(b);
}

bool believable(const CheckParams& p, double wheel, double middle, double by_receivers) {
  if (!near(wheel, middle, p.wheel_spread_mps, p.wheel_spread_per_speed)) return false;  // NaN too
  return std::isnan(by_receivers) ||
         near(wheel, by_receivers, p.wheel_speed_max_mps, p.wheel_speed_max_per_speed);
}

void judge_wheel(const CheckParams& params, WheelWatch::Wheel& wheel, bool agrees, Instant now) {
  if (agrees && !wheel.agrees) wheel.agrees_since = now;
  wheel.agrees = agrees;
  if (!agrees) wheel.out = true;
  if (agrees && now - wheel.agrees_since >= from_seconds(params.readmit_after_s)) wheel.out = false;
}

// The two of an axle, or the one that is believed.
double axle(const WheelWatch& watch, const Speeds& speeds, std::size_t left) {
  const bool has_left = !watch.wheels[left].out, has_right = !watch.wheels[left + 1].out;
  if (has_left && has_right) return 0.5 * (speeds[left] + speeds[left + 1]);
  if (has_left) return speeds[left];
  return has_right ? speeds[left + 1] : kUnset;
}

}  // namespace

WheelSpeed watch_wheels(const CheckParams& params, WheelWatch& watch, const WheelFacts& facts,
                        bool watched, Instant now) {
  const Speeds speeds = in_the_middle(params, facts);
  WheelSpeed out;
  if (!watched) {
    watch = {};
    out.speed_mps = 0.25 * (speeds[0] + speeds[1] + speeds[2] + speeds[3]);
    return out;
  }
  // Two that agree with each other outvote nobody: with the receivers' word that decides.
  const double middle =
      std::isnan(facts.by_receivers_mps) ? middle_of(speeds) : facts.by_receivers_mps;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    judge_wheel(params, watch.wheels[i],
                believable(params, speeds[i], middle, facts.by_receivers_mps), now);
    out.contradiction |= watch.wheels[i].out;
  }
  const double front = axle(watch, speeds, 0), rear = axle(watch, speeds, 2);
  out.speed_mps = std::isnan(rear) ? front : rear;
  return out;
}

}  // namespace pitwall::localization
