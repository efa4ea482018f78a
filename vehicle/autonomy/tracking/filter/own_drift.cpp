// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/own_drift.hpp"

#include "vehicle/autonomy/tracking/filter/motion.hpp"

namespace pitwall::tracking {
namespace {

// By how much a track moves along and across the road, and turns, for a turn of our car.
struct ByTurn {
  double along_m = 0.0, across_m = 0.0, heading = 1.0;
};

ByTurn by_turn(const OwnMotion& own, const Place& place) {
  const double dx_m = place.x_m - own.x_m, dy_m = place.y_m - own.y_m;
  const auto& jx = place.jacobian[0];
  const auto& jy = place.jacobian[1];
  const double stretch = jx[kAlong] * jx[kAlong] + jy[kAlong] * jy[kAlong];
  return {.along_m = (dx_m * jy[kAlong] - dy_m * jx[kAlong]) / stretch,
          .across_m = dx_m * jy[kAcross] - dy_m * jx[kAcross]};
}

void add(double position, double turn, const ByTurn& by, RoadMatrix& p) {
  const std::array<double, 3> d{by.along_m, by.across_m, by.heading};
  for (std::size_t i = 0; i < d.size(); ++i)
    for (std::size_t j = 0; j < d.size(); ++j) p[i][j] += turn * d[i] * d[j];
  p[kAlong][kAlong] += position;
  p[kAcross][kAcross] += position;
}

}  // namespace

void add_own_drift(const RoadParams& params, const OwnMotion& own, const Place& place, double dt_s,
                   Modes& modes) {
  const double position = dt_s * params.own_drift_m_per_sqrt_s * params.own_drift_m_per_sqrt_s;
  const double turn =
      dt_s * params.own_yaw_drift_rad_per_sqrt_s * params.own_yaw_drift_rad_per_sqrt_s;
  const ByTurn by = by_turn(own, place);
  for (RoadMatrix& p : modes.p) add(position, turn, by, p);
}

}  // namespace pitwall::tracking
