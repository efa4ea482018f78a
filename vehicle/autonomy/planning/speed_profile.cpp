// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/speed_profile.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::planning {
namespace {

constexpr double kLandingShare = 0.8;  // of the jerk: the rest lets the landing law be followed
constexpr double kCoast_mps2 = 0.3;    // rolling resistance: a car always slows by that much
constexpr double kCapAhead_s = 0.45;   // a falling limit is read this far ahead: time for the jerk
constexpr double kCapHorizon_m = 250.0;  // how far ahead the line's limits are looked at
constexpr double kCapDecelShare = 0.9;
constexpr double kSpacingMin_m = 2.0;

const LinePoint& nearest(const Line& line, double s_m) {
  const auto i = static_cast<std::size_t>(line.wrap(s_m) / line.spacing_m);
  return line.points[std::min(i, line.points.size() - 1)];
}

// The speed now from which every limit of the line ahead can be met at a moderate deceleration.
double cap(const Line& line, double s_m, double speed_mps, double decel_mps2) {
  const double from_m = s_m + kCapAhead_s * speed_mps;
  const double horizon_m = std::min(kCapHorizon_m, speed_mps * speed_mps / (2.0 * decel_mps2));
  constexpr double kCapStep_m = 10.0;
  double lowest_mps = nearest(line, s_m).speed_mps;
  for (double d = 0.0; d <= horizon_m; d += kCapStep_m) {
    const double v = nearest(line, from_m + d).speed_mps;
    lowest_mps = std::min(lowest_mps, std::sqrt(v * v + 2.0 * decel_mps2 * d));
  }
  return lowest_mps;
}

SpeedLimits drive_limits(const Line& line, double s_m, double speed_mps, const DriveLimits& l) {
  const double limit_mps = cap(line, s_m, speed_mps, kCapDecelShare * l.decel_max_mps2);
  return {std::min(l.target_mps, limit_mps), l.accel_max_mps2, l.decel_max_mps2, l.jerk_max_mps3};
}

SpeedLimits stop_limits(const Line& line, double s_m, double speed_mps, const StopLimits& l) {
  const LinePoint& p = nearest(line, s_m);
  const double brake =
      brake_available_mps2(l.friction, {speed_mps, p.curvature_per_m, p.bank_rad}, l.grip_share);
  const double coast = kCoast_mps2 + l.friction.drag_per_m * speed_mps * speed_mps;
  const double decel = std::max(std::min(brake + coast, l.decel_max_mps2), kCoast_mps2);
  return {0.0, 0.0, decel, l.jerk_max_mps3};
}

// Plays the reference forward in time and notes it at equal distances.
template <class LimitsAt>
SpeedProfile play(double s_m, SpeedReference now, double spacing_m, LimitsAt limits_at) {
  SpeedProfile out;
  out.spacing_m = spacing_m;
  double gone_m = 0.0;
  std::size_t next = 0;
  for (std::size_t k = 0; k < kProfileSteps && next < out.at.size(); ++k) {
    const SpeedLimits limits = limits_at(s_m + gone_m, now.speed_mps);
    const SpeedReference then = advance(now, limits, kProfileStep_s);
    const double step_m = 0.5 * (now.speed_mps + then.speed_mps) * kProfileStep_s;
    for (; next < out.at.size() && static_cast<double>(next) * spacing_m <= gone_m + step_m;
         ++next) {
      const double t =
          step_m > 0.0 ? (static_cast<double>(next) * spacing_m - gone_m) / step_m : 0.0;
      out.at[next] = {now.speed_mps + t * (then.speed_mps - now.speed_mps), then.accel_mps2};
    }
    gone_m += step_m;
    now = then;
    if (now.speed_mps > 0.0 || limits.target_mps > 0.0) continue;
    out.stop_distance_m = gone_m;
    now = {};
    break;
  }
  for (; next < out.at.size(); ++next) out.at[next] = now;
  return out;
}

}  // namespace

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
  return play(s_m, from, spacing_m,
              [&](double s, double v) { return drive_limits(line, s, v, limits); });
}

SpeedReference advance_stop(const Line& line, double s_m, const SpeedReference& from,
                            const StopLimits& limits, double dt_s) {
  return advance(from, stop_limits(line, s_m, from.speed_mps, limits), dt_s);
}

SpeedProfile stop_profile(const Line& line, double s_m, const SpeedReference& from,
                          const StopLimits& limits, double beyond_m) {
  const auto limits_at = [&](double s, double v) { return stop_limits(line, s, v, limits); };
  constexpr double kFar_m = 1e9;  // the first pass only measures how far it goes
  const SpeedProfile measured = play(s_m, from, kFar_m, limits_at);
  const double least_m = std::isfinite(measured.stop_distance_m) ? measured.stop_distance_m : 0.0;
  constexpr double kSegments = world::kTrajectoryPoints - 1;
  const double spacing_m = std::max((least_m + beyond_m) / kSegments, kSpacingMin_m);
  SpeedProfile profile = play(s_m, from, spacing_m, limits_at);
  // Whatever the horizon of the simulation left over: the last point always stands.
  profile.at.back() = {};
  profile.stop_distance_m = measured.stop_distance_m;
  return profile;
}

}  // namespace pitwall::planning
