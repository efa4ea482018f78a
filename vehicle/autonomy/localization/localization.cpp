// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/localization.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "vehicle/autonomy/localization/intake.hpp"

namespace pitwall::localization {
namespace {

using world::Excludable;
using world::Monitor;

constexpr double kSeedAgeMax_s = 1.5;        // a heading once per second is enough to start
constexpr double kCourseSpeedMin_mps = 5.0;  // from here the course is the heading of the car
constexpr double kCourseSigma_rad = 0.05;
constexpr double kTurnMax_rad_per_s = 0.3;  // fastest turn assumed while a seed heading ages
constexpr Duration kPauseMin = milliseconds(25);
constexpr double kOpenGate = 1e30;
double combined(double a, double b) { return std::sqrt(a * a + b * b); }

// The gates of the filter itself belong to kInnovation as well.
FilterParams without_gates(FilterParams params) {
  params.planar.gate_nis.fill(kOpenGate);
  params.spatial.gate_nis.fill(kOpenGate);
  return params;
}

struct SeedHeading {
  double yaw_rad, sigma_rad;
};

std::optional<SeedHeading> seed_heading(const Intake& in) {
  const State& s = in.state;
  const auto age_s = [&](Instant at) { return std::abs((s.seed_position.at - at).seconds()); };
  if (s.have_heading && age_s(s.seed_heading.at) <= kSeedAgeMax_s) {
    const Measurement m = measurement(in, s.seed_heading);
    const double turned = s.have_velocity && s.seed_velocity.horizontal_mps > 1.0
                              ? kTurnMax_rad_per_s * age_s(s.seed_heading.at)
                              : 0.0;
    return SeedHeading{m.a, combined(m.sigma_a, turned)};
  }
  const bool moving = s.have_velocity && age_s(s.seed_velocity.at) <= in.params.filter.window_s &&
                      s.seed_velocity.horizontal_mps >= kCourseSpeedMin_mps;
  if (!moving) return std::nullopt;
  const double course_rad = 0.5 * std::numbers::pi - s.seed_velocity.track_over_ground_rad;
  return SeedHeading{wrap_pi(course_rad), kCourseSigma_rad};
}

void try_start(const Intake& in) {
  State& s = in.state;
  if (s.started || !s.have_position) return;
  if ((in.now - s.seed_position.at).seconds() > in.params.filter.window_s) return;
  const auto heading = seed_heading(in);
  if (!heading) return;
  const Measurement m = measurement(in, s.seed_position);
  const double by_wheels = std::isfinite(s.wheels.speed_mps) ? s.wheels.speed_mps : 0.0;
  start(s.filter, in.filter,
        {.at = m.at,
         .antenna_m = {m.a, m.b, m.c},
         .antenna_sigma_m = std::max(m.sigma_a, m.sigma_b),
         .arm = m.arm,
         .yaw_rad = heading->yaw_rad,
         .yaw_sigma_rad = heading->sigma_rad,
         .speed_mps = s.have_velocity ? s.seed_velocity.horizontal_mps : by_wheels,
         .road = in.around.road});
  s.started = true;
  s.refusing = false;
  Tally& tally = s.tally[static_cast<std::size_t>(Source::kPosition)][m.unit];
  tally.last_accepted = tally.ever_accepted ? std::max(tally.last_accepted, m.at) : m.at;
  tally.ever_accepted = true;
}

// Once per estimate: the same road twice would count twice.
void take_road(const Intake& in) {
  State& s = in.state;
  const Surroundings& around = in.around;
  if (!s.started || !std::isfinite(around.road.bank_rad) || around.at <= s.road_at) return;
  s.road_at = around.at;
  (void)insert(s.filter, in.filter, {.kind = Kind::kRoad, .at = around.at, .road = around.road});
}

void watch_inertial(const Intake& in) {
  if (in.params.off.has(Monitor::kUnitAgreement)) {
    in.state.imu.faulty.reset();
    return;
  }
  const WheelState& wheels = in.state.wheels;
  const Moment* moment = in.state.trail.newest();
  const bool fresh =
      wheels.received && (in.now - wheels.at).seconds() <= in.params.checks.wheel_gap_max_s;
  ImuReference reference;
  reference.bank_rad = in.bank_rad();
  if (moment) reference.speed_mps = moment->speed_mps;
  if (fresh && std::isfinite(wheels.speed_mps)) reference.accel_mps2 = wheels.accel_mps2;
  constexpr double kStands_mps = 0.2;
  reference.stands =
      fresh && moment && moment->speed_mps < 1.0 && std::abs(wheels.speed_mps) < kStands_mps;
  watch_imu(in.params.checks, in.state.imu, reference, in.now);
}

void take_all(const Intake& in, const world::SensorInput& sensors,
              const world::VehicleSignals& car) {
  for (const world::ReceiverHealth& health : sensors.receivers)
    if (health.unit < world::kGnssUnits) in.state.receivers[health.unit] = health;
  take_road(in);
  for (const auto& sample : sensors.imu) take(in, sample);
  take_wheels(in, car);
  for (const auto& v : sensors.velocities) take(in, v);
  for (const auto& h : sensors.headings) take(in, h);
  for (const auto& a : sensors.attitudes) take(in, a);
  for (const auto& p : sensors.positions) take(in, p);
  try_start(in);
  watch_inertial(in);
}

Excludable excludable(Source source, std::size_t unit) {
  if (source == Source::kImu) return unit == 0 ? Excludable::kImu0 : Excludable::kImu1;
  return unit == 0 ? Excludable::kGnss0 : Excludable::kGnss1;
}

// Streams that fell silent. A car that was paused itself receives them in the next tick.
void watch_streams(const Intake& in) {
  if (in.now - in.state.stepped_at > kPauseMin) return;
  const CheckParams& checks = in.params.checks;
  constexpr std::array kWatched{Source::kPosition, Source::kVelocity, Source::kHeading,
                                Source::kImu};
  const auto late = [&](Instant at, Source source) {
    return (in.now - at).seconds() > gap_max_s(checks, source);
  };
  for (const Source source : kWatched) {
    for (std::uint8_t unit = 0; unit < world::kGnssUnits; ++unit) {
      Stream& stream = in.stream(source, unit);
      if (!stream.trust.received || !in.use.uses(excludable(source, unit))) continue;
      if (!late(stream.trust.received_at, source)) continue;
      stream.verdict = Gate::kSilent;
      stream.comparable = false;
      stream.seen = {};
      stream.seen.add(Monitor::kStreamAge);
    }
  }
  WheelState& wheels = in.state.wheels;
  if (!wheels.received || !late(wheels.at, Source::kWheelSpeed)) return;
  wheels.verdict = Gate::kSilent;
  wheels.seen.add(Monitor::kStreamAge);
}

// What the newest sample of each stream showed holds until the next one.
void collect_findings(const Intake& in) {
  world::MonitorSet& seen = in.out.seen;
  for (std::size_t source = 0; source < kSources; ++source)
    for (std::uint8_t unit = 0; unit < world::kGnssUnits; ++unit)
      if (in.use.uses(excludable(static_cast<Source>(source), unit)))
        seen.add(in.state.streams[source][unit].seen);
  seen.add(in.state.wheels.seen);
  const ImuWatch& imu = in.state.imu;
  const bool apart =
      imu.apart && in.now - imu.apart_since >= from_seconds(in.params.checks.imu_contradict_s);
  const bool both = in.use.uses(Excludable::kImu0) && in.use.uses(Excludable::kImu1);
  if (both && (apart || imu.faulty)) seen.add(Monitor::kUnitAgreement);
  seen.bits &= ~in.params.off.bits;
}

double youngest_s(const State& state, Source source, Instant now) {
  double youngest = kUnset;
  for (const Tally& t : state.tally[static_cast<std::size_t>(source)]) {
    if (!t.ever_accepted) continue;
    youngest = std::fmin(youngest, std::max((now - t.last_accepted).seconds(), 0.0));
  }
  return youngest;
}

world::Validity validity(const Params& p, const State& state, const Output& out) {
  if (!state.started) return state.restarts > 0 ? world::Validity::kLost : world::Validity::kNever;
  const double age = out.position_age_s, sigma = out.ego.position_sigma_m;
  if (!(age <= p.dead_reckoning_max_s && sigma <= p.lost_sigma_max_m &&
        out.imu_age_s <= p.dead_reckoning_max_s)) {
    return world::Validity::kLost;
  }
  const bool good =
      age <= p.good_age_max_s && sigma <= p.good_sigma_max_m && out.imu_age_s <= p.good_age_max_s;
  return good ? world::Validity::kGood : world::Validity::kDeadReckoning;
}

void say(const Estimate& estimate, world::EgoState& ego) {
  ego.x_m = estimate.position_m[0];
  ego.y_m = estimate.position_m[1];
  ego.z_m = estimate.position_m[2];
  ego.yaw_rad = estimate.yaw_rad;
  ego.pitch_rad = estimate.pitch_rad;
  ego.roll_rad = estimate.roll_rad;
  ego.vx_mps = estimate.velocity_mps[0];
  ego.vy_mps = estimate.velocity_mps[1];
  ego.yaw_rate_rad_per_s = estimate.rate_rad_per_s[2];
  ego.ax_mps2 = estimate.force_mps2[0];
  ego.ay_mps2 = estimate.force_mps2[1];
  ego.position_sigma_m = estimate.position_sigma_m;
  ego.yaw_sigma_rad = estimate.yaw_sigma_rad;
}

void conclude(const Intake& in) {
  State& s = in.state;
  Output& out = in.out;
  out.ego.at = in.now;
  out.position_age_s = youngest_s(s, Source::kPosition, in.now);
  out.imu_age_s = youngest_s(s, Source::kImu, in.now);
  for (std::size_t source = 0; source < kSources; ++source)
    for (std::size_t unit = 0; unit < world::kGnssUnits; ++unit)
      if (in_use(in, static_cast<Source>(source), unit))
        out.in_use[source] |= static_cast<UnitSet>(1U << unit);
  if (s.started) {
    // A sample may be a little ahead of the car's clock.
    const Instant at = std::max(in.now, newest(s.filter));
    Estimate raw = estimate_at(s.filter, in.filter, at);
    s.trail.note(raw, in.around.road);
    const Moment& moment = *s.trail.newest();
    go(s.drift, moment.velocity_mps[0], moment.velocity_mps[1], at);
    out.estimate = publish(s.filter, in.filter, at);
    say(out.estimate, out.ego);
  }
  out.ego.validity = validity(in.params, s, out);
}

}  // namespace

Output step(const Params& params, const Datum& datum, State& state,
            const world::SensorInput& sensors, const world::VehicleSignals& signals,
            const Surroundings& surroundings, world::SensorUse use, Instant now) {
  Output out;
  const bool gated = !params.off.has(Monitor::kInnovation);
  const FilterParams open = gated ? FilterParams{} : without_gates(params.filter);
  const Intake in{params, gated ? params.filter : open, datum, surroundings, use, now, state, out};
  state.wheels.seen = {};
  take_all(in, sensors, signals);
  watch_streams(in);
  state.stepped_at = now;
  conclude(in);
  collect_findings(in);
  return out;
}

}  // namespace pitwall::localization
