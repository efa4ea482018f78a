// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/speed_profile.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::planning {
namespace {

constexpr double kLandingShare = 0.8;  // of the jerk: the rest lets the landing law be followed
constexpr double kCoast_mps2 = 0.3;    // rolling resistance: a car always slows by that much
// Where a stop looks for the ellipse to shrink: as far as the jerk takes to let go of the brake.
constexpr std::array kStopAhead_s{0.0, 0.2, 0.4, 0.6};
constexpr double kCapAhead_s = 0.45;  // a falling limit is read this far ahead: time for the jerk
constexpr double kCapHorizon_m = 250.0;  // how far ahead the line's limits are looked at
constexpr double kCapDecelShare = 0.9;
constexpr double kSpacingMin_m = 2.0;
constexpr int kSubsteps = 3;  // the limits change slowly, the landing on the target does not
constexpr double kSubstep_s = kProfileStep_s / kSubsteps;

const LinePoint& nearest(const Line& line, double s_m) {
  const auto i = static_cast<std::size_t>(line.wrap(s_m) / line.spacing_m);
  return line.points[std::min(i, line.points.size() - 1)];
}

// The speed now from which every limit of the line ahead can be met at a moderate deceleration.
double cap(const Line& line, double s_m, double speed_mps, const DriveLimits& limits,
           double decel_mps2) {
  constexpr double kCapStep_m = 10.0;
  const double horizon_m = std::min(kCapHorizon_m, speed_mps * speed_mps / (2.0 * decel_mps2));
  const std::size_t count = line.points.size();
  const auto stride =
      std::max(static_cast<std::size_t>(kCapStep_m / line.spacing_m), static_cast<std::size_t>(1));
  const double stride_m = static_cast<double>(stride) * line.spacing_m;
  auto i = static_cast<std::size_t>(line.wrap(s_m + kCapAhead_s * speed_mps) / line.spacing_m);
  const double here_mps = limit_mps(nearest(line, s_m), limits);
  double lowest = here_mps * here_mps;
  for (double d = 0.0; d <= horizon_m; d += stride_m, i += stride) {
    if (i >= count) i %= count;
    const double v = limit_mps(line.points[i], limits);
    lowest = std::min(lowest, v * v + 2.0 * decel_mps2 * d);
  }
  return std::sqrt(lowest);
}

SpeedLimits drive_limits(const Line& line, double s_m, double speed_mps, const DriveLimits& l) {
  const double limit_mps = cap(line, s_m, speed_mps, l, kCapDecelShare * l.decel_max_mps2);
  return {std::min(l.target_mps, limit_mps), l.accel_max_mps2, l.decel_max_mps2, l.jerk_max_mps3};
}

SpeedLimits stop_limits(const RoadAhead& road, double distance_m, double speed_mps,
                        const StopLimits& l) {
  return {0.0, 0.0, stop_decel_mps2(road, distance_m, speed_mps, l), l.jerk_max_mps3};
}

// The reference played forward in time, as far as `reach_m` or to standstill.
struct History {
  struct Moment {
    double gone_m = 0.0;
    SpeedReference reference;  // the acceleration is that of the step that led here
  };
  std::array<Moment, kProfileSteps + 1> at;
  std::size_t size = 0;
  bool stands = false;
};

template <class LimitsAt>
void play(double s_m, SpeedReference now, double reach_m, LimitsAt limits_at, History& out) {
  out.at[0] = {0.0, now};
  out.size = 1;
  while (out.size <= kProfileSteps && out.at[out.size - 1].gone_m <= reach_m) {
    const double gone_m = out.at[out.size - 1].gone_m;
    const SpeedLimits limits = limits_at(s_m + gone_m, now.speed_mps);
    double step_m = 0.0;
    for (int i = 0; i < kSubsteps; ++i) {
      const SpeedReference then = advance(now, limits, kSubstep_s);
      step_m += 0.5 * (now.speed_mps + then.speed_mps) * kSubstep_s;
      now = then;
    }
    out.at[out.size++] = {gone_m + step_m, now};
    out.stands = !(now.speed_mps > 0.0) && !(limits.target_mps > 0.0);
    if (out.stands) return;
  }
}

// The history at equal distances; past its end it stands, or goes on as it ended.
SpeedProfile sampled(const History& history, double spacing_m) {
  SpeedProfile out;
  out.spacing_m = spacing_m;
  const History::Moment& last = history.at[history.size - 1];
  std::size_t k = 1;
  for (std::size_t i = 0; i < out.at.size(); ++i) {
    const double d_m = static_cast<double>(i) * spacing_m;
    while (k < history.size && history.at[k].gone_m < d_m) ++k;
    if (k == history.size) {
      out.at[i] = history.stands ? SpeedReference{} : last.reference;
      continue;
    }
    const History::Moment &a = history.at[k - 1], &b = history.at[k];
    const double step_m = b.gone_m - a.gone_m;
    const double t = step_m > 0.0 ? (d_m - a.gone_m) / step_m : 0.0;
    out.at[i] = {a.reference.speed_mps + t * (b.reference.speed_mps - a.reference.speed_mps),
                 b.reference.accel_mps2};
  }
  if (history.stands) out.stop_distance_m = last.gone_m;
  return out;
}

}  // namespace

