// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/speed_profile.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::planning {
namespace {

constexpr double kCoast_mps2 = 0.3;  // rolling resistance: a car always slows by that much
// Where a stop looks for the ellipse to shrink: as far as the jerk takes to let go of the brake.
constexpr std::array kStopAhead_s{0.0, 0.2, 0.4, 0.6};
constexpr double kSpacingMin_m = 2.0;
constexpr int kSubsteps = 3;  // the limits change slowly, the landing on the target does not
constexpr double kSubstep_s = kProfileStep_s / kSubsteps;

SpeedLimits stop_limits(const RoadAhead& road, double distance_m, double speed_mps,
                        const StopLimits& l) {
  return {0.0, 0.0, stop_decel_mps2(road, distance_m, speed_mps, l), l.jerk_max_mps3};
}

// The reference played forward in time, as far as `reach_m` or to standstill.
struct History {
  struct Moment {
    double gone_m = 0.0;
    SpeedReference reference;
  };
  std::array<Moment, kProfileSteps + 1> at;
  std::size_t size = 0;
  bool stands = false;
};

template <class LimitsAt>
void play(SpeedReference now, double reach_m, LimitsAt limits_at, History& out) {
  out.at[0] = {0.0, now};
  out.size = 1;
  while (out.size <= kProfileSteps && out.at[out.size - 1].gone_m <= reach_m) {
    const double gone_m = out.at[out.size - 1].gone_m;
    SpeedLimits limits = limits_at(gone_m, now);
    double step_m = 0.0;
    for (int i = 0; i < kSubsteps; ++i) {
      const SpeedReference then = advance(now, limits, kSubstep_s);
      step_m += 0.5 * (now.speed_mps + then.speed_mps) * kSubstep_s;
      limits.target_mps += limits.target_accel_mps2 * kSubstep_s;
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
                 a.reference.accel_mps2 + t * (b.reference.accel_mps2 - a.reference.accel_mps2)};
  }
  if (history.stands) out.stop_distance_m = last.gone_m;
  return out;
}

}  // namespace

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

SpeedReference advance_drive(const SpeedsAhead& ahead, const SpeedReference& from,
                             const DriveLimits& limits, double dt_s) {
  return advance(from, drive_limits(ahead, 0.0, from, limits), dt_s);
}

SpeedProfile drive_profile(const SpeedsAhead& ahead, const SpeedReference& from,
                           const DriveLimits& limits, double spacing_m) {
  History history;
  const double reach_m = spacing_m * static_cast<double>(world::kTrajectoryPoints);
  play(
      from, reach_m,
      [&](double gone_m, const SpeedReference& now) {
        return drive_limits(ahead, gone_m, now, limits);
      },
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
      from, kAnywhere_m,
      [&](double gone_m, const SpeedReference& now) {
        return stop_limits(road, gone_m, now.speed_mps, limits);
      },
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
