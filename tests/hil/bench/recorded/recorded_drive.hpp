// Recorded test drive: the car's own pipeline with every kind of input, recorded by the car's own
// black box.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "hil/bench/recorded/drive_again.hpp"
#include "hil/nodes/can_variant.hpp"
#include "hil/sensors/receiver_bytes.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "tests/vehicle/pipeline/standing_car.hpp"
#include "vehicle/io/black_box.hpp"
#include "vehicle/pipeline/telemetry_mapper.hpp"
#include "vehicle/pipeline/tick_log.hpp"

namespace pitwall::bench {

using pipeline::testing::kTick;
inline constexpr std::uint64_t kDrivenTicks = 300;

inline const can::Database& own_database() {
  static const auto variant = can_variant::CanVariant::of(scenario::BusRevision::kV14);
  return variant->database();
}

class RecordedDrive {
 public:
  explicit RecordedDrive(const std::string& folder)
      : RecordedDrive(folder,
                      {.car = path_of("cars/av21.yaml"), .track = path_of("tracks/lvms.yaml")}) {}
  // The text of the car is read here.
  RecordedDrive(const std::string& folder, io::BlackBoxFiles files)
      : box_(*io::BlackBox::open(folder, with_text(std::move(files)))) {
    for (std::uint64_t tick = 0; tick < kDrivenTicks; ++tick) drive(tick);
  }
  static io::BlackBoxFiles with_text(io::BlackBoxFiles files) {
    files.car_text = parameters::load_car(files.car, [](const std::string& path) {
                       return transport::read_file(path);
                     })->text;
    return files;
  }
  static std::string path_of(const std::string& in_config) {
    return std::string{PITWALL_SOURCE_DIR} + "/vehicle/config/" + in_config;
  }

 private:
  void drive(std::uint64_t tick) {
    const Instant now = pipeline::testing::kStart + kTick * static_cast<std::int64_t>(tick);
    pipeline::testing::Received received = source_.receive(now);
    receive(received.sensors, now);
    received.sensors = receivers_.samples();
    pipeline::Inputs in = received.inputs(now);
    add_rare(tick, now, in);
    const pipeline::Outputs out = pipeline::step(pipeline::testing::setup(), *car_, in);
    box_.tick(in, out.passed.frames.span());
    log_->note(in, out, pipeline::testing::setup().track.length_m());
    pipeline::IoCounters io;
    io.steps = tick;
    if (!box_.state_due(tick)) return;
    const Instant at = now + microseconds(700);  // a step takes its time
    box_.state(pipeline::map_telemetry({.setup = pipeline::testing::setup(),
                                        .car = *car_,
                                        .out = out,
                                        .log = *log_,
                                        .io = io,
                                        .now = at}),
               at);
  }

  // Encodes the samples as their receivers send them.
  void receive(const world::SensorInput& samples, Instant now) {
    receivers_.clear();
    encoders_.encode(samples, [&](std::uint8_t unit, std::span<const std::uint8_t> bytes) {
      box_.receiver(unit, now, bytes);
      receivers_.receive(unit, bytes, now);
    });
  }

  // Adds the rare inputs: commands, a joystick, a stop, a guardian, a link with losses.
  void add_rare(std::uint64_t tick, Instant now, pipeline::Inputs& in) {
    commands_.clear();
    if (tick == 40 || tick == 41)
      commands_.push_back({.id = static_cast<std::uint32_t>(tick),
                           .kind = world::OperatorCommandKind::kSensorsExcluded,
                           .argument = 2.0,
                           .expires = now + seconds(1)});
    in.commands = commands_;
    in.requests.arm = tick >= 60;
    if (tick >= 80 && tick < 120)
      in.operator_inputs.joystick = world::Joystick{.throttle_cap = 0.4, .brake = 0.1, .at = now};
    if (tick >= 150) in.operator_inputs.stop = world::StopRequest::kControlled;
    in.gnss_byte_at = {now, std::nullopt};
    in.link = {.controller = world::ControllerState::kActive,
               .lost_in_socket = tick / 100,
               .tx_stalled = milliseconds(static_cast<std::int64_t>(tick % 3))};
    if (tick >= 200 && tick < 210)
      in.guardian = {.drives = true,
                     .stopped = false,
                     .drove_from = now - milliseconds(50),
                     .drove_until = now,
                     .counters = {.brake = 7, .throttle = 8, .steering = 9, .report = 10},
                     .command = {.at = now, .road_wheel_rad = 0.01, .gear = 1}};
    in.computer = {.processor_share = 0.5, .memory_mib = 900.0, .temperature_c = 61.0};
  }

  pipeline::testing::StandingCar source_;
  io::BlackBox box_;
  std::unique_ptr<pipeline::Car> car_ = std::make_unique<pipeline::Car>();
  std::unique_ptr<pipeline::TickLog> log_ = std::make_unique<pipeline::TickLog>();
  sensors::ReceiverEncoders encoders_{pipeline::testing::setup().params.receivers};
  ReceiverDecoder receivers_{pipeline::testing::setup().params.receivers};
  std::vector<world::OperatorCommand> commands_;
};

// The recording is made once for all tests of this folder.
inline const std::string& recorded_folder() {
  static const transport::TemporaryFolder folder =
      *transport::TemporaryFolder::create("pitwall-recorded-");
  static const std::string path = [] {
    const RecordedDrive drive{folder.path()};
    return folder.path();
  }();
  return path;
}

}  // namespace pitwall::bench
