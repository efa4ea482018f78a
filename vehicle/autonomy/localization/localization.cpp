// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/localization.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "protocol/vocabulary/check.hpp"
#include "vehicle/autonomy/localization/sample_gate.hpp"

namespace pitwall::localization {
namespace {

constexpr double kWheelAccelLag_s = 0.15, kWheelAccelMax_mps2 = 30.0;

static_assert(std::is_trivially_copyable_v<State>);

constexpr Duration kFutureMax = milliseconds(5);  // clocks of receivers are estimates
constexpr double kSeedAgeMax_s = 1.5;             // a heading once per second is enough to start
constexpr double kCourseSpeedMin_mps = 5.0;       // from here the course is the heading of the car
constexpr double kCourseSigma_rad = 0.05;
constexpr double kTurnMax_rad_per_s = 0.3;  // fastest turn assumed while a seed heading ages
constexpr double kReacquire_s = 0.1;  // refused positions in a row before reckoning is distrusted
constexpr double kStartSpeedSigma_mps = 1.0, kStartBiasSigma_rad_per_s = 0.005;
constexpr double kSlowSpeed_mps = 5.0, kSlowSlipSigma_mps = 0.1;  // no side slip to speak of

struct Context {
  const Params& params;
  const Datum& datum;
  double bank_rad;
  Instant now;
  Output& out;

