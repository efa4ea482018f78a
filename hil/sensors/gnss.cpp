// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/gnss.hpp"

#include <algorithm>
#include <cmath>

#include "hil/sensors/geometry.hpp"

namespace pitwall::sensors {
namespace {

constexpr std::uint32_t kInsufficientObservations = 1;
constexpr std::uint8_t kSatellites = 18;
constexpr double kClaimSpread = 0.1, kClaimCorrelation_s = 60.0;

std::uint32_t type_of(Fix fix) {
  switch (fix) {
    case Fix::kRtkFixed:
      return world::kPositionNarrowInt;
    case Fix::kRtkFloat:
      return world::kPositionNarrowFloat;
    case Fix::kSingle:
      return world::kPositionSingle;
    case Fix::kNone:
      break;
  }
  return world::kPositionNone;
}

std::uint32_t status_of(Fix fix) {
  return fix == Fix::kNone ? kInsufficientObservations : world::kSolutionComputed;
}

double sigma_of(const PositionNoise& p, const SolutionFault& f) {
  switch (f.fix) {
    case Fix::kRtkFloat:
      return f.float_sigma_m > 0.0 ? f.float_sigma_m : p.float_sigma_m;
    case Fix::kSingle:
      return p.single_sigma_m;
    default:
      return p.sigma_m;
  }
}

// As the receiver reports it: in single precision, and it does not know it better than so.
double claimed(double sigma, const GnssState& state) {
  const double off = kClaimSpread * std::clamp(state.claim.value[0], -2.0, 2.0);
  return static_cast<double>(static_cast<float>(sigma * (1.0 + off)));
}

// In units of the deviation, east, north and up.
Vector3 position_error(const PositionNoise& p, const Sky& sky, GnssState& state) {
  const double wander = std::sqrt(1.0 - p.white_share);
  const double common = wander * std::sqrt(p.common_share);
  const double own = wander * std::sqrt(1.0 - p.common_share);
  Vector3 error{};
  for (std::size_t i = 0; i < error.size(); ++i)
    error[i] = common * sky.wander.value[i] + own * state.position.value[i] +
               std::sqrt(p.white_share) * state.of(UnitStream::kPosition).normal();
  error[2] *= p.height_factor;
  return error;
}

Vector3 silent_offset(const SolutionFault& f, const plant::Truth& t) {
  const double cos_yaw = std::cos(t.yaw_rad), sin_yaw = std::sin(t.yaw_rad);
  return {f.east_m + f.ahead_m * cos_yaw - f.left_m * sin_yaw,
          f.north_m + f.ahead_m * sin_yaw + f.left_m * cos_yaw, f.up_m};
}

double differential_age_s(const PositionNoise& p, const SolutionFault& f, const Sky& sky) {
  if (f.fix == Fix::kSingle) return 0.0;
  return p.corrections_age_s + sky.seconds - std::floor(sky.seconds) + f.added_age_s;
}

}  // namespace

GnssState make_gnss(std::uint64_t seed, std::size_t unit) {
  GnssState state;
  for (std::uint64_t i = 0; i < kUnitStreams; ++i)
    state.noise[i] = Noise(seed, stream_of(unit, static_cast<UnitStream>(i)));
  state.position.begin(state.of(UnitStream::kPosition));
  state.heading.begin(state.of(UnitStream::kHeading));
  state.claim.begin(state.of(UnitStream::kClaim));
  state.attitude.begin(state.of(UnitStream::kInertialSolution));
  return state;
}

world::GnssPosition measure_position(const UnitParams& params, const SolutionFault& fault,
                                     const GeographicLib::LocalCartesian& datum,
                                     const plant::Truth& truth, const Sky& sky, double period_s,
                                     GnssState& state) {
  const PositionNoise& p = params.noise.position;
  state.position.advance(state.of(UnitStream::kPosition), period_s, p.correlation_s);
  state.claim.advance(state.of(UnitStream::kClaim), period_s, kClaimCorrelation_s);
  const Vector3 error = position_error(p, sky, state);
  world::GnssPosition s;
  s.solution_status = status_of(fault.fix);
  s.position_type = type_of(fault.fix);
  if (fault.fix == Fix::kNone) {
    s.latitude_deg = s.longitude_deg = s.height_m = 0.0;
    s.latitude_sigma_m = s.longitude_sigma_m = s.height_sigma_m = 0.0;
    return s;
  }
  const double sigma_m = fault.sigma_scale * std::hypot(sigma_of(p, fault), fault.added_sigma_m);
  const Vector3 place =
      plus(plus({truth.x_m, truth.y_m, truth.z_m}, in_map(vector(params.antenna), truth)),
           plus(times(fault.noise_scale * sigma_m, error), silent_offset(fault, truth)));
  datum.Reverse(place[0], place[1], place[2], s.latitude_deg, s.longitude_deg, s.height_m);
  s.latitude_sigma_m = s.longitude_sigma_m = claimed(sigma_m, state);
  s.height_sigma_m = claimed(p.height_factor * sigma_m, state);
  s.satellites = kSatellites;
  s.differential_age_s = differential_age_s(p, fault, sky);
  s.solution_age_s = 0.0;
  return s;
}

world::GnssVelocity measure_velocity(const UnitParams& params, const SolutionFault& fault,
                                     const plant::Truth& truth, GnssState& state) {
  Noise& noise = state.of(UnitStream::kVelocity);
  const Vector3 error{noise.normal(), noise.normal(), noise.normal()};
  world::GnssVelocity s;
  s.solution_status = status_of(fault.fix);
  s.velocity_type = type_of(fault.fix);
  if (fault.fix == Fix::kNone) {
    s.horizontal_mps = s.track_over_ground_rad = s.vertical_mps = 0.0;
    return s;
  }
  // The antenna moves with the car and round it.
  const VelocityNoise& n = params.noise.velocity;
  const double worse = fault.sigma_scale * fault.noise_scale;
  const Vector3 round = in_map(cross(truth.rate_rad_per_s, vector(params.antenna)), truth);
  const Vector3 wrong = in_map({fault.ahead_mps, fault.left_mps, 0.0}, truth);
  const double east_mps = truth.map_vx_mps + round[0] + wrong[0] + worse * n.sigma_mps * error[0];
  const double north_mps = truth.map_vy_mps + round[1] + wrong[1] + worse * n.sigma_mps * error[1];
  s.horizontal_mps = std::hypot(east_mps, north_mps);
  s.track_over_ground_rad = compass_rad(east_mps, north_mps);
  s.vertical_mps = truth.map_vz_mps + round[2] + wrong[2] + worse * n.vertical_sigma_mps * error[2];
  return s;
}

world::GnssHeading measure_heading(const UnitParams& params, const SolutionFault& fault,
                                   const plant::Truth& truth, double period_s, GnssState& state) {
  const HeadingNoise& n = params.noise.heading;
  Noise& noise = state.of(UnitStream::kHeading);
  state.heading.advance(noise, period_s, n.correlation_s);
  const double error = std::sqrt(n.wander_share) * state.heading.value[0] +
                       std::sqrt(1.0 - n.wander_share) * noise.normal();
  const double longer_m = n.baseline_sigma_m * noise.normal();
  world::GnssHeading s;
  s.solution_status = status_of(fault.fix);
  // Between its own antennas the receiver needs no corrections.
  s.position_type = fault.fix == Fix::kNone ? world::kPositionNone : world::kPositionNarrowInt;
  if (fault.fix == Fix::kNone) {
    s.heading_rad = s.heading_sigma_rad = s.baseline_m = 0.0;
    return s;
  }
  const Vector3 baseline =
      in_map({std::cos(params.baseline_yaw_rad), std::sin(params.baseline_yaw_rad), 0.0}, truth);
  const double sigma_rad = fault.sigma_scale * n.sigma_rad_m / params.baseline_m;
  const double heading_rad = compass_rad(baseline[0], baseline[1]) +
                             fault.noise_scale * sigma_rad * error + fault.heading_rad;
  s.heading_rad = compass_rad(std::sin(heading_rad), std::cos(heading_rad));
  s.heading_sigma_rad = claimed(sigma_rad, state);
  s.baseline_m = params.baseline_m + longer_m;
  return s;
}

world::InsAttitude measure_attitude(const UnitParams& params, const SolutionFault& fault,
                                    const plant::Truth& truth, double period_s, GnssState& state) {
  const InsNoise& n = params.noise.ins;
  state.attitude.advance(state.of(UnitStream::kInertialSolution), period_s, n.correlation_s);
  state.aligned = state.aligned || truth.speed_mps > n.aligned_above_mps;
  world::InsAttitude s;
  s.status = !state.aligned            ? world::InsStatus::kAligning
             : fault.fix == Fix::kNone ? world::InsStatus::kFree
                                       : world::InsStatus::kGood;
  s.roll_rad = truth.roll_rad + n.tilt_sigma_rad * state.attitude.value[0];
  s.pitch_rad = truth.pitch_rad + n.tilt_sigma_rad * state.attitude.value[1];
  const double heading_rad =
      std::numbers::pi / 2.0 - truth.yaw_rad + n.heading_sigma_rad * state.attitude.value[2];
  s.heading_rad = compass_rad(std::sin(heading_rad), std::cos(heading_rad));
  s.roll_sigma_rad = s.pitch_sigma_rad = claimed(n.tilt_sigma_rad, state);
  s.heading_sigma_rad = claimed(n.heading_sigma_rad, state);
  return s;
}

}  // namespace pitwall::sensors
