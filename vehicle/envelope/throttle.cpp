// SPDX-License-Identifier: Apache-2.0
#include "vehicle/envelope/throttle.hpp"

#include <algorithm>

namespace pitwall::envelope {
namespace {

struct Opening {
  double throttle, torque_nm;
};
using Curve = std::array<Opening, kPartThrottles + 2>;  // from closed to full

double share_at(const Engine& engine, const PartThrottle& part, double rpm) {
  if (rpm <= engine.rpm.front()) return part.share.front();
  for (std::size_t i = 1; i < kTorqueRows; ++i) {
    if (rpm > engine.rpm[i]) continue;
    const double t = (rpm - engine.rpm[i - 1]) / (engine.rpm[i] - engine.rpm[i - 1]);
    return part.share[i - 1] + t * (part.share[i] - part.share[i - 1]);
  }
  return part.share.back();
}

Curve curve_at(const Engine& engine, double rpm) {
  Curve curve{};
  const double full_nm = full_torque_nm(engine, rpm);
  curve.front() = {0.0, -drag_torque_nm(engine, rpm)};
  for (std::size_t i = 0; i < kPartThrottles; ++i)
    curve[i + 1] = {engine.part_throttle[i].throttle,
                    full_nm * share_at(engine, engine.part_throttle[i], rpm)};
  curve.back() = {1.0, full_nm};
  return curve;
}

double between(double from, double to, double share) { return from + share * (to - from); }

}  // namespace

double drag_torque_nm(const Engine& engine, double rpm) {
  return engine.drag_nm + engine.drag_nm_per_rpm * rpm;
}

double torque_nm(const Engine& engine, double rpm, double throttle) {
  const Curve curve = curve_at(engine, rpm);
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const Opening &a = curve[i - 1], &b = curve[i];
    if (throttle > b.throttle) continue;
    const double share = std::max(throttle - a.throttle, 0.0) / (b.throttle - a.throttle);
    return between(a.torque_nm, b.torque_nm, share);
  }
  return curve.back().torque_nm;
}

double throttle_for(const Engine& engine, double rpm, double torque_nm) {
  const Curve curve = curve_at(engine, rpm);
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const Opening &a = curve[i - 1], &b = curve[i];
    if (torque_nm > b.torque_nm) continue;
    const double share = std::max(torque_nm - a.torque_nm, 0.0) / (b.torque_nm - a.torque_nm);
    return between(a.throttle, b.throttle, share);
  }
  return 1.0;
}

}  // namespace pitwall::envelope
