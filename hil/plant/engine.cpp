// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/engine.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::plant {
namespace {

struct Between {  // a place in a table: after `first` by `share` of the way to the next
  std::size_t first;
  double share;
};

template <class Table, class Key>
Between place_in(const Table& table, double at, Key key) {
  if (at <= key(table.front())) return {0, 0.0};
  for (std::size_t i = 1; i < table.size(); ++i)
    if (at <= key(table[i]))
      return {i - 1, (at - key(table[i - 1])) / (key(table[i]) - key(table[i - 1]))};
  return {table.size() - 2, 1.0};
}

double mixed(double a, double b, double share) { return a + share * (b - a); }

// Torque over full torque at one throttle of the sheet.
double share_at(const Engine& e, const Between& speed, std::size_t throttle) {
  return mixed(e.part_throttle[speed.first].share[throttle],
               e.part_throttle[speed.first + 1].share[throttle], speed.share);
}

}  // namespace

double full_throttle_nm(const Engine& engine, double rpm) {
  const auto& table = engine.full_throttle;
  const Between at = place_in(table, rpm, [](const EnginePoint& p) { return p.rpm; });
  return mixed(table[at.first].torque_nm, table[at.first + 1].torque_nm, at.share);
}

double friction_nm(const Engine& engine, double rpm) {
  return engine.friction_nm + engine.friction_nm_per_rpm * rpm;
}

double engine_torque_nm(const Engine& engine, double rpm, double throttle_fraction) {
  const double u = std::clamp(throttle_fraction, 0.0, 1.0);
  const double loss_nm = friction_nm(engine, rpm);
  const double cut = std::clamp(
      (engine.limiter_rpm + engine.limiter_width_rpm - rpm) / engine.limiter_width_rpm, 0.0, 1.0);
  if (u <= 0.0 || cut <= 0.0) return -loss_nm;
  const double full_nm = full_throttle_nm(engine, rpm);
  const Between speed =
      place_in(engine.part_throttle, rpm, [](const PartThrottle& p) { return p.rpm; });
  double torque_nm = 0.0;
  if (u <= kDynoThrottles.front()) {
    const double lowest_nm = full_nm * share_at(engine, speed, 0);
    torque_nm = mixed(-loss_nm, lowest_nm, u / kDynoThrottles.front());
  } else {
    const Between at = place_in(kDynoThrottles, u, [](double v) { return v; });
    torque_nm = full_nm * mixed(share_at(engine, speed, at.first),
                                share_at(engine, speed, at.first + 1), at.share);
  }
  return engine.power * cut * (torque_nm + loss_nm) - loss_nm;
}

double fuel_flow_kgps(const Engine& engine, const Fuel& fuel, double rpm, double torque_nm) {
  const double burnt_w = (torque_nm + friction_nm(engine, rpm)) * from_rpm(rpm);
  return std::max(0.0, burnt_w) / (fuel.efficiency * fuel.heating_jpkg);
}

}  // namespace pitwall::plant