  State& state() const { return out.next; }
};

void tell(const Context& c, Source source, std::uint8_t unit, Instant at, Gate gate, double nis) {
  const Verdict verdict{source, unit, gate, nis, (c.now - at).seconds()};
  CHECK(c.out.verdicts.push(verdict));
  if (unit >= world::kGnssUnits) return;
  Tally& tally = c.state().tally[static_cast<std::size_t>(source)][unit];
  ++tally.by_gate[static_cast<std::size_t>(gate)];
  if (gate != Gate::kAccepted) return;
  tally.last_accepted = tally.ever_accepted ? std::max(tally.last_accepted, at) : at;
  tally.ever_accepted = true;
}

// Timing first: it needs no look at the contents.
Gate timing(const Context& c, std::uint8_t unit, Instant at) {
  if (unit >= world::kGnssUnits) return Gate::kUnknownUnit;
  if (at > c.now + kFutureMax) return Gate::kFromTheFuture;
  if (c.now - at > from_seconds(c.params.timeline.window_s)) return Gate::kTooOld;
  return Gate::kAccepted;
}

void fuse(const Context& c, Source source, const Measurement& m) {
  if (!c.state().started) return tell(c, source, m.unit, m.at, Gate::kNotStarted, kUnset);
  const auto innovation = insert(c.state().timeline, c.params.timeline, m);
  if (!innovation) return tell(c, source, m.unit, m.at, Gate::kTooOld, kUnset);
  tell(c, source, m.unit, m.at, innovation->accepted ? Gate::kAccepted : Gate::kOutlier,
       innovation->nis);
}

double combined(double sigma, double floor) { return std::sqrt(sigma * sigma + floor * floor); }

Gate judge(const Context& c, const world::GnssPosition& p) {
  const Gate gate = timing(c, p.unit, p.at);
  return gate == Gate::kAccepted ? contents(c.params, c.datum, p) : gate;
}

Gate judge(const Context& c, const world::GnssVelocity& v) {
  const Gate gate = timing(c, v.unit, v.at);
  return gate == Gate::kAccepted ? contents(v) : gate;
}

Gate judge(const Context& c, const world::GnssHeading& h) {
  const Gate gate = timing(c, h.unit, h.at);
  return gate == Gate::kAccepted ? contents(c.params, h) : gate;
}

Gate judge(const Context& c, const world::ImuSample& s) {
  Gate gate = timing(c, s.unit, s.at);
  if (gate == Gate::kAccepted) gate = contents(s);
  if (gate != Gate::kAccepted || s.unit == 0) return gate;
  const Tally& first = c.state().tally[static_cast<std::size_t>(Source::kImu)][0];
  const bool first_lives =
      first.ever_accepted && s.at - first.last_accepted <= from_seconds(c.params.imu_timeout_s);
  return first_lives ? Gate::kStandby : Gate::kAccepted;
}

Measurement measurement(const Context& c, const world::GnssPosition& p) {
  const auto place = c.datum.to_map(p.latitude_deg, p.longitude_deg, p.height_m);
  CHECK(place.has_value());  // judged before
  const double floor_m = c.params.position_sigma_floor_m;
  return {.kind = Kind::kPosition,
          .unit = p.unit,
          .at = p.at,
          .a = place->x_m,
          .b = place->y_m,
          .sigma_a = combined(p.longitude_sigma_m, floor_m),
          .sigma_b = combined(p.latitude_sigma_m, floor_m),
          .arm = c.params.units[p.unit].antenna};
}

Measurement measurement(const Context& c, const world::GnssVelocity& v) {
  return {.kind = Kind::kVelocity,
          .unit = v.unit,
          .at = v.at,
          .a = v.horizontal_mps * std::sin(v.track_over_ground_rad),
          .b = v.horizontal_mps * std::cos(v.track_over_ground_rad),
          .sigma_a = c.params.velocity_sigma_mps,
          .sigma_b = c.params.velocity_sigma_mps,
          .arm = c.params.units[v.unit].antenna};
}

Measurement measurement(const Context& c, const world::GnssHeading& h) {
  const double baseline_rad = c.params.units[h.unit].baseline_yaw_rad;
  return {.kind = Kind::kHeading,
          .unit = h.unit,
          .at = h.at,
          .a = wrap_pi(0.5 * std::numbers::pi - h.heading_rad - baseline_rad),
          .sigma_a = combined(h.heading_sigma_rad, c.params.heading_sigma_floor_rad)};
}

Measurement measurement(const Context& c, const world::ImuSample& s) {
  return {.kind = Kind::kImu,
          .unit = s.unit,
          .at = s.at,
          .motion = {s.rate_rad_per_s[2], s.specific_force_mps2[0], s.specific_force_mps2[1],
                     c.bank_rad}};
}

template <class Sample>
bool take(const Context& c, Source source, const Sample& sample) {
  const Gate gate = judge(c, sample);
  if (gate == Gate::kAccepted) return fuse(c, source, measurement(c, sample)), true;
  tell(c, source, sample.unit, sample.at, gate, kUnset);
  return false;
}

// Without GNSS velocity the lateral speed comes from the tyres: the rear axle slips in proportion
// to the lateral force. At walking pace it does not slip at all.
void use_slip_model(const Context& c, Instant at) {
  const Belief& belief = c.state().timeline.newest();
  const double vx = belief.mean[kVx];
  const bool slow = std::abs(vx) < kSlowSpeed_mps;
  bool velocity_lives = false;
  for (const Tally& t : c.state().tally[static_cast<std::size_t>(Source::kVelocity)]) {
    velocity_lives |=
        t.ever_accepted && at - t.last_accepted <= from_seconds(c.params.slip_after_s);
  }
  if (velocity_lives && !slow) return;
  const double rate = belief.motion.yaw_rate_rad_per_s - belief.mean[kBias];
  const double slip_rad = c.params.rear_slip_rad_per_mps2 * belief.motion.fy_mps2;
  const Measurement m{
      .kind = Kind::kSlip,
      .at = at,
      .a = slow ? c.params.cg_to_rear_m * rate : c.params.cg_to_rear_m * rate - vx * slip_rad,
      .sigma_a = slow ? kSlowSlipSigma_mps : c.params.slip_sigma_mps};
  (void)insert(c.state().timeline, c.params.timeline, m);  // a model, not a sample: no verdict
}

// Without any IMU the car turns as its steering says, in steady state:
//   delta = L r / v + K (v r - g sin(bank))      Rajamani, Vehicle Dynamics and Control, eq. 3.12
// The held rate of a dead gyro would be believed for ever.
void use_steering_model(const Context& c, const world::VehicleSignals& car, Instant at) {
  const State& s = c.state();
  for (const Tally& imu : s.tally[static_cast<std::size_t>(Source::kImu)])
    if (imu.ever_accepted && at - imu.last_accepted <= from_seconds(c.params.imu_timeout_s)) return;
  if (!car.steering_motor_rad.fresh(at, from_seconds(c.params.imu_timeout_s))) return;
  const Params& p = c.params;
  const double speed = s.wheel_mps, fall = kGravity_mps2 * std::sin(c.bank_rad);
  const double angle_rad = car.steering_motor_rad.value / p.steering_ratio;
  const double rate = speed * (angle_rad + p.understeer_rad_per_mps2 * fall) /
                      (p.wheelbase_m + p.understeer_rad_per_mps2 * speed * speed);
  const double bias = s.timeline.newest().mean[kBias];
  (void)insert(c.state().timeline, p.timeline,
               {.kind = Kind::kImu,
                .at = at,
                .motion = {.yaw_rate_rad_per_s = rate + bias,
                           .fx_mps2 = s.wheel_accel_mps2,
                           .fy_mps2 = speed * rate - fall,
                           .bank_rad = c.bank_rad}});
}

void take_wheels(const Context& c, const world::VehicleSignals& car) {
  const world::Heard<world::PerWheel>& wheels = car.wheel_speed_mps;
  State& state = c.state();
  if (!wheels.heard || (state.have_wheel && wheels.at <= state.last_wheel)) return;
  const double speed =
      0.5 * (wheels.value[world::Corner::kRearLeft] + wheels.value[world::Corner::kRearRight]);
  Gate gate = timing(c, 0, wheels.at);
  if (gate == Gate::kAccepted && !std::isfinite(speed)) gate = Gate::kNotFinite;
  const double since_s = (wheels.at - state.last_wheel).seconds();
  state.last_wheel = wheels.at;
  if (gate != Gate::kAccepted) return tell(c, Source::kWheelSpeed, 0, wheels.at, gate, kUnset);
  if (state.have_wheel && since_s > 0.0) {
    const double accel =
        std::clamp((speed - state.wheel_mps) / since_s, -kWheelAccelMax_mps2, kWheelAccelMax_mps2);
    const double share = std::min(since_s / kWheelAccelLag_s, 1.0);
    state.wheel_accel_mps2 += share * (accel - state.wheel_accel_mps2);
  }
  state.have_wheel = true;
  state.wheel_mps = speed;
  fuse(c, Source::kWheelSpeed,
       {.kind = Kind::kWheelSpeed,
        .at = wheels.at,
        .a = speed,
        .sigma_a = combined(c.params.wheel_sigma_per_speed * speed, c.params.wheel_sigma_mps)});
  if (!state.started) return;
  use_steering_model(c, car, wheels.at);
  use_slip_model(c, wheels.at);
}

struct SeedHeading {
  double yaw_rad, sigma_rad;
};

std::optional<SeedHeading> seed_heading(const Context& c) {
  const State& s = c.state();
  const auto age_s = [&](Instant at) { return std::abs((s.seed_position.at - at).seconds()); };
  if (s.have_heading && age_s(s.seed_heading.at) <= kSeedAgeMax_s) {
    const Measurement m = measurement(c, s.seed_heading);
    const double turned = s.have_velocity && s.seed_velocity.horizontal_mps > 1.0
                              ? kTurnMax_rad_per_s * age_s(s.seed_heading.at)
                              : 0.0;
    return SeedHeading{m.a, combined(m.sigma_a, turned)};
  }
  const bool moving = s.have_velocity && age_s(s.seed_velocity.at) <= c.params.timeline.window_s &&
                      s.seed_velocity.horizontal_mps >= kCourseSpeedMin_mps;
  if (!moving) return std::nullopt;
  const double course_rad = 0.5 * std::numbers::pi - s.seed_velocity.track_over_ground_rad;
  return SeedHeading{wrap_pi(course_rad), kCourseSigma_rad};
}

void try_start(const Context& c) {
  State& s = c.state();
  if (s.started || !s.have_position) return;
  if (timing(c, s.seed_position.unit, s.seed_position.at) != Gate::kAccepted) return;
  const auto heading = seed_heading(c);
  if (!heading) return;
  const Measurement m = measurement(c, s.seed_position);
  const double cy = std::cos(heading->yaw_rad), sy = std::sin(heading->yaw_rad);
  const double left_m = m.arm.y_m * std::cos(c.bank_rad) + m.arm.z_m * std::sin(c.bank_rad);
  const double speed = s.have_velocity ? s.seed_velocity.horizontal_mps : s.wheel_mps;
  Belief belief;
  belief.at = m.at;
  belief.mean = {m.a - cy * m.arm.x_m + sy * left_m,
                 m.b - sy * m.arm.x_m - cy * left_m,
                 heading->yaw_rad,
                 speed,
                 0.0,
                 0.0};
  const std::array<double, kStates> sigma{m.sigma_a + 5.0 * heading->sigma_rad,
                                          m.sigma_b + 5.0 * heading->sigma_rad,
                                          heading->sigma_rad,
                                          kStartSpeedSigma_mps,
                                          kStartSpeedSigma_mps,
                                          kStartBiasSigma_rad_per_s};
  for (std::size_t i = 0; i < kStates; ++i)
    belief.covariance[i * kStates + i] = sigma[i] * sigma[i];
  belief.motion.bank_rad = c.bank_rad;
  start(s.timeline, belief);
  s.started = true;
  s.refusing = false;
  Tally& tally = s.tally[static_cast<std::size_t>(Source::kPosition)][m.unit];
  tally.last_accepted = tally.ever_accepted ? std::max(tally.last_accepted, m.at) : m.at;
  tally.ever_accepted = true;
}

double age_s(const State& state, Source source, Instant now) {
  double youngest = kUnset;
  for (const Tally& t : state.tally[static_cast<std::size_t>(source)]) {
    if (!t.ever_accepted) continue;
    youngest = std::fmin(youngest, std::max((now - t.last_accepted).seconds(), 0.0));
  }
  return youngest;
}

// Positions came back after dead reckoning and do not fit: the reckoning is wrong.
void widen(const Context& c, Instant at) {
  const double sigma_m = c.params.lost_sigma_max_m;
  (void)insert(c.state().timeline, c.params.timeline,
               {.kind = Kind::kWiden, .at = at, .sigma_a = sigma_m, .sigma_b = sigma_m});
}

void refused(const Context& c, Instant at) {
  State& s = c.state();
  if (!s.refusing) s.refusing = true, s.refused_since = at;
  const double for_s = (at - s.refused_since).seconds();
  if (for_s >= c.params.reset_after_s) {  // the filter is wrong, not the receivers
    s.started = false;
    s.refusing = false;
    ++s.restarts;
    return;
  }
  const bool reckoning = age_s(s, Source::kPosition, at) > c.params.good_age_max_s;
  if (reckoning && for_s >= kReacquire_s) widen(c, at);
}

void take_position(const Context& c, const world::GnssPosition& p) {
  State& s = c.state();
  if (!take(c, Source::kPosition, p)) return;
  s.seed_position = p;
  s.have_position = true;
  if (!s.started) return;
  const Gate gate = c.out.verdicts.back().gate;
  if (gate == Gate::kAccepted) s.refusing = false;
  if (gate == Gate::kOutlier) refused(c, p.at);
}

void take_all(const Context& c, const world::SensorInput& in, const world::VehicleSignals& car) {
  State& s = c.state();
  for (const auto& sample : in.imu) (void)take(c, Source::kImu, sample);
  take_wheels(c, car);
  for (const auto& v : in.velocities) {
    if (take(c, Source::kVelocity, v)) s.seed_velocity = v, s.have_velocity = true;
  }
  for (const auto& h : in.headings) {
    if (take(c, Source::kHeading, h)) s.seed_heading = h, s.have_heading = true;
  }
  for (const auto& p : in.positions) take_position(c, p);
  try_start(c);
}

world::Validity validity(const Params& p, const Output& out) {
  if (!out.next.started) {
    return out.next.restarts > 0 ? world::Validity::kLost : world::Validity::kNever;
  }
  const double age = out.position_age_s, sigma = out.ego.position_sigma_m;
  if (!(age <= p.dead_reckoning_max_s && sigma <= p.lost_sigma_max_m &&
        out.imu_age_s <= p.dead_reckoning_max_s)) {
    return world::Validity::kLost;
  }
  const bool good =
      age <= p.good_age_max_s && sigma <= p.good_sigma_max_m && out.imu_age_s <= p.good_age_max_s;
  return good ? world::Validity::kGood : world::Validity::kDeadReckoning;
}

void conclude(const Params& params, Instant now, Output& out) {
  out.ego.at = now;
  out.position_age_s = age_s(out.next, Source::kPosition, now);
  out.imu_age_s = age_s(out.next, Source::kImu, now);
  if (out.next.started) {
    Belief belief = out.next.timeline.newest();
    if (now > belief.at) advance(belief, params.timeline.noise, now);
    const auto& x = belief.mean;
    const auto& p = belief.covariance;
    const double xx = p[0], yy = p[kStates + 1], xy = p[1];
    const double larger = 0.5 * (xx + yy + std::hypot(xx - yy, 2.0 * xy));
    out.ego.x_m = x[kX], out.ego.y_m = x[kY], out.ego.yaw_rad = x[kYaw];
    out.ego.vx_mps = x[kVx], out.ego.vy_mps = x[kVy];
    out.ego.yaw_rate_rad_per_s = belief.motion.yaw_rate_rad_per_s - x[kBias];
    out.ego.ax_mps2 = belief.motion.fx_mps2, out.ego.ay_mps2 = belief.motion.fy_mps2;
    out.ego.position_sigma_m = std::sqrt(std::max(larger, 0.0));
    out.ego.yaw_sigma_rad = std::sqrt(std::max(p[kYaw * kStates + kYaw], 0.0));
    out.gyro_bias_rad_per_s = x[kBias];
  }
  out.ego.validity = validity(params, out);
}

}  // namespace

Output step(const Params& params, const Datum& datum, const State& state,
            const world::SensorInput& sensors, const world::VehicleSignals& signals,
            double bank_rad, Instant now) {
  Output out;
  out.next = state;
  const Context context{params, datum, std::isfinite(bank_rad) ? bank_rad : 0.0, now, out};
  take_all(context, sensors, signals);
  conclude(params, now, out);
  return out;
}

}  // namespace pitwall::localization
