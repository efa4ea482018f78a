// SPDX-License-Identifier: Apache-2.0
#include "basestation/command/gates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/basestation/healthy_race.hpp"

namespace pitwall::command {
namespace {

using telemetry::CommandType;
using telemetry::field;

constexpr telemetry::HolderId kConsole = 17;

struct GatePit {
  HealthyRace wall;
  telemetry::HolderId holder = kConsole;

  std::vector<Gate> gates(CommandType type, double argument) {
    return gates_of({.type = type, .argument = argument, .issuer = kConsole}, {},
                    {wall.reported.vehicle, wall.evaluator, holder, wall.now});
  }
  bool passes(CommandType type, double argument) { return all_pass(gates(type, argument)); }
  bool speed(double mps) { return passes(CommandType::kSpeedLimit, mps); }
  // Gates of this speed that do not pass.
  std::vector<GateKind> closed(double mps) {
    std::vector<GateKind> closed;
    for (const Gate& gate : gates(CommandType::kSpeedLimit, mps)) {
      EXPECT_FALSE(gate.text.empty());
      if (!gate.ok) closed.push_back(gate.kind);
    }
    return closed;
  }
  Gate gate(GateKind kind, double mps) {
    for (const Gate& gate : gates(CommandType::kSpeedLimit, mps))
      if (gate.kind == kind) return gate;
    return {};
  }
  void drive_at(double mps) {
    for (const auto index :
         {field("ego.vx"), field("planner.operator_limit"), field("track.target_speed"),
          field("gnss0.speed"), field("gnss1.speed"), field("wheels.front_left"),
          field("wheels.front_right"), field("wheels.rear_left"), field("wheels.rear_right")}) {
      wall.set(index, mps);
    }
  }
};

using GateKinds = std::vector<GateKind>;

// Of a car that was never received, too.
TEST(Gates, SayWhatIsNotKnownInWords) {
  const state::VehicleState nothing;
  alarms::Evaluator evaluator;
  for (const telemetry::CommandRow& row : telemetry::kCommandTable) {
    for (const Gate& gate : gates_of({.type = row.type, .argument = 1.0, .issuer = kConsole}, {},
                                     {nothing, evaluator, 0, kStart})) {
      EXPECT_EQ(gate.text.find("nan"), std::string::npos) << gate.text;
      EXPECT_TRUE(!gate.unit.empty() || !gate.word.empty()) << text_of(gate.kind);
      const bool of_the_base = gate.kind == GateKind::kAuthority ||
                               gate.kind == GateKind::kAlarms || gate.kind == GateKind::kLink;
      EXPECT_EQ(gate.known, of_the_base) << text_of(gate.kind);
    }
  }
}

TEST(Gates, AWarmCarOnAStraightMayGoFourFaster) {
  GatePit pit;
  pit.wall.run(seconds(5));
  EXPECT_EQ(pit.closed(54.0), GateKinds{});
  EXPECT_TRUE(pit.speed(55.0));
  EXPECT_EQ(pit.closed(55.2), GateKinds{GateKind::kStep});
}

// Saba et al.: at 140 mph, tyres of 29 degC, 20 mph more were asked, and a corner came.
TEST(Gates, ThePapersSpinIsRefused) {
  GatePit pit;
  pit.drive_at(from_mph(140));
  pit.wall.tyres(29.0);
  pit.wall.set(field("track.station"), 200.0);  // 100 m before the turn: 1.6 s
  pit.wall.run(seconds(5));
  const GateKinds closed = pit.closed(from_mph(160));
  for (const GateKind kind : {GateKind::kTyres, GateKind::kStep, GateKind::kCorner}) {
    EXPECT_EQ(std::count(closed.begin(), closed.end(), kind), 1) << text_of(kind);
  }
  // Each of the three alone refuses it.
  pit.wall.tyres(85.0);
  pit.wall.run(seconds(10));
  EXPECT_EQ(pit.closed(from_mph(140) + 4.0), GateKinds{GateKind::kCorner});
  pit.wall.set(field("track.station"), 10.0);
  pit.wall.run(seconds(1));
  EXPECT_EQ(pit.closed(from_mph(140) + 4.0), GateKinds{});
  EXPECT_EQ(pit.closed(from_mph(160)), GateKinds{GateKind::kStep});
  pit.wall.tyres(29.0);
  pit.wall.run(milliseconds(500));
  EXPECT_EQ(pit.closed(from_mph(140) + 4.0), GateKinds{GateKind::kTyres});
}

TEST(Gates, AGateShowsItsValueAndItsAge) {
  GatePit pit;
  pit.wall.tyres(29.0);
  pit.wall.run(seconds(1));
  const Gate gate = pit.gate(GateKind::kTyres, 54.0);
  EXPECT_FALSE(gate.ok);
  EXPECT_TRUE(gate.known);
  EXPECT_EQ(gate.value, 29.0);
  EXPECT_EQ(gate.age, milliseconds(30));  // derived just before the newest packet came
  EXPECT_EQ(gate.text, "29.0 degC, 55.8 degC needed for 54.0 m/s");
}

TEST(Gates, WhatIsStaleHasNotPassed) {
  GatePit pit;
  pit.wall.run(seconds(5));
  ASSERT_TRUE(pit.speed(54.0));
  struct Case {
    telemetry::Group silent;
    GateKind closed;
  };
  for (const Case& one : {Case{telemetry::Group::kTyres, GateKind::kTyres},
                          Case{telemetry::Group::kFlags, GateKind::kFlag},
                          Case{telemetry::Group::kFuel, GateKind::kFuel},
                          Case{telemetry::Group::kPlanner, GateKind::kStep},
                          Case{telemetry::Group::kTrack, GateKind::kCorner},
                          Case{telemetry::Group::kMode, GateKind::kStop}}) {
    pit.wall.comes = [&](telemetry::Group group) { return group != one.silent; };
    pit.wall.run(seconds(8));
    const Gate gate = pit.gate(one.closed, 54.0);
    EXPECT_FALSE(gate.ok) << text_of(one.closed);
    EXPECT_FALSE(gate.known) << text_of(one.closed);
    EXPECT_GT(gate.age, seconds(7)) << text_of(one.closed);
    EXPECT_EQ(gate.text.find("too old"), 0U) << gate.text;
    pit.wall.comes = [](telemetry::Group) { return true; };
    pit.wall.run(seconds(5));
  }
}

TEST(Gates, SlowerPassesWhateverElseIs) {
  GatePit pit;
  pit.wall.tyres(-10.0);
  pit.wall.set(field("flags.track_acted_on"), 7.0);
  pit.wall.set(field("fuel.level"), 0.0);
  pit.wall.set(field("track.station"), 400.0);
  pit.wall.set(field("mode.stop_latch"), 1.0);
  pit.wall.link.down_loss = 0.5;
  pit.wall.run(seconds(5));
  ASSERT_EQ(pit.wall.evaluator.link_state(), state::LinkState::kDegraded);
  EXPECT_TRUE(pit.speed(50.0));
  EXPECT_TRUE(pit.speed(0.0));
  EXPECT_FALSE(pit.speed(50.1));
  pit.wall.comes = [](telemetry::Group group) { return group != telemetry::Group::kPlanner; };
  pit.wall.run(seconds(5));
  EXPECT_TRUE(pit.speed(50.0));
  pit.wall.packets = false;
  pit.wall.run(seconds(1));
  EXPECT_FALSE(pit.speed(0.0));  // there is no way to the car
}

// A faster speed never has fewer closed gates than a slower one.
TEST(Gates, FasterIsNeverEasier) {
  std::mt19937 random{5};
  const auto draw = [&](double from, double to) {
    return from + (to - from) * static_cast<double>(random() % 1'000) / 1'000.0;
  };
  for (int i = 0; i < 30; ++i) {
    GatePit pit;
    pit.drive_at(draw(20, 70));
    pit.wall.tyres(draw(10, 100));
    pit.wall.set(field("track.station"), draw(0, 2'400));
    pit.wall.set(field("flags.track_acted_on"), static_cast<double>(random() % 8));
    pit.wall.set(field("fuel.level"), draw(0, 20));
    pit.wall.run(seconds(3));
    std::size_t before = 0;
    for (double mps = 0; mps < 110; mps += 2.5) {
      const std::size_t closed = pit.closed(mps).size();
      EXPECT_GE(closed, before) << mps;
      before = closed;
    }
  }
}

TEST(Gates, AHighAlarmOrALatchedStopBarsMore) {
  GatePit pit;
  pit.wall.set(field("mode.stop_latch"), 1.0);
  pit.wall.run(seconds(1));
  EXPECT_EQ(pit.closed(54.0), (GateKinds{GateKind::kStop, GateKind::kAlarms}));
  EXPECT_FALSE(can_be_overridden(GateKind::kStop));
}

TEST(Gates, YellowAllowsTheCautionSpeed) {
  GatePit pit;
  pit.drive_at(18.0);
  pit.wall.set(field("flags.track"), 3.0);
  pit.wall.set(field("flags.track_acted_on"), 3.0);
  pit.wall.run(seconds(5));
  EXPECT_TRUE(pit.speed(22.0));
  EXPECT_EQ(pit.closed(22.5), GateKinds{GateKind::kFlag});
}

TEST(Gates, OnlyTheHolderCommands) {
  GatePit pit;
  pit.wall.run(seconds(5));
  for (const auto other : {telemetry::HolderId{0}, telemetry::HolderId{18}}) {
    pit.holder = other;
    EXPECT_EQ(pit.closed(40.0), GateKinds{GateKind::kAuthority});
    EXPECT_TRUE(pit.passes(CommandType::kSendParameters, 1.0));  // needs none
  }
}

TEST(Gates, ALessRestrictiveFlagNeedsRaceControl) {
  GatePit pit;
  pit.wall.set(field("flags.track"), 3.0);
  pit.wall.set(field("flags.track_acted_on"), 3.0);
  pit.wall.run(seconds(5));
  EXPECT_TRUE(pit.passes(CommandType::kTrackFlag, 1.0));   // red at any time
  EXPECT_FALSE(pit.passes(CommandType::kTrackFlag, 4.0));  // green is not ours to give
  pit.wall.set(field("flags.track"), 4.0);
  pit.wall.run(seconds(1));
  EXPECT_TRUE(pit.passes(CommandType::kTrackFlag, 4.0));
}

TEST(Gates, AReleaseWantsACarThatStands) {
  GatePit pit;
  pit.wall.run(seconds(2));
  EXPECT_FALSE(pit.passes(CommandType::kReleaseStop, 77.0));
  pit.drive_at(0.0);
  pit.wall.run(seconds(2));
  EXPECT_TRUE(pit.passes(CommandType::kReleaseStop, 77.0));
  // Slow enough, but the car waits until it has stood for a while before it opens its latch.
  pit.wall.set(field("ego.vx"), 0.0);
  for (const double stands : {0.0, 1.0}) {
    pit.wall.set(field("wheels.standstill"), stands);
    pit.wall.run(seconds(1));
    EXPECT_EQ(pit.passes(CommandType::kReleaseStop, 1.0), stands == 1.0);
  }
}

}  // namespace
}  // namespace pitwall::command
