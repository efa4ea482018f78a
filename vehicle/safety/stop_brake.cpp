// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/stop_brake.hpp"

#include <algorithm>
#include <cmath>

#include "vehicle/steering/road_load.hpp"

namespace pitwall::safety {
namespace {

constexpr double kRelease = 2.0;  // the brake is let go at twice the ramp

double ramp_of(const SafeStopParams& params, StopKind kind) {
  return kind == StopKind::kEmergency ? params.emergency_ramp_kpa_per_s
                                      : params.brake_ramp_kpa_per_s;
}

double ramped(double last_kpa, double target_kpa, double ramp_kpa_per_s, double dt_s) {
  return std::clamp(target_kpa, last_kpa - kRelease * ramp_kpa_per_s * dt_s,
                    last_kpa + ramp_kpa_per_s * dt_s);
}

double grip_left_mps2(const SafeStopParams& params, StopKind kind, const Grip& grip) {
  const bool emergency = kind == StopKind::kEmergency;
  const double share = emergency ? params.emergency_grip_share : params.grip_share;
  const double usable = share * grip.total_mps2, lateral = grip.lateral_mps2;
  return grip.share * params.brake_share *
         std::sqrt(std::max(0.0, usable * usable - lateral * lateral));
}

}  // namespace

Grip grip_at(const SafeStopParams& params, double speed_mps, double curvature_per_m,
             double bank_rad, double tyre_c) {
  const steering::RoadLoad at{speed_mps, curvature_per_m, bank_rad};
  const double friction = params.friction * world::share_at(params.tyres, tyre_c);
  return {friction * std::max(0.0, normal_load_mps2(at, params.downforce_per_m)),
          lateral_demand_mps2(at), params.coast_mps2 + params.drag_per_m * speed_mps * speed_mps};
}

double brake_for(const SafeStopParams& params, StopKind kind, double decel_mps2, const Grip& grip) {
  const double left_mps2 = grip_left_mps2(params, kind, grip);
  return std::min(std::min(decel_mps2, left_mps2) * params.brake_kpa_per_mps2,
                  params.brake_max_kpa);
}

double brake_towards(const SafeStopParams& params, StopKind kind, const BrakeDemand& demand) {
  const double left_mps2 = grip_left_mps2(params, kind, demand.grip);
  const double free_mps2 = demand.grip.free_mps2;
  const double brake_mps2 = std::max(0.0, std::min(demand.decel_mps2 - free_mps2, left_mps2));
  const double target_kpa = std::min(brake_mps2 * params.brake_kpa_per_mps2, params.brake_max_kpa);
  return ramped(demand.last_kpa, target_kpa, ramp_of(params, kind), demand.dt_s);
}

double next_lock_share(const SafeStopParams& params, double share, const WheelSlip& slip,
                       double dt_s) {
  if (slip.oversteers) return params.lock_share_least;
  const bool locks = slip.front > params.lock_slip;
  const double rate_per_s = locks ? -params.lock_release_per_s : params.lock_recover_per_s;
  return std::clamp(share + rate_per_s * dt_s, params.lock_share_least, 1.0);
}

double hold_towards(const SafeStopParams& params, StopKind kind, double last_kpa, double dt_s) {
  const double ramp_kpa_per_s =
      kind == StopKind::kEmergency ? params.emergency_ramp_kpa_per_s : params.hold_ramp_kpa_per_s;
  return ramped(last_kpa, params.hold_kpa, ramp_kpa_per_s, dt_s);
}

}  // namespace pitwall::safety
