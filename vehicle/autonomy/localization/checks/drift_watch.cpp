// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/checks/drift_watch.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::localization {
namespace {

constexpr double kAwayMax_s = 0.5;  // a unit that was away for longer is learned anew

struct Offset {
  double x_m, y_m;
};

Offset subtract_path(const DriftWatch& watch, double x_m, double y_m, Instant at) {
  const double since_s = (watch.at - at).seconds();
  return {x_m - (watch.gone_x_m - watch.vx_mps * since_s),
          y_m - (watch.gone_y_m - watch.vy_mps * since_s)};
}

}  // namespace

void go(DriftWatch& watch, double vx_mps, double vy_mps, Instant now) {
  if (watch.moving) {
    const double dt_s = (now - watch.at).seconds();
    watch.gone_x_m += 0.5 * dt_s * (watch.vx_mps + vx_mps);
    watch.gone_y_m += 0.5 * dt_s * (watch.vy_mps + vy_mps);
  }
  watch.moving = true;
  watch.at = now;
  watch.vx_mps = vx_mps;
  watch.vy_mps = vy_mps;
}

void forget(DriftWatch& watch) { watch = {}; }

double stray_m(const DriftWatch& watch, std::size_t unit, double x_m, double y_m, Instant at) {
  const DriftWatch::Unit& u = watch.units[unit];
  if (!watch.moving || !u.known) return kUnset;
  const Offset offset = subtract_path(watch, x_m, y_m, at);
  return std::hypot(offset.x_m - u.x_m, offset.y_m - u.y_m);
}

void learn(const CheckParams& params, DriftWatch& watch, std::size_t unit, double x_m, double y_m,
           Instant at) {
  if (!watch.moving) return;
  DriftWatch::Unit& u = watch.units[unit];
  const double dt_s = (at - u.at).seconds();
  if (u.known && dt_s <= 0.0) return;
  const Offset offset = subtract_path(watch, x_m, y_m, at);
  const bool follows = u.known && dt_s <= kAwayMax_s;
  const double share = follows ? std::min(dt_s / params.drift_memory_s, 1.0) : 1.0;
  u.x_m += share * (offset.x_m - u.x_m);
  u.y_m += share * (offset.y_m - u.y_m);
  u.known = true;
  u.at = at;
}

}  // namespace pitwall::localization
