// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/governor.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pitwall::planning {
namespace {

constexpr double kPlannedShare = 0.9;  // of the deceleration: the rest is for what goes wrong
// Where the envelope may shrink: as far as the jerk takes to let go of throttle or brake.
constexpr std::array kShrinks_s{0.0, 0.2, 0.4, 0.6};
constexpr double kReachBeyond_s = 0.3;  // of corners ahead, past the time that the jerk takes
constexpr double kReachMost_s = 3.0;
constexpr double kLandingStep_s = 0.02;  // finer than any step of the reference

LinePoint point_between(const LinePoint& a, const LinePoint& b, double t) {
  LinePoint p;
  p.curvature_per_m = std::lerp(a.curvature_per_m, b.curvature_per_m, t);
  p.bank_rad = std::lerp(a.bank_rad, b.bank_rad, t);
  for (std::size_t row = 0; row < p.speed_mps.size(); ++row)
    p.speed_mps[row] = std::lerp(a.speed_mps[row], b.speed_mps[row], t);
  return p;
}

double air_drag_mps2(const DriveLimits& l, double speed_mps) {
  return l.friction.drag_per_m * speed_mps * speed_mps;
}

double brake_mps2(const AheadPoint& p, double speed_mps, const DriveLimits& l) {
  steering::RoadLoad at = p.road;
  at.speed_mps = speed_mps;
  return brake_available_mps2(l.friction, at, l.grip_share) + air_drag_mps2(l, speed_mps);
}

double drive_mps2(const AheadPoint& p, double speed_mps, const DriveLimits& l) {
  steering::RoadLoad at = p.road;
  at.speed_mps = speed_mps;
  return drive_available_mps2(l.friction, at, l.grip_share);
}

std::size_t index_at(double gone_m) {
  const double index = std::max(gone_m, 0.0) / kAheadStep_m;
  return std::min(static_cast<std::size_t>(index), kAheadPoints - 1);
}

double ahead_m(std::size_t point) { return static_cast<double>(point) * kAheadStep_m; }

// The speed of a point, carried on with its acceleration to another place, also back.
double carried_mps(const AheadPoint& p, double by_m) {
  return std::sqrt(std::max(p.speed_mps * p.speed_mps + 2.0 * p.accel_mps2 * by_m, 0.0));
}

// What the brakes have from a point on, at the speeds of the road, before the jerk could let go.
double least_brake_mps2(const SpeedsAhead& ahead, std::size_t point) {
  const double speed_mps = ahead.at[point].speed_mps;
  double least = HUGE_VAL;
  for (const double in_s : kShrinks_s)
    least = std::min(least, ahead.at[index_at(ahead_m(point) + in_s * speed_mps)].brake_mps2);
  return least;
}

// The corners ahead, each by the braking that ends at it, drawn back to here: the one that leaves
// the least acceleration. Where the speeds rise again nothing is left to mind.
SpeedLimits road_limits(const SpeedsAhead& ahead, double gone_m, const SpeedReference& now,
                        const DriveLimits& l) {
  const std::size_t here = index_at(gone_m);
  SpeedLimits least{.target_mps = carried_mps(ahead.at[here], gone_m - ahead_m(here)),
                    .jerk_max_mps3 = l.corners.jerk_max_mps3,
                    .target_accel_mps2 = ahead.at[here].accel_mps2};
  double least_mps2 = landing_mps2(now.speed_mps, least, kLandingStep_s);
  double lowest_mps2 = least.target_accel_mps2;
  const double letting_go_s =
      (std::max(now.accel_mps2, 0.0) + l.corners.decel_max_mps2) / l.corners.jerk_max_mps3;
  const double reach_s = std::min(letting_go_s, kReachMost_s) + kReachBeyond_s;
  const std::size_t end = index_at(gone_m + reach_s * now.speed_mps + kAheadStep_m);
  for (std::size_t i = here + 1; i <= end; ++i) {
    const AheadPoint& p = ahead.at[i];
    if (p.accel_mps2 >= lowest_mps2) continue;
    lowest_mps2 = p.accel_mps2;
    SpeedLimits corner = least;
    corner.target_mps = carried_mps(p, gone_m - ahead_m(i));
    corner.target_accel_mps2 = p.accel_mps2;
    const double mps2 = landing_mps2(now.speed_mps, corner, kLandingStep_s);
    if (mps2 < least_mps2) least = corner, least_mps2 = mps2;
  }
  return least;
}

}  // namespace

