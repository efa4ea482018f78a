// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/health_mapper.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "protocol/telemetry/registry/labels.hpp"
#include "vehicle/safety/fault_log.hpp"

namespace pitwall::pipeline {
namespace {

using localization::Gate;
using localization::Source;
using telemetry::field;
using telemetry::FieldIndex;
using telemetry::Group;
using telemetry::Snapshot;
using telemetry::Values;

// The rows of the streams are the watchdog's, in its order.
constexpr FieldIndex kFirstStream = telemetry::fields_of(Group::kStreams).first;
static_assert(telemetry::fields_of(Group::kStreams).count == safety::kStreams);
static_assert(field("streams.gnss0_link") - kFirstStream ==
              static_cast<std::size_t>(safety::Stream::kGnss0Link));
static_assert(field("streams.misc") - kFirstStream ==
              static_cast<std::size_t>(safety::Stream::kMisc));
static_assert(field("streams.radio") - kFirstStream ==
              static_cast<std::size_t>(safety::Stream::kRadio));

constexpr bool verdicts_are_labelled_as_in_localization() {
  for (std::size_t i = 0; i < localization::kGates; ++i)
    if (telemetry::label_at(telemetry::kSampleVerdicts, i) != localization::kGateNames[i])
      return false;
  return telemetry::label_at(telemetry::kSampleVerdicts, localization::kGates).empty();
}
static_assert(verdicts_are_labelled_as_in_localization(), "labels of verdicts are out of date");
static_assert(telemetry::label_at(telemetry::kExcludableNames,
                                  static_cast<std::size_t>(world::Excludable::kRadar)) == "radar" &&
              telemetry::label_at(telemetry::kExcludableNames, world::kExcludables).empty());

template <class T>
double number(T value) {
  return static_cast<double>(value);
}

void put_estimate(Values& v, const localization::Estimate& estimate) {
  constexpr std::size_t kSize = 5;  // x, y, yaw, velocity x, velocity y
  const auto sigma = [&](std::size_t i) { return std::sqrt(estimate.covariance[i * kSize + i]); };
  if (!std::isfinite(estimate.yaw_rad)) return;
  v[field("localization.sigma_x")] = sigma(0);
  v[field("localization.sigma_y")] = sigma(1);
  v[field("localization.sigma_yaw")] = sigma(2);
  v[field("localization.sigma_vx")] = sigma(3);
  v[field("localization.sigma_vy")] = sigma(4);
  v[field("localization.gyro_bias")] = estimate.gyro_bias_rad_per_s[2];
  v[field("localization.height")] = estimate.position_m[2];
  v[field("localization.sigma_height")] = estimate.height_sigma_m;
}

// Which units were accepted lately: 0 none, 1 unit 0, 2 unit 1, 3 both.
double units_of(const localization::State& state, Source source, Duration lately, Instant now) {
  std::uint32_t set = 0;
  const auto& tally = state.tally[static_cast<std::size_t>(source)];
  for (std::size_t unit = 0; unit < tally.size(); ++unit) {
    const bool used = tally[unit].ever_accepted && now - tally[unit].last_accepted <= lately;
    set |= (used ? 1U : 0U) << unit;
  }
  return set;
}

double gate_total(const localization::State& state, Gate gate) {
  std::uint64_t total = 0;
  for (const auto& units : state.tally)
    for (const localization::Tally& tally : units)
      total += tally.by_gate[static_cast<std::size_t>(gate)];
  return number(total);
}

double verdict_of(const localization::State& state, Source source, std::size_t unit) {
  return number(
      static_cast<std::uint8_t>(state.streams[static_cast<std::size_t>(source)][unit].verdict));
}

void put_verdicts(const TelemetryInputs& in, Values& v) {
  const localization::State& state = in.car.localization;
  v[field("localization.excluded")] = in.car.orders.use.excluded;
  v[field("localization.imu0_verdict")] = verdict_of(state, Source::kImu, 0);
  v[field("localization.imu1_verdict")] = verdict_of(state, Source::kImu, 1);
  v[field("localization.wheel_verdict")] = number(static_cast<std::uint8_t>(state.wheels.verdict));
  v[field("localization.contradicted")] = gate_total(state, Gate::kDisagrees);
  double stamps = 0.0;
  for (const Gate gate : {Gate::kFromTheFuture, Gate::kRepeated, Gate::kRanBack, Gate::kFrozen})
    stamps += gate_total(state, gate);
  v[field("localization.bad_stamps")] = stamps;
}

void put_localization(const TelemetryInputs& in, Snapshot& snapshot) {
  Values& v = snapshot.values;
  const localization::State& state = in.car.localization;
  put_estimate(v, in.out.estimate);
  put_verdicts(in, v);
  const auto& positions = state.tally[static_cast<std::size_t>(Source::kPosition)];
  for (const localization::Tally& unit : positions) {
    if (!unit.ever_accepted) continue;
    const double age_s = (in.now - unit.last_accepted).seconds();
    double& shown = v[field("localization.position_age")];
    shown = std::isnan(shown) ? age_s : std::min(shown, age_s);
  }
  constexpr Duration kPositionLately = milliseconds(250), kHeadingLately = milliseconds(2'500),
                     kImuLately = milliseconds(50);
  v[field("localization.position_units")] =
      units_of(state, Source::kPosition, kPositionLately, in.now);
  v[field("localization.velocity_units")] =
      units_of(state, Source::kVelocity, kPositionLately, in.now);
  v[field("localization.heading_units")] =
      units_of(state, Source::kHeading, kHeadingLately, in.now);
  v[field("localization.imu_units")] = units_of(state, Source::kImu, kImuLately, in.now);
  v[field("localization.accepted")] = gate_total(state, Gate::kAccepted);
  v[field("localization.outliers")] = gate_total(state, Gate::kOutlier);
  v[field("localization.unsolved")] = gate_total(state, Gate::kNotSolved);
  v[field("localization.uncertain")] = gate_total(state, Gate::kTooUncertain);
  v[field("localization.late")] = gate_total(state, Gate::kTooOld);
  v[field("localization.implausible")] = gate_total(state, Gate::kImplausible);
  v[field("localization.restarts")] = state.restarts;
  snapshot.at(Group::kLocalization) = in.now;
}

void put_streams(const TelemetryInputs& in, Snapshot& snapshot) {
  for (std::size_t i = 0; i < safety::kStreams; ++i)
    snapshot.values[kFirstStream + i] =
        number(static_cast<std::uint8_t>(in.out.watchdog.rows[i].health));
  snapshot.at(Group::kStreams) = in.now;
}

void put_sensors(const TelemetryInputs& in, Snapshot& snapshot) {
  using safety::Stream;
  struct Row {
    Stream stream;
    FieldIndex rate;  // gap and latency follow it
  };
  constexpr std::array kRows{Row{Stream::kGnss0Position, field("sensors.gnss0_rate")},
                             Row{Stream::kGnss1Position, field("sensors.gnss1_rate")},
                             Row{Stream::kImu0, field("sensors.imu0_rate")},
                             Row{Stream::kImu1, field("sensors.imu1_rate")}};
  static_assert(field("sensors.gnss0_gap") == field("sensors.gnss0_rate") + 1 &&
                field("sensors.gnss0_latency") == field("sensors.gnss0_rate") + 2);
  for (const Row& row : kRows) {
    const safety::StreamRow& figures = in.out.watchdog[row.stream];
    if (std::isnan(figures.rate_hz)) continue;  // not heard for a whole second yet
    snapshot.values[row.rate] = figures.rate_hz;
    snapshot.values[row.rate + 1] = figures.gap.milliseconds();
    snapshot.values[row.rate + 2] = figures.latency.milliseconds();
    snapshot.at(Group::kSensors) = in.now;
  }
  const auto put = [&](FieldIndex rate, const IoCounters::Sensor& sensor) {
    if (std::isnan(sensor.rate_hz)) return;
    snapshot.values[rate] = sensor.rate_hz;
    snapshot.values[rate + 1] = sensor.gap_ms;
    snapshot.values[rate + 2] = sensor.latency_ms;
    snapshot.values[rate + 3] = sensor.drops;
    snapshot.at(Group::kSensors) = in.now;
  };
  static_assert(field("sensors.lidar_drops") == field("sensors.lidar_rate") + 3);
  put(field("sensors.lidar_rate"), in.io.lidar_frames);
  put(field("sensors.lidar0_rate"), in.io.lidars[0]);
  put(field("sensors.lidar1_rate"), in.io.lidars[1]);
  put(field("sensors.lidar2_rate"), in.io.lidars[2]);
  put(field("sensors.camera0_rate"), in.io.cameras[0]);
  put(field("sensors.camera1_rate"), in.io.cameras[1]);
  put(field("sensors.radar_rate"), in.io.radar);
  constexpr std::array kBiases{field("sensors.camera0_bearing_bias"),
                               field("sensors.camera1_bearing_bias")};
  static_assert(field("sensors.camera0_distance_ratio") == kBiases[0] + 1);
  for (std::size_t unit = 0; unit < kBiases.size(); ++unit) {
    const world::CameraBias bias = in.car.tracking.cameras.bias(unit);
    snapshot.values[kBiases[unit]] = bias.bearing_rad;
    snapshot.values[kBiases[unit] + 1] = bias.distance_ratio;
  }
}

void put_receiver(const TelemetryInputs& in, std::size_t unit, Snapshot& snapshot) {
  const auto& position = in.log.position(unit);
  if (!position) return;
  const Group group = unit == 0 ? Group::kGnss0 : Group::kGnss1;
  const auto at = [&](FieldIndex of_unit_0) -> double& {
    return snapshot.values[of_unit_0 - telemetry::fields_of(Group::kGnss0).first +
                           telemetry::fields_of(group).first];
  };
  at(field("gnss0.status")) = position->solution_status;
  at(field("gnss0.type")) = position->position_type;
  at(field("gnss0.satellites")) = position->satellites;
  at(field("gnss0.sigma")) = std::max(position->latitude_sigma_m, position->longitude_sigma_m);
  at(field("gnss0.height_sigma")) = position->height_sigma_m;
  at(field("gnss0.position_age")) = std::max(0.0, (in.now - position->at).seconds());
  if (const auto& velocity = in.log.velocity(unit))
    at(field("gnss0.speed")) = velocity->horizontal_mps;
  if (const auto& heading = in.log.heading(unit)) {
    at(field("gnss0.heading_status")) = heading->solution_status;
    at(field("gnss0.heading_type")) = heading->position_type;
    at(field("gnss0.heading_sigma")) = heading->heading_sigma_rad;
  }
  const localization::State& state = in.car.localization;
  at(field("gnss0.differential_age")) = position->differential_age_s;
  at(field("gnss0.position_verdict")) = verdict_of(state, Source::kPosition, unit);
  at(field("gnss0.velocity_verdict")) = verdict_of(state, Source::kVelocity, unit);
  at(field("gnss0.heading_verdict")) = verdict_of(state, Source::kHeading, unit);
  at(field("gnss0.attitude_verdict")) = verdict_of(state, Source::kAttitude, unit);
  // The verdicts are of now: who fell silent is told to be, with the age of what it said last.
  snapshot.at(group) = in.now;
}

void put_traffic(const TelemetryInputs& in, Snapshot& snapshot) {
  constexpr FieldIndex kFirst = telemetry::fields_of(Group::kReceivers).first;
  constexpr FieldIndex kPerUnit = telemetry::fields_of(Group::kReceivers).count / world::kGnssUnits;
  static_assert(field("receivers.lost_0") == kFirst + kPerUnit - 1);
  const auto known = [](const world::ReceiverTraffic& t) { return t.bytes + t.lost > 0; };
  if (std::none_of(in.io.receivers.begin(), in.io.receivers.end(), known)) return;
  for (std::size_t unit = 0; unit < world::kGnssUnits; ++unit) {
    const world::ReceiverTraffic& t = in.io.receivers[unit];
    const std::array<std::uint64_t, kPerUnit> counts{
        t.bytes, t.logs, t.bad_checksum, t.bad_frame, t.resyncs, t.refused, t.lost};
    for (std::size_t i = 0; i < kPerUnit; ++i)
      snapshot.values[kFirst + unit * kPerUnit + i] = number(counts[i]);
  }
  snapshot.at(Group::kReceivers) = in.now;
}

void put_computer(const TelemetryInputs& in, Snapshot& snapshot) {
  Values& v = snapshot.values;
  v[field("computer.step_time_max")] = in.io.step_time_max_us;
  v[field("computer.step_time_p50")] = in.io.step_time_p50_us;
  v[field("computer.steps")] = number(in.io.steps);
  v[field("computer.missed_deadlines")] = number(in.io.missed_deadlines);
  v[field("computer.processor")] = in.io.processor_share;
  v[field("computer.memory")] = in.io.memory_mib;
  v[field("computer.temperature")] = in.io.temperature_c;
  snapshot.at(Group::kComputer) = in.now;
}

void put_faults(const TelemetryInputs& in, Snapshot& snapshot) {
  Values& v = snapshot.values;
  const safety::FaultLog& log = in.car.supervisor.log;
  const std::uint64_t causes = in.out.chosen.causes.bits() >> 1U;  // bit 0 is kNone, never set
  constexpr std::uint64_t kFirst = (std::uint64_t{1} << telemetry::kFaultBits) - 1;
  v[field("faults.now")] = number(causes & kFirst);
  v[field("faults.now_more")] = number(causes >> telemetry::kFaultBits);
  v[field("faults.recorded")] = number(log.total);
  if (log.size() > 0) {
    const safety::FaultEntry& last = log.entry(log.size() - 1);
    v[field("faults.last_cause")] = number(static_cast<std::uint8_t>(last.cause));
    v[field("faults.last_age")] = (in.now - last.at).seconds();
  }
  snapshot.at(Group::kFaults) = in.now;
}

void put_bus(const TelemetryInputs& in, Snapshot& snapshot) {
  Values& v = snapshot.values;
  const world::BusHealth& bus = in.out.received.bus;
  v[field("bus.frames_applied")] = number(bus.frames_applied);
  v[field("bus.frames_refused")] = number(bus.refused.total());
  v[field("bus.frames_sent")] = number(in.io.frames_sent);
  v[field("bus.tx_drops")] = number(in.io.tx_drops);
  v[field("bus.gate_refusals")] = number(in.out.passed.refused_total);
  v[field("bus.frames_lost")] = number(bus.frames_lost);
  v[field("bus.queue_losses")] = number(bus.link.lost_in_socket + bus.link.lost_in_interface);
  v[field("bus.controller")] = number(static_cast<std::uint8_t>(bus.link.controller));
  v[field("bus.identity")] = number(static_cast<std::uint8_t>(bus.identity.verdict));
  if (bus.identity.id != 0) v[field("bus.differing_id")] = bus.identity.id;
  // The upper half: all that a number of the packet can hold; enough to tell revisions apart.
  v[field("bus.database")] = number(bus.identity.database >> 32U);
  snapshot.at(Group::kBus) = in.now;
}

void put_radio(const TelemetryInputs& in, Snapshot& snapshot) {
  Values& v = snapshot.values;
  const safety::StreamRow& base = in.out.watchdog[safety::Stream::kRadio];
  v[field("radio.base")] = number(static_cast<std::uint8_t>(base.health));
  if (base.health > safety::Health::kNever) v[field("radio.silence")] = base.age.seconds();
  v[field("radio.rung")] = number(static_cast<std::uint8_t>(in.out.radio.level));
  v[field("radio.round_trip")] = in.io.round_trip_ms;
  v[field("radio.heartbeats")] = number(in.io.heartbeats);
  v[field("radio.heartbeats_refused")] = number(in.io.heartbeats_refused);
  v[field("radio.base_runs")] = number(in.io.base_runs);
  v[field("radio.slots_skipped")] = number(in.io.slots_skipped);
  v[field("radio.threats")] = in.io.threats;
  v[field("radio.loss_0")] = in.io.paths[0].loss;
  v[field("radio.loss_1")] = in.io.paths[1].loss;
  v[field("radio.delay_0")] = in.io.paths[0].delay_p99_ms;
  v[field("radio.delay_1")] = in.io.paths[1].delay_p99_ms;
  v[field("radio.budget_use_0")] = in.io.paths[0].budget_use;
  v[field("radio.budget_use_1")] = in.io.paths[1].budget_use;
  snapshot.at(Group::kRadio) = in.now;
}

}  // namespace

void map_health(const TelemetryInputs& in, Snapshot& snapshot) {
  put_localization(in, snapshot);
  put_streams(in, snapshot);
  put_sensors(in, snapshot);
  put_receiver(in, 0, snapshot);
  put_receiver(in, 1, snapshot);
  put_traffic(in, snapshot);
  put_computer(in, snapshot);
  put_faults(in, snapshot);
  put_bus(in, snapshot);
  put_radio(in, snapshot);
}

}  // namespace pitwall::pipeline
