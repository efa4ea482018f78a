// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/tick_inputs.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "protocol/vocabulary/random.hpp"

namespace pitwall::io {
namespace {

Instant any_instant(Random& random) {
  return Instant{static_cast<std::int64_t>(random.next() >> 2U)};
}
double any_value(Random& random) { return static_cast<double>(random.below(1'000'000)) * 1e-3; }
std::optional<Instant> sometimes(Random& random) {
  return random.one_in(3) ? std::nullopt : std::optional{any_instant(random)};
}

pipeline::GuardianView any_guardian(Random& random) {
  const auto byte = [&] { return static_cast<std::uint8_t>(random.below(256)); };
  return {.drives = random.one_in(2),
          .stopped = random.one_in(2),
          .drove_from = any_instant(random),
          .drove_until = any_instant(random),
          .counters = {.brake = byte(), .throttle = byte(), .steering = byte(), .report = byte()},
          .command = {.at = any_instant(random),
                      .road_wheel_rad = any_value(random),
                      .throttle_fraction = any_value(random),
                      .brake_kpa = any_value(random),
                      .gear = byte()}};
}

world::LinkObservation any_link(Random& random) {
  return {.controller = static_cast<world::ControllerState>(random.below(6)),
          .lost_in_socket = random.next(),
          .lost_in_interface = random.next(),
          .error_frames = random.next(),
          .tx_drops = random.next(),
          .restarts = random.next(),
          .tx_stalled = any_instant(random) - Instant{},
          .load = any_value(random)};
}

struct Given {
  std::vector<world::OperatorCommand> commands;
  world::SensorInput sensors;

  pipeline::Inputs any(Random& random) {
    commands.clear();
    for (std::uint64_t n = random.below(world::kOperatorCommandsMax + 1); n > 0; --n)
      commands.push_back({.id = static_cast<std::uint32_t>(random.next()),
                          .kind = static_cast<world::OperatorCommandKind>(random.below(9)),
                          .argument = any_value(random),
                          .expires = any_instant(random)});
    pipeline::Inputs in{.now = any_instant(random),
                        .dt = any_instant(random) - Instant{},
                        .can = {},
                        .sensors = sensors,
                        .requests = {.arm = random.one_in(2),
                                     .reset = random.one_in(2),
                                     .stop = random.one_in(2),
                                     .emergency_stop = random.one_in(2)},
                        .operator_speed_limit_mps = any_value(random)};
    in.operator_inputs.stop = static_cast<world::StopRequest>(random.below(3));
    if (random.one_in(2))
      in.operator_inputs.joystick = world::Joystick{
          .throttle_cap = any_value(random), .brake = any_value(random), .at = any_instant(random)};
    in.commands = commands;
    in.may_arm = random.one_in(2);
    in.last_run_armed = random.one_in(2);
    in.gnss_byte_at = {sometimes(random), sometimes(random)};
    in.radio_at = sometimes(random);
    in.link = any_link(random);
    in.guardian = any_guardian(random);
    in.computer = {any_value(random), any_value(random), any_value(random)};
    return in;
  }
};

void expect_same(const pipeline::Inputs& a, const pipeline::Inputs& b) {
  // Every member has a place of its own in the record: equal records are equal inputs.
  recorder::TickBytes of_a, of_b;
  const auto bytes_a = recording::to_cdr(record_of(a, {}), of_a);
  const auto bytes_b = recording::to_cdr(record_of(b, {}), of_b);
  EXPECT_TRUE(std::ranges::equal(bytes_a, bytes_b));
  EXPECT_EQ(a.now, b.now);
  EXPECT_EQ(a.dt, b.dt);
  EXPECT_EQ(a.requests.arm, b.requests.arm);
  EXPECT_EQ(a.requests.emergency_stop, b.requests.emergency_stop);
  EXPECT_EQ(a.may_arm, b.may_arm);
  EXPECT_EQ(a.last_run_armed, b.last_run_armed);
  EXPECT_EQ(a.radio_at, b.radio_at);
  EXPECT_EQ(a.gnss_byte_at, b.gnss_byte_at);
  EXPECT_EQ(a.operator_inputs.stop, b.operator_inputs.stop);
  EXPECT_EQ(a.operator_inputs.joystick.has_value(), b.operator_inputs.joystick.has_value());
  EXPECT_EQ(a.link.tx_stalled, b.link.tx_stalled);
  EXPECT_EQ(a.guardian.command.brake_kpa, b.guardian.command.brake_kpa);
  EXPECT_EQ(a.guardian.counters.report, b.guardian.counters.report);
  EXPECT_EQ(a.commands.size(), b.commands.size());
}

TEST(TickInputs, ComeBackAsTheyWere) {
  Random random{17};
  Given given;
  for (int i = 0; i < 500; ++i) {
    const pipeline::Inputs in = given.any(random);
    TickCommands commands;
    const auto again = inputs_of(record_of(in, {}), in.now, {}, given.sensors, commands);
    ASSERT_TRUE(again) << to_string(again.error());
    expect_same(in, *again);
  }
}

TEST(TickInputs, WhatNoCarCanHaveHadIsRefusedByName) {
  const world::SensorInput sensors;
  const auto refusal = [&](void (*spoil)(recorder::TickRecord&)) {
    recorder::TickRecord record;
    spoil(record);
    TickCommands commands;
    const auto in = inputs_of(record, Instant{}, {}, sensors, commands);
    return in ? std::string{} : in.error().place;
  };
  using recorder::TickRecord;
  EXPECT_EQ(refusal([](TickRecord&) {}), "");
  EXPECT_EQ(refusal([](TickRecord& r) { r.requests = 64; }), "requests");
  EXPECT_EQ(refusal([](TickRecord& r) { r.guardian = 4; }), "guardian");
  EXPECT_EQ(refusal([](TickRecord& r) { r.stop = 3; }), "stop");
  EXPECT_EQ(refusal([](TickRecord& r) { r.controller = 6; }), "controller");
  constexpr auto unknown =
      static_cast<std::uint8_t>(static_cast<int>(world::OperatorCommandKind::kSendParameters) + 1);
  EXPECT_EQ(refusal([](TickRecord& r) { append(r, {.kind = unknown}); }), "commands");
}

}  // namespace
}  // namespace pitwall::io