double limit_mps(const LinePoint& p, const DriveLimits& limits) {
  const double by_grip_mps = limit_mps(p, limits.tyres);
  if (!limits.steering) return by_grip_mps;
  return steering::fastest_mps(*limits.steering, p.curvature_per_m, p.bank_rad, by_grip_mps);
}

SpeedsAhead look_ahead(const Line& line, double s_m, const DriveLimits& limits,
                       const OffsetChange& merge) {
  SpeedsAhead out;
  const double begin = line.wrap(s_m) / line.spacing_m, step = kAheadStep_m / line.spacing_m;
  const std::size_t count = line.points.size();
  for (std::size_t i = kAheadPoints; i-- > 0;) {
    const double index = begin + static_cast<double>(i) * step;
    const auto floor = static_cast<std::size_t>(index);
    LinePoint p = point_between(line.points[floor % count], line.points[(floor + 1) % count],
                                index - static_cast<double>(floor));
    const Offset aside = offset_at(line, merge, s_m + ahead_m(i));
    const bool merges = aside.slope != 0.0 || aside.bend_per_m != 0.0;
    if (merges) p.curvature_per_m = curvature_beside(p.curvature_per_m, aside);
    AheadPoint& at = out.at[i];
    at.road = {.speed_mps = kUnset, .curvature_per_m = p.curvature_per_m, .bank_rad = p.bank_rad};
    at.speed_mps = limit_mps(p, limits);
    if (merges)  // the speeds of the line are for its own curvature
      at.speed_mps = carried_mps(limits.friction, at.road, limits.grip_share, at.speed_mps);
    if (i + 1 == kAheadPoints) {
      at.brake_mps2 = brake_mps2(at, at.speed_mps, limits);
      continue;
    }
    const AheadPoint& next = out.at[i + 1];
    const double brake = std::min(limits.corners.decel_max_mps2, least_brake_mps2(out, i + 1));
    const double v2 = next.speed_mps * next.speed_mps;
    at.speed_mps =
        std::min(at.speed_mps, std::sqrt(v2 + 2.0 * kAheadStep_m * kPlannedShare * brake));
    at.accel_mps2 = (v2 - at.speed_mps * at.speed_mps) / (2.0 * kAheadStep_m);
    at.brake_mps2 = brake_mps2(at, at.speed_mps, limits);
  }
  return out;
}

SpeedLimits drive_limits(const SpeedsAhead& ahead, double gone_m, const SpeedReference& now,
                         const DriveLimits& l) {
  double accel = l.pace.accel_max_mps2, brake = l.brake_most_mps2;
  const double coasting = air_drag_mps2(l, now.speed_mps);
  for (const double in_s : kShrinks_s) {
    const AheadPoint& p = ahead.at[index_at(gone_m + in_s * now.speed_mps)];
    const double then_mps = now.speed_mps + in_s * std::max(now.accel_mps2, 0.0);
    accel = std::min(accel, drive_mps2(p, then_mps, l));
    const double slower_mps = in_s > 0.0 ? std::min(now.speed_mps, p.speed_mps) : now.speed_mps;
    brake = std::min(brake, brake_mps2(p, slower_mps, l));
  }
  brake = std::max(brake, coasting);
  accel = std::max(accel, -brake);
  SpeedLimits road = road_limits(ahead, gone_m, now, l);
  road.accel_max_mps2 = accel, road.decel_max_mps2 = brake;
  const SpeedLimits demand{
      .target_mps = l.target_mps,
      .accel_max_mps2 = accel,
      .decel_max_mps2 = std::max(std::min(brake, l.pace.decel_max_mps2), -accel),
      .jerk_max_mps3 = l.pace.jerk_max_mps3};
  const double by_demand_mps2 =
      std::max(landing_mps2(now.speed_mps, demand, kLandingStep_s), -demand.decel_max_mps2);
  return by_demand_mps2 <= landing_mps2(now.speed_mps, road, kLandingStep_s) ? demand : road;
}

}  // namespace pitwall::planning
