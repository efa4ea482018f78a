// Tick in which every number is different, so that a test detects exchanged fields, and the
// telemetry of this tick.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "protocol/telemetry/registry/registry.hpp"
#include "tests/vehicle/pipeline/standing_car.hpp"
#include "vehicle/pipeline/telemetry_mapper.hpp"
#include "vehicle/safety/fault_log.hpp"

namespace pitwall::pipeline::testing {

using telemetry::field;

inline constexpr Instant kNow{100'000'000'000};

inline Instant ago_ms(std::int64_t ms) { return kNow - milliseconds(ms); }

template <class T>
void receive(world::Received<T>& received, const T& value, std::int64_t age_ms) {
  received = {.value = value, .at = ago_ms(age_ms), .received = true};
}

inline void set_received_signals(world::VehicleSignals& s) {
  receive(s.wheel_speed_mps, world::PerWheel{{61, 62, 63, 64}}, 11);
  receive(s.brake, world::BrakePressure{.front_kpa = 2100, .rear_kpa = 2000}, 12);
  receive(s.throttle_fraction, 0.25, 13);
  receive(s.steering_motor_rad, 0.39, 14);
  receive(s.misc,
          world::Misc{.battery_v = 13.6,
                      .sys_state = world::SysState::kDriving,
                      .mode_switch = 1,
                      .safety_switch = 6},
          15);
  world::Powertrain p;
  p.gear = 4;
  p.engine_speed_rpm = 6100;
  p.engine_running = true;
  p.throttle_fraction = 0.3;
  p.vehicle_speed_mps = 60.25;
  p.gear_shift_status = 3;
  receive(s.powertrain, p, 16);
  receive(s.engine,
          world::EngineHealth{.fuel_pressure_kpa = 350,
                              .oil_pressure_kpa = 480,
                              .coolant_c = 91,
                              .transmission_c = 85,
                              .transmission_pressure_kpa = 240},
          17);
  world::DriveByWireDiagnostics d;
  d.system_warning = true;
  d.race_control_lost = true;
  receive(s.diagnostics, d, 18);
  receive(s.tyre_temperature_c, world::PerWheel{{71, 72, 73, 74}}, 19);
  receive(s.tyre_pressure_kpa, world::PerWheel{{151, 152, 153, 154}}, 20);
  receive(s.rival,
          world::RivalReport{
              .number = 17, .rank = 2, .laps = 8, .lap_distance_m = 1234, .speed_mps = 61.5},
          21);
}

// Rates, gaps and latencies of the last second.
inline void set_sensor_ages(safety::WatchdogOutput& watchdog) {
  const auto figures = [&](safety::Stream stream, double rate_hz, int gap_ms, int latency_ms) {
    auto& row = watchdog.rows[static_cast<std::size_t>(stream)];
    row.rate_hz = rate_hz, row.gap = milliseconds(gap_ms), row.latency = milliseconds(latency_ms);
  };
  figures(safety::Stream::kGnss1Position, 20, 50, 30);
  figures(safety::Stream::kImu0, 100, 10, 4);
}

inline void set_position(Outputs& out) {
  out.ego = {.at = ago_ms(21),
             .validity = world::Validity::kDeadReckoning,
             .x_m = -310.5,
             .y_m = 220.25,
             .yaw_rad = 1.5,
             .vx_mps = 60.5,
             .vy_mps = -0.75,
             .yaw_rate_rad_per_s = 0.375,
             .ax_mps2 = 1,
             .ay_mps2 = 2,
             .position_sigma_m = 0.125,
             .yaw_sigma_rad = 3};
  out.place = {.s_m = 1500.5, .n_m = -1.25};
}

// In the order of their numbers: the last one is the nearest along the track.
inline void set_opponents(world::Opponents& opponents) {
  for (const double k : {4.0, 3.0, 2.0, 1.0}) {
    world::Opponent car{.id = static_cast<std::uint32_t>(10.0 * k)};
    car.s_m = 1500.5 + 20.0 * k, car.n_m = 0.25 * k;
    car.speed_mps = 50.0 + k;
    car.measured_at = kNow - milliseconds(100) * static_cast<std::int64_t>(k);
    car.covariance[0] = car.covariance[5] = 0.25 * k * k;
    (void)opponents.cars.push(car);
  }
}

inline Outputs full() {
  Outputs out;
  set_received_signals(out.received.signals);
  out.received.race_control.ever_received = true;
  out.received.race_control.track = world::TrackFlag::kYellow;
  out.received.race_control.vehicle = world::VehicleFlag::kBlue;
  out.received.race_control.round_target_speed_mps = 53.6;
  out.received.race_control.last_heartbeat_change = ago_ms(700);
  out.received.race_control.lap_count = 9;
  out.received.bus.frames_applied = 1001;
  out.received.bus.refused.stuck_counter = 30;
  out.received.bus.refused.unknown_id = 7;
  out.received.bus.frames_lost = 12;
  out.received.bus.identity = {.verdict = world::IdentityVerdict::kWrong,
                               .difference = world::IdentityDifference::kWrongLength,
                               .id = 1312,
                               .database = 0x12345678'9ABCDEF0};
  out.received.bus.link.controller = world::ControllerState::kPassive;
  out.received.bus.link.lost_in_socket = 4;
  out.received.bus.link.lost_in_interface = 5;
  set_position(out);
  set_opponents(out.opponents);
  out.tracking.target_speed_mps = 64.5;
  out.chosen.mode = world::Mode::kControlledStop;
  out.chosen.cause = safety::Cause::kImuLost;
  out.chosen.actuate = true;
  out.chosen.arming = safety::Arming::kUsed;
  out.chosen.command = {
      .at = kNow, .road_wheel_rad = 0.0625, .throttle_fraction = 0.5, .brake_kpa = 1800, .gear = 5};
  out.ct_state = world::CtState::kCoordinatedStop;
  out.passed.refused_total = 77;
  for (std::size_t i = 0; i < safety::kStreams; ++i) {
    auto& row = out.watchdog.rows[i];
    row = {static_cast<safety::Stream>(i), static_cast<safety::Health>(i % 5), milliseconds(5)};
  }
  set_sensor_ages(out.watchdog);
  out.received.race_control.conflict = true;
  out.chosen.causes.add(safety::Cause::kOperatorEmergency);
  out.chosen.causes.add(safety::Cause::kRadioLost);
  out.chosen.causes.add(safety::Cause::kGnssRtkLost);
  out.chosen.causes.add(safety::Cause::kGnssDegraded);
  out.chosen.limited = true;
  out.steered.speed.grip_limited = true;
  out.chosen.standstill = true;
  out.quiet = true;
  out.estimate.yaw_rad = 1.0;
  for (std::size_t i = 0; i < 5; ++i) {
    const double sigma = 0.01 * static_cast<double>(i + 1);
    out.estimate.covariance[6 * i] = sigma * sigma;
  }
  out.estimate.gyro_bias_rad_per_s[2] = 0.01;
  out.estimate.position_m[2] = -3.5;
  out.estimate.height_sigma_m = 0.06;
  out.radio = {.level = safety::LinkLossLevel::kNoComm, .throttle_cap = 0.6};
  out.speed_limit_mps = 55.5;
  out.tracking.cross_track_m = 0.375;
  out.tracking.heading_error_rad = 0.03125;
  out.watchdog.rows[static_cast<std::size_t>(safety::Stream::kRadio)] = {
      safety::Stream::kRadio, safety::Health::kWarning, milliseconds(1'250)};
  return out;
}

// State of the car: faults, a plan, a running filter.
// A camera that sees the one other car so far off for a while.
inline void watch_camera(std::uint8_t unit, double bearing_rad, double ratio,
                         tracking::CameraWatch& watch) {
  using world::DetectionSource;
  constexpr double kAhead_m = 40.0;
  const auto frame = [](DetectionSource source, std::uint8_t of, Instant at) {
    tracking::AdmittedFrame made{.key = {at, source, of}, .own = {}, .measurements = {}};
    made.own = {.x_m = 0, .y_m = 0, .yaw_rad = 0, .vx_mps = 0, .vy_mps = 0};
    return made;
  };
  for (int i = 0; i < 60; ++i) {
    const Instant at = Instant{} + milliseconds(1'000'000 * unit + 100 * i);
    tracking::AdmittedFrame lidar = frame(DetectionSource::kLidar, 0, at);
    tracking::AdmittedFrame camera = frame(DetectionSource::kCamera, unit, at + milliseconds(50));
    EXPECT_TRUE(lidar.measurements.push({{kAhead_m, 0.0}, 0.9}));
    EXPECT_TRUE(camera.measurements.push({{bearing_rad, 1.0 / (kAhead_m * ratio)}, 0.9}));
    watch.note(lidar), watch.note(camera);
  }
}

inline std::unique_ptr<Car> full_car() {
  auto car = std::make_unique<Car>();
  watch_camera(0, 0.02, 1.25, car->tracking.cameras);
  watch_camera(1, -0.03, 0.8, car->tracking.cameras);
  car->supervisor.log.record({ago_ms(9'000), safety::Cause::kGnssRateLost, 1.0}, false);
  car->supervisor.log.record({ago_ms(4'000), safety::Cause::kImuLost, 1.0}, true);
  car->follow = safety::Follow::kStop;
  car->bank_rad = 0.25;
  car->fuel.enter(40.0);
  car->control.gear.missed = 3;
  car->plan.ever = true;
  car->plan.at = ago_ms(22);
  car->plan.good_at = ago_ms(72);
  car->plan.made_with = {.track = world::TrackFlag::kOrange,
                         .vehicle = world::VehicleFlag::kDefender,
                         .ever_received = true};
  car->plan.output.reason = planning::Reason::kCaution;
  car->plan.output.line_offset_m = -0.5;
  car->plan.output.stop_distance_m = 210;
  localization::State& state = car->localization;
  state.started = true;
  state.restarts = 3;
  using enum localization::Gate;
  const auto tally = [&](localization::Source source, std::size_t unit) -> localization::Tally& {
    return state.tally[static_cast<std::size_t>(source)][unit];
  };
  localization::Tally& position = tally(localization::Source::kPosition, 1);
  position.ever_accepted = true;
  position.last_accepted = ago_ms(60);
  position.by_gate[static_cast<std::size_t>(kAccepted)] = 500;
  position.by_gate[static_cast<std::size_t>(kOutlier)] = 41;
  position.by_gate[static_cast<std::size_t>(kNotSolved)] = 42;
  position.by_gate[static_cast<std::size_t>(kTooUncertain)] = 43;
  position.by_gate[static_cast<std::size_t>(kTooOld)] = 44;
  position.by_gate[static_cast<std::size_t>(kImplausible)] = 45;
  for (const std::size_t unit : {0U, 1U}) {
    tally(localization::Source::kHeading, unit).ever_accepted = true;
    tally(localization::Source::kHeading, unit).last_accepted = ago_ms(900);
  }
  car->orders.use.excluded = 0b01010;
  const auto verdict = [&](localization::Source source, std::size_t unit, localization::Gate gate) {
    state.streams[static_cast<std::size_t>(source)][unit].verdict = gate;
  };
  verdict(localization::Source::kPosition, 1, kDisagrees);
  verdict(localization::Source::kVelocity, 1, kAccepted);
  verdict(localization::Source::kHeading, 1, kWrongBaseline);
  verdict(localization::Source::kAttitude, 1, kStandby);
  verdict(localization::Source::kImu, 0, kAccepted);
  verdict(localization::Source::kImu, 1, kSilent);
  state.wheels.verdict = kProbation;
  position.by_gate[static_cast<std::size_t>(kDisagrees)] = 46;
  position.by_gate[static_cast<std::size_t>(kRepeated)] = 40;
  position.by_gate[static_cast<std::size_t>(kRanBack)] = 7;
  tally(localization::Source::kImu, 0).ever_accepted = true;
  tally(localization::Source::kImu, 0).last_accepted = ago_ms(8);
  return car;
}

// 1.3 s of ticks: one receiver at 20 Hz, one IMU at 100 Hz, more than one lap of the track.
inline TickLog full_log() {
  TickLog log;
  constexpr int kTicks = 130;
  for (int tick = 0; tick <= kTicks; ++tick) {
    const Instant now = kNow - milliseconds(10 * (kTicks - tick));
    world::SensorInput sensors;
    if (tick % 5 == 0) {
      (void)sensors.positions.push({.unit = 1,
                                    .at = now - milliseconds(30),
                                    .solution_status = 0,
                                    .position_type = 50,
                                    .latitude_sigma_m = 0.02,
                                    .longitude_sigma_m = 0.03,
                                    .height_sigma_m = 0.04,
                                    .satellites = 17,
                                    .differential_age_s = 1.5});
      (void)sensors.velocities.push({.unit = 1, .at = now, .horizontal_mps = 61.5});
      (void)sensors.headings.push({.unit = 1,
                                   .at = now,
                                   .solution_status = 6,
                                   .position_type = 34,
                                   .heading_sigma_rad = 0.004});
    }
    (void)sensors.imu.push({.unit = 0,
                            .at = now - milliseconds(4),
                            .rate_rad_per_s = {0.125, -0.25, 9.0},
                            .specific_force_mps2 = {9, 9, 9.75}});
    Outputs out;
    out.place.s_m = std::fmod(1000.0 + 20.0 * tick, 1200.0);
    log.note({.now = now, .can = {}, .sensors = sensors, .requests = {}}, out, 1200.0);
  }
  return log;
}

inline constexpr IoCounters kIoCounters{
    .frames_sent = 2002,
    .tx_drops = 3,
    .steps = 4004,
    .missed_deadlines = 5,
    .step_time_max_us = 66,
    .step_time_p50_us = 40,
    .processor_share = 0.4,
    .memory_mib = 512,
    .temperature_c = 61.5,
    .heartbeats = 88,
    .heartbeats_refused = 9,
    .base_runs = 2,
    .slots_skipped = 6,
    .threats = 34,
    .round_trip_ms = 12.5,
    .paths = {{{0.25, 40, 0.5}, {0.125, 44, 0.75}}},
    .receivers = {{{601, 602, 603, 604, 605, 606, 607}, {701, 702, 703, 704, 705, 706, 707}}},
    .lidar_frames = {19, 61, 42, 3},
    .radar = {15, 81, 62, 9},
    .lidars = {{{20, 51, 40, 4}, {17, 52, 41, 5}, {16, 53, 43, 6}}},
    .cameras = {{{18, 71, 52, 7}, {14, 72, 53, 8}}},
    .uplink = {.known = true,
               .stop_latch = 1,
               .stop_challenge = 4711,
               .stop_reason = 3,
               .authority = 5,
               .joystick = true,
               .schema_agrees = true}};

inline std::string name_of(std::size_t i) {
  const auto& row = telemetry::kFields[i];
  return std::string(telemetry::row_of(row.group).name) + "." + std::string(row.name);
}

struct Row {
  telemetry::FieldIndex field;
  double value;
};

inline telemetry::Snapshot mapped(const Outputs& out, const IoCounters& io = kIoCounters) {
  static const auto kCar = full_car();
  static const TickLog kLog = full_log();
  return map_telemetry(
      {.setup = setup(), .car = *kCar, .out = out, .log = kLog, .io = io, .now = kNow});
}

inline telemetry::Snapshot mapped_of_nothing() {
  const auto car = std::make_unique<Car>();
  return map_telemetry(
      {.setup = setup(), .car = *car, .out = {}, .log = {}, .io = {}, .now = kNow});
}

inline void expect(const std::vector<Row>& rows) {
  const auto snapshot = mapped(full());
  for (const Row& row : rows)
    EXPECT_NEAR(snapshot.values[row.field], row.value, 1e-9) << name_of(row.field);
}

}  // namespace pitwall::pipeline::testing
