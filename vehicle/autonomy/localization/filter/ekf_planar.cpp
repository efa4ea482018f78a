// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/filter/ekf_planar.hpp"

#include <cmath>
#include <optional>

namespace pitwall::localization {
namespace {

constexpr double kNoSlipSpeed_mps = 5.0, kNoSlipSigma_mps = 0.1;  // no side slip to speak of

double at_least(double sigma, double floor) {
  return std::isfinite(sigma) ? std::hypot(sigma, floor) : floor;
}

std::optional<Measurement> by_tyres(const PlanarBelief& b, const PlanarParams& p, Measurement m) {
  const double vx = b.belief.mean[kVx];
  const bool slow = std::abs(vx) < kNoSlipSpeed_mps;
  const bool velocity_lives =
      b.velocity_received && m.at - b.velocity_at <= from_seconds(p.slip_after_s);
  if (velocity_lives && !slow) return std::nullopt;
  const double rate = b.belief.motion.yaw_rate_rad_per_s - b.belief.mean[kBias];
  const double slip_rad = slow ? 0.0 : p.rear_slip_rad_per_mps2 * b.belief.motion.fy_mps2;
  m.a = p.cg_to_rear_m * rate - vx * slip_rad;
  m.sigma_a = slow ? kNoSlipSigma_mps : p.slip_sigma_mps;
  return m;
}

// The measurement with the sigmas that this filter gives it.
Measurement weighed(const PlanarParams& p, Measurement m) {
  if (m.kind == Kind::kPosition) {
    m.sigma_a = at_least(m.sigma_a, p.position_sigma_floor_m);
    m.sigma_b = at_least(m.sigma_b, p.position_sigma_floor_m);
  } else if (m.kind == Kind::kVelocity) {
    m.sigma_a = m.sigma_b = p.velocity_sigma_mps;
  } else if (m.kind == Kind::kHeading) {
    m.sigma_a = at_least(m.sigma_a, p.heading_sigma_floor_rad);
  } else if (m.kind == Kind::kWheelSpeed) {
    m.sigma_a = at_least(p.wheel_sigma_per_speed * m.a, p.wheel_sigma_mps);
  }
  return m;
}

}  // namespace

Innovation PlanarModel::fold(PlanarBelief& b, const PlanarParams& p, const Measurement& m,
                             const Measurement*) {
  advance(b.belief, p.noise, m.at);
  Motion& motion = b.belief.motion;
  if (m.kind == Kind::kImu) {
    motion.yaw_rate_rad_per_s = m.imu.rate_rad_per_s[2];
    motion.fx_mps2 = m.imu.force_mps2[0], motion.fy_mps2 = m.imu.force_mps2[1];
    return {.accepted = true, .nis = 0.0, .size = 0};
  }
  if (m.kind == Kind::kRoad) {
    motion.bank_rad = m.road.bank_rad;
    return {.accepted = true, .nis = 0.0, .size = 0};
  }
  if (m.kind == Kind::kSlip) {
    const auto model = by_tyres(b, p, m);
    return model ? update(b.belief, *model, p.gate_nis) : Innovation{};
  }
  const Innovation innovation = update(b.belief, weighed(p, m), p.gate_nis);
  if (m.kind == Kind::kVelocity && innovation.accepted)
    b.velocity_at = m.at, b.velocity_received = true;
  return innovation;
}

}  // namespace pitwall::localization
