// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/sample_gate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pitwall::localization {
namespace {

// Wide of anything on a track.
constexpr double kSpeedMax_mps = 150.0, kAngleMax_rad = 4.0 * std::numbers::pi;
constexpr double kRateMax_rad_per_s = 20.0, kForceMax_mps2 = 500.0;

bool solved(std::uint32_t status, std::uint32_t type) {
  return status == world::kSolutionComputed && type != world::kPositionNone;
}

}  // namespace

Gate contents(const Params& params, const Datum& datum, const world::GnssPosition& p) {
  if (!solved(p.solution_status, p.position_type)) return Gate::kNotSolved;
  if (!std::isfinite(p.latitude_sigma_m + p.longitude_sigma_m) ||
      !datum.to_map(p.latitude_deg, p.longitude_deg, p.height_m))
    return Gate::kNotFinite;
  if (p.latitude_sigma_m < 0.0 || p.longitude_sigma_m < 0.0) return Gate::kImplausible;
  const double worst_m = std::max(p.latitude_sigma_m, p.longitude_sigma_m);
  return worst_m <= params.position_sigma_max_m ? Gate::kAccepted : Gate::kTooUncertain;
}

Gate contents(const world::GnssVelocity& v) {
  if (!solved(v.solution_status, v.velocity_type)) return Gate::kNotSolved;
  if (!std::isfinite(v.horizontal_mps + v.track_over_ground_rad)) return Gate::kNotFinite;
  const bool plausible = v.horizontal_mps >= 0.0 && v.horizontal_mps <= kSpeedMax_mps &&
                         std::abs(v.track_over_ground_rad) <= kAngleMax_rad;
  return plausible ? Gate::kAccepted : Gate::kImplausible;
}

Gate contents(const Params& params, const world::GnssHeading& h) {
  if (!solved(h.solution_status, h.position_type)) return Gate::kNotSolved;
  if (!std::isfinite(h.heading_rad + h.heading_sigma_rad)) return Gate::kNotFinite;
  if (h.heading_sigma_rad < 0.0 || std::abs(h.heading_rad) > kAngleMax_rad)
    return Gate::kImplausible;
  return h.heading_sigma_rad <= params.heading_sigma_max_rad ? Gate::kAccepted
                                                             : Gate::kTooUncertain;
}

Gate contents(const world::ImuSample& s) {
  const double yaw_rate = s.rate_rad_per_s[2];
  const double force =
      std::max(std::abs(s.specific_force_mps2[0]), std::abs(s.specific_force_mps2[1]));
  if (!std::isfinite(yaw_rate + s.specific_force_mps2[0] + s.specific_force_mps2[1]))
    return Gate::kNotFinite;
  const bool plausible = std::abs(yaw_rate) <= kRateMax_rad_per_s && force <= kForceMax_mps2;
  return plausible ? Gate::kAccepted : Gate::kImplausible;
}

}  // namespace pitwall::localization
