// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/derive.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "basestation/state/derived/flags.hpp"
#include "basestation/state/derived/ghost.hpp"
#include "basestation/state/derived/pass.hpp"
#include "basestation/state/derived/race_fields.hpp"
#include "basestation/state/derived/sensors.hpp"
#include "basestation/state/derived/slip.hpp"
#include "protocol/telemetry/session/link_threats.hpp"

namespace pitwall::state {
namespace {

using telemetry::field;
using telemetry::FieldIndex;
using telemetry::Group;

// Values of enumerations, as telemetry/registry/labels.hpp has them.
constexpr double kModeControlledStop = 3.0, kModeEmergency = 4.0;
constexpr double kStreamLate = 3.0, kStreamLost = 4.0;

void derive_link(const Pass& pass, const Known& known, const MonitorState& monitors) {
  using enum BaseField;
  const LinkFigures& link = known.link;
  const auto yes = [](bool is) { return is ? 1.0 : 0.0; };
  pass.put(kLinkState, static_cast<double>(monitors.link.state()));
  pass.put(kLinkSilence, link.received ? (pass.now - *link.received).milliseconds() : kUnset);
  pass.put(kDownLoss, link.down_loss);
  pass.put(kUpLoss, link.up_loss);
  pass.put(kRoundTrip, link.round_trip_ms);
  pass.put(kJitter, link.jitter_ms);
  pass.put(kDownRate, link.down_kbit_s);
  pass.put(kDownCap, link.down_cap_kbit_s);
  pass.put(kUpRate, link.up_kbit_s);
  pass.put(kLoss1s, link.loss_1s);
  pass.put(kLoss30s, link.loss_30s);
  pass.put(kPacketRate, link.packets_hz);
  pass.put(kDiskMinutes, known.base.disk_minutes);
  pass.put(kRecording, known.base.recording);
  pass.put(kRecorderLost, known.base.recorder_lost);
  pass.put(kRecorderRate, known.base.recorder_kbyte_s);
  pass.put(kClockOffset, std::abs(known.base.clock_offset_ms));
  pass.put(kJoystickLost, yes(known.base.joystick_lost));
  pass.put(kAuthorityLost, yes(known.base.authority_lost));
  pass.put(kSchemaDiffers, yes(known.base.schema_differs));
  pass.put(kSettingsUnreadable, yes(known.base.settings_unreadable));
}

// What the base sees of attacks is known without a car; what the car sees, as long as it tells.
void derive_threats(const Pass& pass, const LinkFigures& link) {
  constexpr std::size_t kFirst = index_of(BaseField::kWrongKey);
  static_assert(index_of(BaseField::kRelay) - kFirst ==
                static_cast<std::size_t>(telemetry::Threat::kRelay));
  const double by_car = pass.usable(field("radio.threats"));
  const bool known = !std::isnan(link.threats) || !std::isnan(by_car);
  for (std::size_t i = 0; i < telemetry::kThreats; ++i) {
    const auto threat = static_cast<telemetry::Threat>(i);
    const double seen = (telemetry::threats_of(link.threats).has(threat) ? 1.0 : 0.0) +
                        (telemetry::threats_of(by_car).has(threat) ? 2.0 : 0.0);
    pass.put(static_cast<BaseField>(kFirst + i), known ? seen : kUnset);
  }
}

// An opponent that is no longer seen, or named, is no fault of the link.
bool comes_always(const telemetry::GroupRow& row) {
  return row.direction == telemetry::Direction::kDown &&
         !(row.group >= Group::kOpponent1 && row.group <= Group::kRival);
}

void derive_ages(const Pass& pass) {
  double worst_ms = kUnset, stale = kUnset;
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    const FieldView view = pass.vehicle.group(row.group, pass.now);
    if (!comes_always(row) || view.quality == Quality::kNever) continue;
    stale = (std::isnan(stale) ? 0.0 : stale) + (view.quality == Quality::kStale ? 1.0 : 0.0);
    if (row.priority == telemetry::Class::kSafety) {
      worst_ms = std::fmax(worst_ms, view.age.milliseconds());
    }
  }
  pass.put(BaseField::kWorstAge, worst_ms);
  pass.put(BaseField::kStaleGroups, stale);
}

void derive_watchdogs(const Pass& pass) {
  constexpr telemetry::FieldSpan kStreams = telemetry::fields_of(Group::kStreams);
  double late = 0.0, lost = 0.0;
  bool known = false;
  for (FieldIndex i = kStreams.first; i < kStreams.first + kStreams.count; ++i) {
    const double state = pass.value(i);
    known = known || !std::isnan(state);
    late += state == kStreamLate ? 1.0 : 0.0;
    lost += state == kStreamLost ? 1.0 : 0.0;
  }
  pass.put(BaseField::kWatchdogsLate, known ? late : kUnset, {kStreams.first});
  pass.put(BaseField::kWatchdogsLost, known ? lost : kUnset, {kStreams.first});
}

void derive_stop(const Pass& pass) {
  constexpr FieldIndex kMode = field("mode.mode"), kLatch = field("mode.stop_latch");
  const double mode = pass.value(kMode);
  const double by_mode = mode == kModeEmergency        ? 2.0
                         : mode == kModeControlledStop ? 1.0
                         : std::isnan(mode)            ? kUnset
                                                       : 0.0;
  pass.put(BaseField::kStop, std::fmax(by_mode, pass.value(kLatch)), {kMode, kLatch});
}

struct ReceiverFields {
  FieldIndex status, sigma, correction_age, position_age, verdict, speed, satellites;
};
constexpr std::array kReceivers{
    ReceiverFields{field("gnss0.status"), field("gnss0.sigma"), field("gnss0.differential_age"),
                   field("gnss0.position_age"), field("gnss0.position_verdict"),
                   field("gnss0.speed"), field("gnss0.satellites")},
    ReceiverFields{field("gnss1.status"), field("gnss1.sigma"), field("gnss1.differential_age"),
                   field("gnss1.position_age"), field("gnss1.position_verdict"),
                   field("gnss1.speed"), field("gnss1.satellites")}};

// Solved, sure of itself, young, and not refused by the car's own checks.
bool can_be_driven_by(const Pass& pass, const ReceiverFields& unit) {
  constexpr double kSigmaMax_m = 0.5, kAgeMax_s = 0.5;
  constexpr double kUnspoken = 0.0, kInUse = 1.0, kWaits = 9.0, kStandsBy = 10.0;
  const double verdict = pass.value(unit.verdict);
  const bool refused = verdict != kUnspoken && verdict != kInUse && verdict != kWaits &&
                       verdict != kStandsBy && !std::isnan(verdict);
  return pass.value(unit.status) == 0.0 && pass.value(unit.sigma) <= kSigmaMax_m &&
         !(pass.value(unit.position_age) > kAgeMax_s) && !refused;
}

double gnss_speed_mps(const Pass& pass) {
  const double a = pass.usable(kReceivers[0].speed), b = pass.usable(kReceivers[1].speed);
  if (std::isnan(a)) return b;
  return std::isnan(b) ? a : (a + b) / 2.0;
}

void derive_gnss(const Pass& pass, const MonitorState& monitors) {
  double good = kUnset, age_s = kUnset;
  for (const ReceiverFields& unit : kReceivers) {
    if (std::isnan(pass.value(unit.status))) continue;  // this car has no such unit
    good = (std::isnan(good) ? 0.0 : good) + (can_be_driven_by(pass, unit) ? 1.0 : 0.0);
    age_s = std::fmin(age_s, pass.value(unit.correction_age));
  }
  const auto made_of = {kReceivers[0].status, kReceivers[1].status};
  pass.put(BaseField::kGnssGood, good, made_of);
  pass.put(BaseField::kCorrectionAge, age_s, made_of);
  pass.put(BaseField::kCorrectionConflict, monitors.corrections.conflict(pass.now) ? 1.0 : 0.0);
}

void derive_slip(const Pass& pass) {
  constexpr FieldIndex kWheels = field("wheels.front_left");
  const Slip slip = slip_of({.front_left_mps = pass.value(kWheels),
                             .front_right_mps = pass.value(field("wheels.front_right")),
                             .rear_left_mps = pass.value(field("wheels.rear_left")),
                             .rear_right_mps = pass.value(field("wheels.rear_right"))},
                            gnss_speed_mps(pass));
  pass.put(BaseField::kSlipRearFront, slip.rear_front, {kWheels});
  pass.put(BaseField::kSlipRearGnss, slip.rear_gnss, {kWheels});
  pass.put(BaseField::kSlip, slip.worst(), {kWheels});
}

double least(const Pass& pass, std::initializer_list<FieldIndex> fields) {
  double least = std::numeric_limits<double>::infinity();
  for (const FieldIndex index : fields) {
    const double value = pass.value(index);
    if (std::isnan(value)) return kUnset;  // one of four that nobody knows may be the coldest
    least = std::min(least, value);
  }
  return least;
}

void derive_tyres(const Pass& pass, const TyreGate& gate) {
  constexpr FieldIndex kTyre = field("tyres.temperature_front_left"),
                       kTarget = field("track.target_speed");
  const double coldest_c =
      least(pass, {kTyre, field("tyres.temperature_front_right"),
                   field("tyres.temperature_rear_left"), field("tyres.temperature_rear_right")});
  const double target_mps = pass.value(kTarget);
  const double needed_c = std::isnan(target_mps) ? kUnset : tyre_needed_c(gate, target_mps);
  pass.put(BaseField::kTyreMin, coldest_c, {kTyre});
  pass.put(BaseField::kTyreGate, needed_c, {kTarget});
  pass.put(BaseField::kTyreMargin, coldest_c - needed_c, {kTyre, kTarget});
  pass.put(BaseField::kTyrePressureMin,
           least(pass, {field("tyres.pressure_front_left"), field("tyres.pressure_front_right"),
                        field("tyres.pressure_rear_left"), field("tyres.pressure_rear_right")}),
           {kTyre});
}

void derive_sensors(const Pass& pass) {
  constexpr FieldIndex kSensors = field("sensors.gnss0_rate"),
                       kError = field("dynamics.lateral_error");
  const SensorHealth worst = worst_sensor(pass.vehicle, pass.now);
  pass.put(BaseField::kSensorShare, worst.rate_share, {kSensors});
  pass.put(BaseField::kSensorGap, worst.gap_ms, {kSensors});
  pass.put(BaseField::kSensorLatency, worst.latency_share, {kSensors});
  pass.put(BaseField::kCameraOffset, worst_camera_offset(pass.vehicle, pass.now), {kSensors});
  pass.put(BaseField::kCrossTrack, std::abs(pass.value(kError)), {kError});
}

void derive_flags(const Pass& pass, const Expectations& expected) {
  constexpr FieldIndex kTrack = field("flags.track"), kRound = field("flags.round_target_speed"),
                       kTarget = field("track.target_speed");
  const FlagEntries flags{.race_control_track = pass.value(kTrack),
                          .race_control_vehicle = pass.value(field("flags.vehicle")),
                          .car_track = pass.value(field("flags.track_acted_on")),
                          .car_vehicle = pass.value(field("flags.vehicle_acted_on")),
                          .pit_wall_track = expected.track_flag,
                          .encodings_differ = pass.value(field("flags.conflict"))};
  const bool received = !std::isnan(flags.race_control_track) || !std::isnan(flags.car_track);
  pass.put(BaseField::kFlagConflict, received ? (flag_conflict(flags) ? 1.0 : 0.0) : kUnset,
           {kTrack});
  const double round_mps = pass.value(kRound);
  const RoundSpeeds speeds{.race_control_mps = round_mps,
                           .pit_wall_mps = expected.round_speed_mps,
                           .car_target_mps = pass.usable(kTarget),
                           .car_vehicle = flags.car_vehicle,
                           .car_forward_mps2 = pass.usable(field("dynamics.forward"))};
  pass.put(BaseField::kRaceControlSpeed, round_mps, {kRound});
  pass.put(BaseField::kRoundSpeedExpected, expected.round_speed_mps);
  pass.put(BaseField::kRoundSpeedConflict,
           std::isnan(round_mps) ? kUnset : (round_speed_conflict(speeds) ? 1.0 : 0.0), {kRound});
}

void derive_fuel(const Pass& pass, const rules::FuelLeft& left) {
  const FieldIndex source =
      left.estimated ? field("powertrain.throttle_position") : field("fuel.level");
  pass.put(BaseField::kFuelPerLap, left.per_lap_l);
  pass.put(BaseField::kFuelLevel, left.level_l, {source});
  pass.put(BaseField::kFuelEstimated,
           std::isnan(left.level_l) ? kUnset : (left.estimated ? 1.0 : 0.0));
  pass.put(BaseField::kFuelLaps, left.laps, {source});
  pass.put(BaseField::kFuelLeast, left.least_l, {source});
  pass.put(BaseField::kFuelLeastLaps, left.least_laps, {source});
  pass.put(BaseField::kFuelAttempts, left.attempts, {source});
  pass.put(BaseField::kFuelState, static_cast<double>(left.state), {source});
}

void derive_place(const Pass& pass, const Course* course) {
  constexpr FieldIndex kX = field("ego.x"), kSpeed = field("ego.vx"),
                       kStation = field("track.station");
  const LastPlace last{.x_m = pass.value(kX),
                       .y_m = pass.value(field("ego.y")),
                       .yaw_rad = pass.value(field("ego.yaw")),
                       .speed_mps = pass.value(kSpeed),
                       .sigma_m = pass.value(field("ego.position_sigma")),
                       .station_m = pass.value(kStation),
                       .offset_m = pass.value(field("track.offset"))};
  const bool ahead = course != nullptr && !std::isnan(last.station_m) && last.speed_mps > 0.0;
  const double corner_in_s = ahead ? course->to_corner_m(last.station_m) / last.speed_mps : kUnset;
  pass.put(BaseField::kCornerIn, corner_in_s, {kStation, kSpeed});
  const bool placed = course != nullptr && !std::isnan(last.station_m + last.offset_m);
  pass.put(BaseField::kInPit,
           placed ? (course->in_pit(last.station_m, last.offset_m) ? 1.0 : 0.0) : kUnset,
           {kStation});
  const auto ghost = ghost_of(last, pass.see(kX).age, course).value_or(Ghost{});
  pass.put(BaseField::kGhostX, ghost.x_m);
  pass.put(BaseField::kGhostY, ghost.y_m);
  pass.put(BaseField::kGhostYaw, ghost.yaw_rad);
  pass.put(BaseField::kGhostRadius, ghost.radius_m);
}

}  // namespace

