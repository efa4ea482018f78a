// SPDX-License-Identifier: Apache-2.0
#include "vehicle/guardian/reckoning.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pitwall::guardian {
namespace {

using world::SensorInput;

constexpr double kRateMax_rad_per_s = 2.0;  // a car does not turn faster
constexpr double kBiasMax_rad_per_s = 0.1;
constexpr std::uint32_t kBiasSamples = 500;  // the mean forgets beyond 4 s of samples
constexpr double kStepMax_s = 0.1;           // a longer gap is reckoned in steps
constexpr double kFix_s = 0.025;             // between positions of both receivers
constexpr double kYawShareMax_rad_per_m = 0.03;
constexpr double kSlowest_mps = 5.0;  // below, no yaw from positions
constexpr double kLateMax_s = 0.3;    // an older sample is not put back

// The yaw rate to go on with; gyro_used says whether one of the gyroscopes gave it.
double yaw_rate(const ReckoningParams& p, ReckoningState& s, double by_steering, Instant now) {
  const auto rate = [&](std::size_t unit) {
    return s.gyros[unit].rate_rad_per_s - s.gyros[unit].bias_rad_per_s;
  };
  const auto alive = [&](std::size_t unit) {
    return std::isfinite(rate(unit)) && now - s.gyros[unit].at <= p.gyro_age_max;
  };
  s.gyro_used = alive(0) || alive(1);
  if (!s.gyro_used) return std::isfinite(by_steering) ? by_steering : s.pose.yaw_rate_rad_per_s;
  if (!alive(0) || !alive(1)) return alive(0) ? rate(0) : rate(1);
  const bool differ = std::abs(rate(0) - rate(1)) > p.gyro_differ_rad_per_s;
  if (!differ || !std::isfinite(by_steering)) return rate(0);
  return std::abs(rate(0) - by_steering) <= std::abs(rate(1) - by_steering) ? rate(0) : rate(1);
}

double slip_of(const ReckoningParams& p, double speed_mps, double rate, double bank_rad) {
  const double lateral_mps2 = steering::lateral_mps2({speed_mps, rate, bank_rad});
  return p.bicycle.cg_to_rear_m * rate -
         speed_mps * p.bicycle.rear_slip_rad_per_mps2 * lateral_mps2;
}

// Along the held motion, forward or back; exact to second order.
Pose moved(const Pose& from, double dt_s, double bank_rad) {
  const double cb = std::cos(bank_rad), turn_rad = from.yaw_rate_rad_per_s / cb * dt_s;
  const double middle_rad = from.yaw_rad + 0.5 * turn_rad;
  const double c = std::cos(middle_rad), s = std::sin(middle_rad), left_mps = from.slip_mps * cb;
  Pose to = from;
  to.at = from.at + from_seconds(dt_s);
  to.x_m += (from.speed_mps * c - left_mps * s) * dt_s;
  to.y_m += (from.speed_mps * s + left_mps * c) * dt_s;
  to.yaw_rad = wrap_pi(from.yaw_rad + turn_rad);
  return to;
}

void advance(ReckoningState& s, double bank_rad, Instant now) {
  double left_s = (now - s.pose.at).seconds();
  while (left_s > 0.0) {
    const double dt_s = std::min(left_s, kStepMax_s);
    s.pose = moved(s.pose, dt_s, bank_rad);
    left_s -= dt_s;
  }
  if (s.pose.at < now) s.pose.at = now;  // rounding
}

bool fixed(const ReckoningParams& p, const world::GnssPosition& m) {
  return m.unit < world::kGnssUnits && m.solution_status == world::kSolutionComputed &&
         m.position_type != world::kPositionNone && m.latitude_sigma_m <= p.position_sigma_max_m &&
         m.longitude_sigma_m <= p.position_sigma_max_m && std::isfinite(m.height_m);
}

bool in_time(const Pose& pose, Instant at) {
  return std::abs((pose.at - at).seconds()) <= kLateMax_s;
}

void correct(const ReckoningParams& p, ReckoningState& s, const world::GnssPosition& m,
             const Geodetic& datum, double bank_rad) {
  if (!fixed(p, m) || !in_time(s.pose, m.at)) return static_cast<void>(++s.refused);
  const Pose then = moved(s.pose, (m.at - s.pose.at).seconds(), bank_rad);
  const PlanePoint place = to_plane(datum, {m.latitude_deg, m.longitude_deg, m.height_m});
  const ReceiverMounting& arm = p.units[m.unit];
  const double c = std::cos(then.yaw_rad), sn = std::sin(then.yaw_rad);
  const double left_m = arm.y_m * std::cos(bank_rad) + arm.z_m * std::sin(bank_rad);
  const double dx_m = place.x_m - (then.x_m + c * arm.x_m - sn * left_m);
  const double dy_m = place.y_m - (then.y_m + sn * arm.x_m + c * left_m);
  const double since_s = std::max(0.0, (m.at - s.position_at).seconds());
  if (!(std::hypot(dx_m, dy_m) <= p.position_gate_m + p.position_gate_mps * since_s))
    return static_cast<void>(++s.refused);
  ++s.used;
  s.positioned = true;
  s.position_at = std::max(s.position_at, m.at);
  const double alpha = p.position_share;
  s.pose.x_m += alpha * dx_m;
  s.pose.y_m += alpha * dy_m;
  if (s.pose.speed_mps < kSlowest_mps) return;
  const double beta = alpha * alpha / (2.0 - alpha);
  const double share = std::min(beta / (s.pose.speed_mps * kFix_s), kYawShareMax_rad_per_m);
  s.pose.yaw_rad = wrap_pi(s.pose.yaw_rad + share * (c * dy_m - sn * dx_m));
}

void correct(const ReckoningParams& p, ReckoningState& s, const world::GnssHeading& m,
             double bank_rad) {
  const bool solved = m.unit < world::kGnssUnits && m.solution_status == world::kSolutionComputed &&
                      m.position_type == world::kPositionNarrowInt;
  if (!solved || !in_time(s.pose, m.at)) return static_cast<void>(++s.refused);
  const Pose then = moved(s.pose, (m.at - s.pose.at).seconds(), bank_rad);
  const double yaw_rad = 0.5 * std::numbers::pi - m.heading_rad - p.units[m.unit].baseline_yaw_rad;
  const double off_rad = wrap_pi(yaw_rad - then.yaw_rad);
  if (!(std::abs(off_rad) <= p.heading_gate_rad)) return static_cast<void>(++s.refused);
  ++s.used;
  s.pose.yaw_rad = wrap_pi(s.pose.yaw_rad + p.heading_share * off_rad);
}

bool placed(const world::EgoState& ego) {
  return (ego.validity == world::Validity::kGood ||
          ego.validity == world::Validity::kDeadReckoning) &&
         std::isfinite(ego.x_m + ego.y_m + ego.yaw_rad + ego.vx_mps + ego.vy_mps +
                       ego.yaw_rate_rad_per_s);
}

}  // namespace

