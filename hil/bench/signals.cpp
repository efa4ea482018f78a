// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/signals.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/rules/fuel_use.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::bench {
namespace {

void set(SignalValues& values, Signal signal, double value) {
  values[static_cast<std::size_t>(signal)] = value;
}

constexpr double kNoLimit_mps = 1'000.0;

// NaN meets no condition, and before the car has spoken there is nothing to judge: the numbers that
// a condition would compare are then those of a car that did nothing wrong yet.
double or_zero(double value) { return std::isnan(value) ? 0.0 : value; }

void add_car_report(SignalValues& v, const CarReport& car, const plant::Truth& truth) {
  const auto put_value = [&](Signal signal, double value) {
    set(v, signal, car.silent ? kUnset : or_zero(value));
  };
  put_value(Signal::kMode, car.mode);
  put_value(Signal::kGateRefusals, car.gate_refusals);
  put_value(Signal::kBusRefusals, car.bus_refusals);
  put_value(Signal::kPositionError, std::hypot(car.x_m - truth.x_m, car.y_m - truth.y_m));
  put_value(Signal::kYawError, std::abs(wrap_pi(car.yaw_rad - truth.yaw_rad)));
  put_value(Signal::kIdentity, car.identity);
  put_value(Signal::kDifferingId, car.differing_id);
  put_value(Signal::kStopCause, car.cause);
  put_value(Signal::kOperatorLimit,
            std::isnan(car.operator_limit_mps) ? kNoLimit_mps : car.operator_limit_mps);
}

// The car counts from when it is sure that the base lived, so its gap is longer by what it does not
// know of the base's clock: up to half of a round trip.
constexpr Duration kGapTolerance = milliseconds(150);

void add_radio(SignalValues& v, const SignalSources& from) {
  set(v, Signal::kRadioGap, from.radio_gap.seconds());
  set(v, Signal::kRadioGapMax, from.radio_gap_max.seconds());
  const bool stopped = from.car.cause == static_cast<double>(safety::Cause::kRadioLost);
  const bool explained = from.radio_gap_max + kGapTolerance >= from.radio_limit;
  set(v, Signal::kRadioStopUnexplained, stopped && !explained ? 1.0 : 0.0);
}

void add_seen(SignalValues& v, const CarReport& car) {
  for (std::size_t m = 0; m < world::kMonitors; ++m) {
    const bool sees = car.seen && car.seen->has(static_cast<world::Monitor>(m));
    v[kSignals + m] = car.seen ? (sees ? 1.0 : 0.0) : kUnset;
  }
}

constexpr std::string_view kSeen = "seen_";

constexpr double kSlipSpeed_mps = 5.0;  // slower, the direction of motion says little

double side_slip_deg(const plant::Truth& truth) {
  if (truth.speed_mps < kSlipSpeed_mps) return 0.0;
  return std::abs(to_deg(std::atan2(truth.vy_mps, truth.vx_mps)));
}

bool is_seen(const grading::Condition& condition) { return condition.signal.starts_with(kSeen); }

}  // namespace

Duration radio_limit_of(const pipeline::CarParams& params) {
  safety::WatchdogParams watchdog = params.watchdog;
  const Duration stop = watchdog[safety::Stream::kRadio].bad;
  return params.radio.link_loss.no_comm_drives ? stop
                                               : std::min(stop, params.radio.link_loss.no_comm);
}

double cross_track_m(const Rig& rig, double line_offset_m) {
  return rig.road().n_m - line_offset_m;
}

world::Curvilinear place_of(const Rig& rig) { return {rig.road().s_m, rig.road().n_m}; }

double line_offset_m(const pipeline::Setup& setup, const world::Curvilinear& car) {
  constexpr double kElsewhere_m = 2.0;  // further from its line than a car that races
  const world::TrackPoint at = setup.track.offset(car.s_m, car.n_m);
  const double own_m = setup.line.number == 0
                           ? setup.params.planning.line.offset_m
                           : car.n_m - setup.line.project(at.x_m, at.y_m).offset_m;
  if (!setup.pit || std::abs(car.n_m - own_m) < kElsewhere_m) return own_m;
  const planning::LinePosition in_pit = setup.pit->line.project(at.x_m, at.y_m);
  const bool is_there = planning::is_in_lane(*setup.pit, in_pit.s_m) &&
                        std::abs(in_pit.offset_m) < std::abs(car.n_m - own_m);
  return is_there ? car.n_m - in_pit.offset_m : own_m;
}

