// SPDX-License-Identifier: Apache-2.0
#include "vehicle/envelope/lap_profile.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::envelope {
namespace {

constexpr double kSpeedLeast_mps = 1.0;  // a line that is slower is none
constexpr double kSettled_mps = 1e-9;    // between the speeds at the start of two laps
constexpr int kLapsMax = 40;             // a lap that is flat out loses an e-th every 800 m

// What an upward shift takes of the drive.
class Shifts {
 public:
  Shifts(const Engine& engine, double speed_mps) : engine_(engine) {
    if (has_gears(engine)) gear_ = gear_at(engine, speed_mps);
  }

  std::size_t gear() const { return gear_; }

  // Share of this step without drive.
  double cut(double step_s) {
    const double cut_s = std::min(left_s_, step_s);
    left_s_ -= cut_s;
    return cut_s / step_s;
  }

  void pass(double speed_mps) {
    if (!has_gears(engine_)) return;
    while (gear_ < kGears && speed_mps > engine_.up_above_mps[gear_ - 1])
      ++gear_, left_s_ += engine_.shift_s;
    while (gear_ > 1 && speed_mps < engine_.down_below_mps[gear_ - 2]) --gear_, left_s_ = 0.0;
  }

 private:
  const Engine& engine_;
  std::size_t gear_ = 0;
  double left_s_ = 0.0;
};

}  // namespace

std::size_t LapProfile::limit(std::span<const RoadStep> road) {
  places_.resize(road.size());
  limit_mps_.resize(road.size());
  std::size_t slowest = 0;
  for (std::size_t i = 0; i < road.size(); ++i) {
    places_[i] = table_->place(road[i].curvature_per_m, road[i].bank_rad);
    limit_mps_[i] = std::min(table_->corner_speed_mps(places_[i]), road[i].cap_mps);
    if (limit_mps_[i] < limit_mps_[slowest]) slowest = i;
  }
  return slowest;
}

// Backward, once around: braking never leads below the slowest of all limits.
void LapProfile::brake(std::span<const RoadStep> road, std::size_t from) {
  const std::size_t n = limit_mps_.size();
  std::size_t after = from;
  for (std::size_t k = 1; k < n; ++k) {
    const std::size_t i = after > 0 ? after - 1 : n - 1;
    const double v = limit_mps_[after];
    const double brake = table_->longitudinal(places_[after], v).brake_mps2;
    limit_mps_[i] = std::min(limit_mps_[i], std::sqrt(v * v + 2.0 * road[i].step_m * brake));
    after = i;
  }
}

// Forward, and again where the lap does not end as fast as it begins.
void LapProfile::drive(std::span<const RoadStep> road, std::size_t from,
                       std::span<world::LapPoint> out) {
  const std::size_t n = limit_mps_.size();
  speed_mps_.resize(n);
  speed_mps_[from] = limit_mps_[from];
  const Engine& engine = table_->params().friction.engine;
  for (int lap = 0; lap < kLapsMax; ++lap) {
    const double begin_mps = speed_mps_[from];
    Shifts shifts{engine, begin_mps};
    std::size_t i = from;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t next = i + 1 < n ? i + 1 : 0;
      const double v = speed_mps_[i];
      out[i].gear = static_cast<std::uint8_t>(shifts.gear());
      const double accel = table_->longitudinal(places_[i], v).accel_mps2;
      const double cut = shifts.cut(road[i].step_m / v);
      const double net = accel - cut * (accel + table_->coasting_mps2(v));
      const double reached2 = v * v + 2.0 * road[i].step_m * net;
      speed_mps_[next] = std::min(limit_mps_[next], std::sqrt(std::max(reached2, kSpeedLeast_mps)));
      shifts.pass(speed_mps_[next]);
      i = next;
    }
    if (std::abs(begin_mps - speed_mps_[from]) <= kSettled_mps) return;
  }
}

LapOutcome LapProfile::solve(std::span<const RoadStep> road, std::span<world::LapPoint> out) {
  CHECK(!road.empty() && road.size() == out.size());
  const std::size_t slowest = limit(road), n = road.size();
  if (!(limit_mps_[slowest] >= kSpeedLeast_mps)) return {kUnset, slowest};
  brake(road, slowest);
  drive(road, slowest, out);
  double time_s = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double v = speed_mps_[i], next = speed_mps_[i + 1 < n ? i + 1 : 0];
    out[i].speed_mps = v;
    out[i].accel_mps2 = (next * next - v * v) / (2.0 * road[i].step_m);
    out[i].time_s = time_s;
    time_s += 2.0 * road[i].step_m / (v + next);
  }
  return {time_s, std::nullopt};
}

}  // namespace pitwall::envelope
