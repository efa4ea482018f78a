// The samples that say how the car moves: inertial units and wheels, and what stands in for them.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "vehicle/autonomy/localization/intake.hpp"

namespace pitwall::localization {
namespace {

constexpr double kWheelAccelLag_s = 0.15, kWheelAccelMax_mps2 = 30.0;
constexpr double kTyreLag_s = 0.08;  // from the angle of the wheels to the yaw rate

using world::Excludable;
using world::Monitor;

std::uint8_t preferred_imu(const Intake& in) {
  return in.params.priorities.imu == Preference::kUnit1 ? 1 : 0;
}

bool uses_imu(const Intake& in, std::uint8_t unit) {
  return in.use.uses(unit == 0 ? Excludable::kImu0 : Excludable::kImu1);
}

bool is_faulty(const Intake& in, std::uint8_t unit) {
  return !in.params.off.has(Monitor::kUnitAgreement) && in.state.imu.faulty == unit;
}

// Whether the unit may be relied on at `at`; without the watch over ages for ever.
bool lives(const Intake& in, std::uint8_t unit, Instant at) {
  const Tally& t = in.tally(Source::kImu, unit);
  if (!t.ever_accepted || !uses_imu(in, unit) || is_faulty(in, unit)) return false;
  return in.params.off.has(Monitor::kStreamAge) ||
         (at - t.last_accepted).seconds() <= in.params.imu_timeout_s;
}

Gate timing(const Intake& in, Instant at) {
  const CheckParams& checks = in.params.checks;
  const double age_s = (in.now - at).seconds();
  if (-age_s > checks.future_max_s) return Gate::kFromTheFuture;
  return age_s > in.params.filter.window_s ? Gate::kTooOld : Gate::kAccepted;
}

// Without any IMU the car turns as its steering says, in steady state:
// steering/learned_steering.hpp, with what was learned of this car.
// The held rate of a dead gyro would be believed for ever.
void use_steering_model(const Intake& in, const world::VehicleSignals& car, Instant at) {
  for (std::uint8_t unit = 0; unit < world::kGnssUnits; ++unit)
    if (lives(in, unit, at)) return;
  if (!car.steering_motor_rad.fresh(at, from_seconds(in.params.imu_timeout_s))) return;
  const Params& p = in.params;
  const double speed = in.state.wheels.speed_mps;
  // The car turns a moment after its wheels.
  const double turned_rad = car.steering_motor_rad.value / p.steering_ratio -
                            kTyreLag_s * in.around.learned.turning_rad_per_s;
  const double rate =
      steering::yaw_rate_rad_per_s(p.bicycle, in.around.learned, turned_rad, speed, in.bank_rad());
  Measurement m{.kind = Kind::kImu, .at = at};
  m.imu.rate_rad_per_s[2] = rate;
  m.imu.force_mps2[0] = in.state.wheels.accel_mps2;
  m.imu.force_mps2[1] = steering::lateral_mps2({speed, rate, in.bank_rad()});
  (void)insert(in.state.filter, in.filter, m);
}

double unknown_scale(const FilterParams& p) {
  return p.kind == FilterKind::kPlanar ? p.planar.wheel_sigma_per_speed
                                       : p.spatial.wheel_sigma_per_speed;
}

void follow_speed(WheelState& wheels, double speed_mps, Instant at) {
  const double since_s = (at - wheels.at).seconds();
  if (wheels.received && std::isfinite(wheels.speed_mps) && since_s > 0.0) {
    const double accel = std::clamp((speed_mps - wheels.speed_mps) / since_s, -kWheelAccelMax_mps2,
                                    kWheelAccelMax_mps2);
    const double share = std::min(since_s / kWheelAccelLag_s, 1.0);
    wheels.accel_mps2 += share * (accel - wheels.accel_mps2);
  }
  wheels.speed_mps = speed_mps;
}

// The car's speed by receivers at the last tick, where they say it.
double by_receivers_mps(const Intake& in) {
  const Moment* moment = in.state.trail.newest();
  const bool measured = in_use(in, Source::kVelocity, 0) || in_use(in, Source::kVelocity, 1);
  return moment && measured ? moment->speed_mps : kUnset;
}

WheelSpeed judge_wheels(const Intake& in, const world::PerWheel& reported) {
  WheelFacts facts;
  facts.speed_mps = reported;
  if (const Moment* moment = in.state.trail.newest())
    facts.yaw_rate_rad_per_s = moment->rate_rad_per_s[2];
  facts.by_receivers_mps = by_receivers_mps(in);
  const bool watched = !in.params.off.has(Monitor::kWheelAgreement);
  return watch_wheels(in.params.checks, in.state.wheels.watch, facts, watched, in.now);
}

}  // namespace

void take(const Intake& in, const world::ImuSample& sample) {
  const std::uint8_t unit = sample.unit;
  if (unit < world::kGnssUnits && !uses_imu(in, unit))
    return record_verdict(in, Source::kImu, unit, sample.at, Gate::kExcluded);
  Evidence e = evidence_of(in.params, in.datum, sample);
  if (!e.known_unit) return record_verdict(in, Source::kImu, unit, sample.at, Gate::kUnknownUnit);
  const Content content = content_of(sample);
  complete(in, in.stream(Source::kImu, unit), content, sample.at, e);
  Gate gate = admit(in, e, unit, content, sample.at);
  if (gate == Gate::kAccepted || gate == Gate::kProbation) note(in.state.imu, sample);
  const std::uint8_t preferred = preferred_imu(in);
  if (gate == Gate::kAccepted && is_faulty(in, unit)) gate = Gate::kDisagrees;
  if (gate == Gate::kAccepted && unit != preferred && lives(in, preferred, sample.at))
    gate = Gate::kStandby;
  if (gate != Gate::kAccepted) return record_verdict(in, Source::kImu, unit, sample.at, gate);
  (void)fuse(in, Source::kImu,
             {.kind = Kind::kImu,
              .unit = unit,
              .at = sample.at,
              .arm = in.params.units[unit].imu,
              .imu = {sample.rate_rad_per_s, sample.specific_force_mps2}});
}

void take_wheels(const Intake& in, const world::VehicleSignals& car) {
  const world::Received<world::PerWheel>& report = car.wheel_speed_mps;
  WheelState& wheels = in.state.wheels;
  if (!report.received) return;
  if (!in.use.uses(Excludable::kWheels)) {
    wheels = {};
    wheels.verdict = Gate::kExcluded;
    return;
  }
  if (wheels.received && report.at <= wheels.at) return;
  Gate gate = timing(in, report.at);
  WheelSpeed judged;
  if (gate == Gate::kAccepted) {
    judged = judge_wheels(in, report.value);
    if (judged.contradiction) wheels.seen.add(Monitor::kWheelAgreement);
    if (!std::isfinite(judged.speed_mps))
      gate = judged.contradiction ? Gate::kDisagrees : Gate::kNotFinite;
  }
  if (gate != Gate::kAccepted) {
    wheels.at = report.at;
    wheels.received = true;
    wheels.speed_mps = kUnset;
    return record_verdict(in, Source::kWheelSpeed, 0, report.at, gate);
  }
  const CheckParams& checks = in.params.checks;
  const double since_s = wheels.received ? (report.at - wheels.at).seconds() : 0.0;
  learn(checks, wheels.scale, judged.speed_mps, by_receivers_mps(in), wheels.accel_mps2, since_s);
  follow_speed(wheels, without_scale(checks, wheels.scale, judged.speed_mps), report.at);
  wheels.at = report.at;
  wheels.received = true;
  const bool fused = fuse(in, Source::kWheelSpeed,
                          {.kind = Kind::kWheelSpeed,
                           .at = report.at,
                           .a = wheels.speed_mps,
                           .sigma_b = scale_sigma(checks, wheels.scale, unknown_scale(in.filter))});
  (void)fused;  // told
  if (!in.state.started) return;
  use_steering_model(in, car, report.at);
  (void)insert(in.state.filter, in.filter, {.kind = Kind::kSlip, .at = report.at});
}

}  // namespace pitwall::localization
