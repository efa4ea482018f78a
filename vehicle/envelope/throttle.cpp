// SPDX-License-Identifier: Apache-2.0
#include "vehicle/envelope/throttle.hpp"

#include <algorithm>

namespace pitwall::envelope {
namespace {

struct Opening {
  double throttle, torque_nm;
};
using Curve = std::array<Opening, kPartThrottles + 2>;  // from closed to full

Curve curve_at(const Engine& engine, double rpm) {
  Curve curve{};
  const double full_nm = full_torque_nm(engine, rpm);
  curve.front() = {0.0, -drag_torque_nm(engine, rpm)};
  for (std::size_t i = 0; i < kPartThrottles; ++i)
    curve[i + 1] = {engine.part_throttle[i].throttle,
                    full_nm * at_rpm(engine, engine.part_throttle[i].share, rpm)};
  curve.back() = {1.0, full_nm};
  return curve;
}

// Along the curve, from one of its two figures to the other; beyond its ends those of the end.
double along(const Curve& curve, double Opening::*from, double Opening::*to, double value) {
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const Opening &a = curve[i - 1], &b = curve[i];
    if (value > b.*from) continue;
    const double share = std::max(value - a.*from, 0.0) / (b.*from - a.*from);
    return a.*to + share * (b.*to - a.*to);
  }
  return curve.back().*to;
}

}  // namespace

double drag_torque_nm(const Engine& engine, double rpm) {
  return engine.drag_nm + engine.drag_nm_per_rpm * rpm;
}

double torque_nm(const Engine& engine, double rpm, double throttle) {
  return along(curve_at(engine, rpm), &Opening::throttle, &Opening::torque_nm, throttle);
}

double throttle_for(const Engine& engine, double rpm, double torque_nm) {
  return along(curve_at(engine, rpm), &Opening::torque_nm, &Opening::throttle, torque_nm);
}

}  // namespace pitwall::envelope