bool MonitorState::sampled_anew(const VehicleState& vehicle, Group group, Instant now,
                                Instant& newest) {
  const FieldView view = vehicle.group(group, now);
  if (view.quality == Quality::kNever || now - view.age <= newest) return false;
  newest = now - view.age;
  return true;
}

void MonitorState::step_fuel(const VehicleState& vehicle, const Expectations& expectations,
                             Instant now) {
  const auto value = [&](FieldIndex index) { return vehicle.view(index, now).value; };
  const double lap = value(field("track.lap"));
  if (expectations.fuel_entries != fuel_entries_)
    fuel.enter(expectations.fuel_loaded_l, expectations.fuel_used_l);
  fuel_entries_ = expectations.fuel_entries;
  if (sampled_anew(vehicle, Group::kPowertrain, now, engine_at_)) {
    fuel.receive_engine({.speed_rpm = value(field("engine.speed")),
                         .throttle = value(field("powertrain.throttle_position")),
                         .running = value(field("engine.running")) > 0.0},
                        engine_at_, lap);
  }
  if (sampled_anew(vehicle, Group::kFuel, now, fuel_at_))
    fuel.receive_tank(value(field("fuel.level")), value(field("fuel.used")), lap);
}

void MonitorState::step(const VehicleState& vehicle, const Known& known, Instant now) {
  link.step(known.link, now);
  step_fuel(vehicle, known.expected, now);
  const auto value = [&](FieldIndex index) { return vehicle.view(index, now).value; };
  constexpr std::array kGroups{Group::kGnss0, Group::kGnss1};
  for (std::size_t unit = 0; unit < kReceivers.size(); ++unit) {
    if (!sampled_anew(vehicle, kGroups[unit], now, gnss_at_[unit])) continue;
    corrections.receive(unit, value(kReceivers[unit].correction_age),
                        value(kReceivers[unit].satellites), gnss_at_[unit]);
  }
}

void derive(const DeriveParams& params, const VehicleState& vehicle, const Known& known,
            const MonitorState& monitors, const Course* course, Instant now, BaseViews& views) {
  const Pass pass{.vehicle = vehicle, .now = now, .views = views};
  derive_link(pass, known, monitors);
  derive_threats(pass, known.link);
  derive_ages(pass);
  derive_watchdogs(pass);
  derive_stop(pass);
  derive_gnss(pass, monitors);
  derive_slip(pass);
  derive_tyres(pass, params.tyres);
  derive_sensors(pass);
  derive_flags(pass, known.expected);
  derive_race(pass, known, monitors, params.fuel, course);
  derive_fuel(pass, monitors.fuel.left(params.fuel));
  derive_place(pass, course);
}

}  // namespace pitwall::state