void store_gyro_rates(ReckoningState& state, const SensorInput& sensors) {
  for (const world::ImuSample& sample : sensors.imu) {
    if (sample.unit >= world::kGnssUnits) continue;
    Gyroscope& gyro = state.gyros[sample.unit];
    const double rate = sample.rate_rad_per_s[2];
    if (!(std::abs(rate) < kRateMax_rad_per_s) || sample.at < gyro.at) continue;
    gyro.rate_rad_per_s = rate;
    gyro.at = sample.at;
  }
}

void follow_car(const ReckoningParams& params, ReckoningState& state, const world::EgoState& ego) {
  state.begun = placed(ego);
  if (!state.begun || ego.at <= state.pose.at) return;
  state.pose = {.at = ego.at,
                .x_m = ego.x_m,
                .y_m = ego.y_m,
                .yaw_rad = ego.yaw_rad,
                .speed_mps = ego.vx_mps,
                .slip_mps = ego.vy_mps,
                .yaw_rate_rad_per_s = ego.yaw_rate_rad_per_s};
  state.position_at = ego.at;
  state.positioned = false;
  for (Gyroscope& gyro : state.gyros) {
    const double off = gyro.rate_rad_per_s - ego.yaw_rate_rad_per_s;
    if (!(std::abs(off) < kBiasMax_rad_per_s) || ego.at - gyro.at > params.gyro_age_max) continue;
    gyro.learned = std::min(gyro.learned + 1, kBiasSamples);
    gyro.bias_rad_per_s += (off - gyro.bias_rad_per_s) / gyro.learned;
  }
}

void reckon(const ReckoningParams& params, ReckoningState& state, const Motion& motion,
            const SensorInput& sensors, const Geodetic& datum, double bank_rad, Instant now) {
  if (std::isfinite(motion.speed_mps)) state.pose.speed_mps = motion.speed_mps;
  Pose& pose = state.pose;
  const double by_steering = steering::yaw_rate_rad_per_s(
      params.bicycle, state.learned, motion.steering_motor_rad / params.steering_ratio,
      pose.speed_mps, bank_rad);
  pose.yaw_rate_rad_per_s = yaw_rate(params, state, by_steering, now);
  pose.slip_mps = slip_of(params, pose.speed_mps, pose.yaw_rate_rad_per_s, bank_rad);
  advance(state, bank_rad, now);
  for (const world::GnssPosition& m : sensors.positions) correct(params, state, m, datum, bank_rad);
  for (const world::GnssHeading& m : sensors.headings) correct(params, state, m, bank_rad);
}

}  // namespace pitwall::guardian