double limit_mps(const LinePoint& p, const DriveLimits& limits) {
  const double by_grip_mps = limit_mps(p, limits.tyres);
  if (!limits.steering) return by_grip_mps;
  return steering::fastest_mps(*limits.steering, p.curvature_per_m, p.bank_rad, by_grip_mps);
}

const RoadSample& RoadAhead::sample(double distance_m) const {
  const double index = std::max(distance_m, 0.0) / kRoadStep_m + 0.5;
  return at[std::min(static_cast<std::size_t>(index), kRoadPoints - 1)];
}

double coasting_mps2(const envelope::FrictionParams& car, double speed_mps) {
  return kCoast_mps2 + car.drag_per_m * speed_mps * speed_mps;
}

double stop_decel_mps2(const RoadAhead& road, double distance_m, double speed_mps,
                       const StopLimits& l) {
  double brake = l.decel_max_mps2;
  for (const double ahead_s : kStopAhead_s) {
    const RoadSample& p = road.sample(distance_m + ahead_s * speed_mps);
    const steering::RoadLoad load{speed_mps, p.curvature_per_m, p.bank_rad, p.cos_bank, p.sin_bank};
    brake = std::min(brake, brake_available_mps2(l.friction, load, l.grip_share));
  }
  const double coast = coasting_mps2(l.friction, speed_mps);
  return std::max(std::min(brake + coast, l.decel_max_mps2), coast);
}

SpeedReference advance(const SpeedReference& r, const SpeedLimits& limits, double dt_s) {
  if (!(dt_s > 0.0)) return r;
  const double error = limits.target_mps - r.speed_mps;
  const double size =
      std::min(std::sqrt(2.0 * kLandingShare * limits.jerk_max_mps3 * std::abs(error)),
               std::abs(error) / dt_s);
  const double wanted =
      std::clamp(std::copysign(size, error), -limits.decel_max_mps2, limits.accel_max_mps2);
  const double change = limits.jerk_max_mps3 * dt_s;
  const double accel = r.accel_mps2 + std::clamp(wanted - r.accel_mps2, -change, change);
  const double speed = r.speed_mps + 0.5 * (r.accel_mps2 + accel) * dt_s;
  if (speed <= 0.0) return {0.0, std::max(accel, 0.0)};
  return {speed, accel};
}

SpeedReference advance_drive(const Line& line, double s_m, const SpeedReference& from,
                             const DriveLimits& limits, double dt_s) {
  return advance(from, drive_limits(line, s_m, from.speed_mps, limits), dt_s);
}

SpeedProfile drive_profile(const Line& line, double s_m, const SpeedReference& from,
                           const DriveLimits& limits, double spacing_m) {
  History history;
  const double reach_m = spacing_m * static_cast<double>(world::kTrajectoryPoints);
  play(
      s_m, from, reach_m, [&](double s, double v) { return drive_limits(line, s, v, limits); },
      history);
  return sampled(history, spacing_m);
}

SpeedReference advance_stop(const RoadAhead& road, const SpeedReference& from,
                            const StopLimits& limits, double dt_s) {
  return advance(from, stop_limits(road, 0.0, from.speed_mps, limits), dt_s);
}

SpeedProfile stop_profile(const RoadAhead& road, const SpeedReference& from,
                          const StopLimits& limits, double beyond_m) {
  constexpr double kAnywhere_m = 1e9;
  History history;
  play(
      0.0, from, kAnywhere_m, [&](double d, double v) { return stop_limits(road, d, v, limits); },
      history);
  const double least_m = history.stands ? history.at[history.size - 1].gone_m : 0.0;
  constexpr double kSegments = world::kTrajectoryPoints - 1;
  SpeedProfile profile =
      sampled(history, std::max((least_m + beyond_m) / kSegments, kSpacingMin_m));
  // Whatever the horizon of the simulation left over: the last point always stands.
  profile.at.back() = {};
  return profile;
}

}  // namespace pitwall::planning