double wall_gap_m(const Rig& rig) {
  return std::min(rig.road().wall_gap_left_m, rig.road().wall_gap_right_m);
}

VehiclePlace vehicle_place(const Rig& rig, double line_offset_m, Instant now) {
  return {.at = now,
          .speed_mps = rig.truth().speed_mps,
          .cross_track_m = cross_track_m(rig, line_offset_m),
          .wall_gap_m = wall_gap_m(rig),
          .s_m = rig.road().s_m,
          .left = rig.road().wall_gap_left_m < rig.road().wall_gap_right_m,
          .contact = rig.road().contact};
}

SignalValues observe(const SignalSources& from) {
  const plant::Truth& truth = from.rig.truth();
  const plant::Road& road = from.rig.road();
  SignalValues v{};
  set(v, Signal::kSpeed, truth.speed_mps);
  set(v, Signal::kStation, road.s_m);
  set(v, Signal::kOffset, road.n_m);
  set(v, Signal::kAbsCrossTrack, std::abs(cross_track_m(from.rig, from.line_offset_m)));
  set(v, Signal::kOffPath, from.off_path_m);
  set(v, Signal::kFuel, truth.fuel_kg / rules::kFuelDensity_kgpl);
  set(v, Signal::kWallGap, wall_gap_m(from.rig));
  set(v, Signal::kContact, road.contact ? 1.0 : 0.0);
  set(v, Signal::kFrictionUse, truth.friction_use);
  set(v, Signal::kLateralForce, truth.specific_force_mps2[1]);
  set(v, Signal::kBrake, truth.brake_front_kpa);
  set(v, Signal::kThrottle, truth.throttle_fraction);
  set(v, Signal::kSteering, to_deg(truth.steering_motor_rad));
  set(v, Signal::kGear, truth.gear);
  set(v, Signal::kSysState, static_cast<double>(from.rig.system_state()));
  set(v, Signal::kCtState, static_cast<double>(from.rig.ct_state()));
  set(v, Signal::kTrackFlag, static_cast<double>(from.rig.flags().track));
  set(v, Signal::kLaps, from.rig.laps().finished);
  set(v, Signal::kFlyingLapMean, from.rig.laps().best_flying_mean_mps);
  set(v, Signal::kFramesLost, static_cast<double>(from.frames_lost));
  set(v, Signal::kSideSlip, side_slip_deg(truth));
  set(v, Signal::kActuatorFrames, static_cast<double>(from.rig.actuator_frames()));
  set(v, Signal::kDeceleration, -truth.specific_force_mps2[0]);
  add_car_report(v, from.car, truth);
  add_radio(v, from);
  add_seen(v, from.car);
  return v;
}

std::vector<std::string> signal_names() {
  std::vector<std::string> names{kSignalNames.begin(), kSignalNames.end()};
  for (const std::string_view monitor : world::kMonitorNames)
    names.push_back(std::string(kSeen) + std::string(monitor));
  return names;
}

std::optional<Problem> unjudged_by(BenchMode mode, const scenario::Scenario& scenario) {
  if (mode == BenchMode::kLockstep) return std::nullopt;
  for (const grading::Expectation& row : scenario.expect)
    if (std::ranges::any_of(grading::conditions_of(row), is_seen))
      return Problem{row.name, "signals seen.* exist in lockstep only: run without --live"};
  if (scenario.lidars == scenario::LidarKind::kRaysClusters)
    return Problem{scenario.name,
                   "\"lidars: rays_clusters\" is for lockstep only: live the sensor "
                   "file of the car says what looks in its clouds"};
  return std::nullopt;
}

Result<std::vector<grading::Expectation>, Problem> expectations_of(
    const scenario::Scenario& scenario) {
  const std::vector<std::string> names = signal_names();
  std::vector<grading::Expectation> out = scenario.expect;
  for (grading::Expectation& e : out) {
    for (const grading::Condition& condition : grading::conditions_of(e))
      if (std::ranges::find(names, condition.signal) == names.end())
        return refuse(e.name, "unknown signal \"" + condition.signal + "\"");
    e.from = e.from.value_or(Instant{});
    e.to = e.to.value_or(Instant{} + scenario.duration);
    if (*e.to <= *e.from) return refuse(e.name, "the run ends before this window begins");
    if (*e.to - *e.from < e.span) return refuse(e.name, "its window is shorter than over_s");
    if (e.kind == grading::Kind::kWithin) e.limit = *e.to - *e.from;
  }
  return out;
}

}  // namespace pitwall::bench
