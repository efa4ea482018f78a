// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pitwall::localization {
namespace {

// Wide of anything on a track.
constexpr double kSpeedMax_mps = 150.0, kClimbMax_mps = 50.0;
constexpr double kAngleMax_rad = 4.0 * std::numbers::pi;
constexpr double kRateMax_rad_per_s = 20.0, kForceMax_mps2 = 500.0;

bool computed(std::uint32_t status, std::uint32_t type) {
  return status == world::kSolutionComputed && type != world::kPositionNone;
}

// A sigma that the receiver does not say is no fault; one that it says must be a number.
double least_of(std::initializer_list<double> sigmas) {
  double least = kUnset;
  for (const double sigma : sigmas) least = std::fmin(least, sigma);
  return least;
}

bool known_unit(std::uint8_t unit) { return unit < world::kGnssUnits; }

}  // namespace

double rank_of(std::uint32_t position_type) {
  constexpr double kNone = 0.0, kSingle = 1.0, kFloat = 2.0, kFixed = 3.0;
  switch (position_type) {
    case world::kPositionNone:
      return kNone;
    case 48:  // L1 integer
    case 49:  // wide lane
    case world::kPositionNarrowInt:
    case 51:  // RTK by INS
    case 56:  // INS with RTK fixed
      return kFixed;
    case 17:  // differential
    case 18:  // SBAS
    case 20:
    case 32:
    case 33:
    case world::kPositionNarrowFloat:
    case 52:  // INS with SBAS
    case 54:  // INS with differential
    case 55:  // INS with RTK float
    case 68:  // PPP, converging
    case 69:
    case 73:
    case 74:
    case 77:
    case 78:
    case 79:
    case 80:
      return kFloat;
    default:
      return kSingle;
  }
}

Evidence evidence_of(const Params& params, const Datum& datum, const world::GnssPosition& p) {
  Evidence e;
  e.source = Source::kPosition;
  e.known_unit = known_unit(p.unit);
  e.solved = computed(p.solution_status, p.position_type);
  e.finite = std::isfinite(p.latitude_deg + p.longitude_deg + p.height_m) &&
             std::isfinite(p.latitude_sigma_m + p.longitude_sigma_m + p.height_sigma_m);
  e.plausible = datum.to_map(p.latitude_deg, p.longitude_deg, p.height_m).has_value();
  e.least_sigma = least_of({p.latitude_sigma_m, p.longitude_sigma_m, p.height_sigma_m});
  e.rank = rank_of(p.position_type);
  e.sigma = std::max(p.latitude_sigma_m, p.longitude_sigma_m);
  e.sigma_max = params.position_sigma_max_m;
  e.height_sigma_m = p.height_sigma_m;
  e.differential_age_s = p.differential_age_s;
  e.solution_age_s = p.solution_age_s;
  e.jump_min = params.checks.jump_position_m;
  return e;
}

Evidence evidence_of(const Params& params, const Datum&, const world::GnssVelocity& v) {
  Evidence e;
  e.source = Source::kVelocity;
  e.known_unit = known_unit(v.unit);
  e.solved = computed(v.solution_status, v.velocity_type);
  e.finite = std::isfinite(v.horizontal_mps + v.track_over_ground_rad + v.vertical_mps) &&
             !std::isinf(v.sigma_mps);
  e.plausible = v.horizontal_mps >= 0.0 && v.horizontal_mps <= kSpeedMax_mps &&
                std::abs(v.vertical_mps) <= kClimbMax_mps &&
                std::abs(v.track_over_ground_rad) <= kAngleMax_rad;
  e.least_sigma = v.sigma_mps;
  e.sigma = v.sigma_mps;
  e.sigma_max = params.checks.velocity_sigma_max_mps;
  e.jump_min = params.checks.jump_velocity_mps;
  return e;
}

Evidence evidence_of(const Params& params, const Datum&, const world::GnssHeading& h) {
  Evidence e;
  e.source = Source::kHeading;
  e.known_unit = known_unit(h.unit);
  e.solved = computed(h.solution_status, h.position_type);
  e.finite = std::isfinite(h.heading_rad + h.heading_sigma_rad) && !std::isinf(h.baseline_m);
  e.plausible = std::abs(h.heading_rad) <= kAngleMax_rad;
  e.least_sigma = h.heading_sigma_rad;
  e.sigma = h.heading_sigma_rad;
  e.sigma_max = params.heading_sigma_max_rad;
  if (e.known_unit) e.baseline_error_m = h.baseline_m - params.units[h.unit].baseline_m;
  e.jump_min = params.checks.jump_heading_rad;
  return e;
}

Evidence evidence_of(const Params& params, const Datum&, const world::InsAttitude& a) {
  Evidence e;
  e.source = Source::kAttitude;
  e.known_unit = known_unit(a.unit);
  e.solved = a.status == world::InsStatus::kGood;
  e.finite = std::isfinite(a.roll_rad + a.pitch_rad + a.heading_rad) &&
             std::isfinite(a.roll_sigma_rad + a.pitch_sigma_rad + a.heading_sigma_rad);
  e.plausible = std::abs(a.roll_rad) <= kAngleMax_rad && std::abs(a.pitch_rad) <= kAngleMax_rad &&
                std::abs(a.heading_rad) <= kAngleMax_rad;
  e.least_sigma = least_of({a.roll_sigma_rad, a.pitch_sigma_rad, a.heading_sigma_rad});
  e.sigma = std::max({a.roll_sigma_rad, a.pitch_sigma_rad, a.heading_sigma_rad});
  e.sigma_max = params.checks.attitude_sigma_max_rad;
  e.jump_min = params.checks.jump_heading_rad;
  return e;
}

Evidence evidence_of(const Params&, const Datum&, const world::ImuSample& s) {
  Evidence e;
  e.source = Source::kImu;
  e.known_unit = known_unit(s.unit);
  for (std::size_t axis = 0; axis < s.rate_rad_per_s.size(); ++axis) {
    const double rate = s.rate_rad_per_s[axis], force = s.specific_force_mps2[axis];
    e.finite = e.finite && std::isfinite(rate) && std::isfinite(force);
    e.plausible =
        e.plausible && std::abs(rate) <= kRateMax_rad_per_s && std::abs(force) <= kForceMax_mps2;
  }
  return e;
}

Content content_of(const world::GnssPosition& p) {
  return {p.latitude_deg, p.longitude_deg, p.height_m};
}
Content content_of(const world::GnssVelocity& v) {
  return {v.horizontal_mps, v.track_over_ground_rad, v.vertical_mps};
}
Content content_of(const world::GnssHeading& h) {
  return {h.heading_rad, h.heading_sigma_rad, h.baseline_m};
}
Content content_of(const world::InsAttitude& a) { return {a.roll_rad, a.pitch_rad, a.heading_rad}; }
Content content_of(const world::ImuSample& s) {
  return {s.rate_rad_per_s[2], s.specific_force_mps2[0], s.specific_force_mps2[1]};
}

}  // namespace pitwall::localization
