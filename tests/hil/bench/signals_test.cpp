// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/signals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "tests/hil/bench/flying_lap.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::bench {
namespace {

double value(const SignalValues& values, Signal signal) {
  return values[static_cast<std::size_t>(signal)];
}

Rig standing_rig() {
  scenario::Scenario s = lap().scenario;
  s.start = {.s_m = 600.0, .n_m = 1.5};
  auto rig = Rig::build(s, lap().setup.track);
  EXPECT_TRUE(rig);
  return *std::move(rig);
}

TEST(Signals, EachHasItsOwnName) {
  const std::set<std::string_view> names(kSignalNames.begin(), kSignalNames.end());
  EXPECT_EQ(names.size(), kSignals);
  EXPECT_EQ(names.count(""), 0u);
  ASSERT_EQ(signal_names().size(), kSignals + world::kMonitors);
  EXPECT_EQ(signal_names()[kSignals], "seen_message_age");
  EXPECT_EQ(signal_names().back(), "seen_module");
  const auto name = [](Signal signal) { return kSignalNames[static_cast<std::size_t>(signal)]; };
  EXPECT_EQ(name(Signal::kSpeed), "speed_mps");
  EXPECT_EQ(name(Signal::kWallGap), "wall_gap_m");
  EXPECT_EQ(name(Signal::kSteering), "steering_motor_deg");
  EXPECT_EQ(name(Signal::kTrackFlag), "track_flag");
  EXPECT_EQ(name(Signal::kFramesLost), "frames_lost");
  EXPECT_EQ(name(Signal::kMode), "mode");
  EXPECT_EQ(name(Signal::kYawError), "yaw_error_rad");
  EXPECT_EQ(name(Signal::kSideSlip), "side_slip_deg");
}

TEST(Signals, AreTheTruthOfTheRig) {
  const Rig rig = standing_rig();
  const CarReport car{.mode = 3.0,
                      .gate_refusals = 4.0,
                      .bus_refusals = 5.0,
                      .x_m = rig.truth().x_m + 3.0,
                      .y_m = rig.truth().y_m - 4.0,
                      .yaw_rad = rig.truth().yaw_rad - 6.0};
  const SignalValues v = observe({.rig = rig, .car = car, .line_offset_m = 2.0, .frames_lost = 7});
  EXPECT_NEAR(value(v, Signal::kStation), 600.0, 0.01);
  EXPECT_NEAR(value(v, Signal::kOffset), 1.5, 0.01);
  EXPECT_NEAR(value(v, Signal::kAbsCrossTrack), 0.5, 0.01) << "against the line, not the track";
  EXPECT_EQ(value(v, Signal::kSpeed), 0.0);
  EXPECT_EQ(value(v, Signal::kContact), 0.0);
  EXPECT_EQ(value(v, Signal::kWallGap),
            std::min(rig.road().wall_gap_left_m, rig.road().wall_gap_right_m));
  EXPECT_EQ(value(v, Signal::kMode), 3.0);
  EXPECT_EQ(value(v, Signal::kGateRefusals), 4.0);
  EXPECT_EQ(value(v, Signal::kBusRefusals), 5.0);
  EXPECT_EQ(value(v, Signal::kFramesLost), 7.0);
  EXPECT_NEAR(value(v, Signal::kPositionError), 5.0, 1e-9);
  EXPECT_NEAR(value(v, Signal::kYawError), 2.0 * std::numbers::pi - 6.0, 1e-9)
      << "the short way round";
}

TEST(Signals, WhatAMonitorSeesIsKnownWhereTheCarIsInTheSameProcess) {
  const Rig rig = standing_rig();
  world::MonitorSet seen;
  seen.add(world::Monitor::kCounter);
  const SignalValues known = observe({.rig = rig, .car = {.seen = seen}});
  const SignalValues unknown = observe({.rig = rig, .car = {}});
  for (std::size_t m = 0; m < world::kMonitors; ++m) {
    const bool sees = m == static_cast<std::size_t>(world::Monitor::kCounter);
    EXPECT_EQ(known[kSignals + m], sees ? 1.0 : 0.0);
    EXPECT_TRUE(std::isnan(unknown[kSignals + m])) << "by telemetry nobody says so";
  }
}

TEST(Signals, TheLiveBenchRefusesWhatOnlyLockstepCanJudge) {
  scenario::Scenario s = lap().scenario;
  EXPECT_FALSE(unjudged_by(BenchMode::kLive, s));
  s.expect.push_back({.name = "file.yaml:9:5",
                      .kind = grading::Kind::kDetects,
                      .condition = {"seen_counter", grading::Op::kEqual, 1.0},
                      .limit = seconds(1),
                      .from = at_s(1),
                      .to = at_s(2)});
  EXPECT_FALSE(unjudged_by(BenchMode::kLockstep, s));
  const auto problem = unjudged_by(BenchMode::kLive, s);
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->place, "file.yaml:9:5");
  const auto expectations = expectations_of(s);
  ASSERT_TRUE(expectations) << to_string(expectations.error());
  EXPECT_EQ(expectations->back().kind, grading::Kind::kDetects);
  EXPECT_EQ(expectations->back().limit, seconds(1));
  s.expect.back() = {.name = "file.yaml:9:6",
                     .kind = grading::Kind::kAfter,
                     .condition = {"speed_mps", grading::Op::kLess, 1.0},
                     .trigger = {"seen_counter", grading::Op::kEqual, 1.0},
                     .limit = seconds(1)};
  EXPECT_TRUE(unjudged_by(BenchMode::kLive, s)) << "the trigger";
}

TEST(Signals, LiveTheCarsOwnFileSaysWhatLooksInItsClouds) {
  scenario::Scenario s;
  s.name = "by_rays";
  EXPECT_FALSE(unjudged_by(BenchMode::kLive, s));
  s.lidars = scenario::LidarKind::kRays;
  EXPECT_FALSE(unjudged_by(BenchMode::kLive, s));
  s.lidars = scenario::LidarKind::kRaysClusters;
  EXPECT_FALSE(unjudged_by(BenchMode::kLockstep, s));
  const auto problem = unjudged_by(BenchMode::kLive, s);
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->place, "by_rays");
}

TEST(Signals, AreNumbersBeforeTheCarHasSpoken) {
  const Rig rig = standing_rig();
  const SignalValues v = observe({.rig = rig, .car = {}});
  for (std::size_t i = 0; i < kSignals; ++i) {
    if (i == static_cast<std::size_t>(Signal::kOffPath)) continue;  // it holds no path yet
    EXPECT_TRUE(std::isfinite(v[i])) << kSignalNames[i];
  }
  EXPECT_EQ(value(v, Signal::kMode), 0.0);
  EXPECT_EQ(value(v, Signal::kPositionError), 0.0);
  EXPECT_EQ(value(v, Signal::kSideSlip), 0.0) << "a car that stands does not slip";
}

TEST(Signals, ASilentCarSaysNothingAndTheTruthGoesOn) {
  const Rig rig = standing_rig();
  const SignalValues spoken = observe({.rig = rig, .car = {}});
  const SignalValues silent = observe({.rig = rig, .car = {.silent = true}});
  std::set<std::string_view> unsaid;
  for (std::size_t i = 0; i < kSignals; ++i) {
    if (std::isnan(silent[i]))
      unsaid.insert(kSignalNames[i]);
    else
      EXPECT_EQ(silent[i], spoken[i]) << kSignalNames[i];
  }
  EXPECT_EQ(unsaid,
            (std::set<std::string_view>{"mode", "gate_refusals", "bus_refusals", "position_error_m",
                                        "yaw_error_rad", "identity", "differing_id", "stop_cause",
                                        "operator_limit_mps", "off_path_m"}));
}

// The car's reason is compared with the air's own record.
TEST(Signals, AStopForTheBaseStationNeedsAGapThatExplainsIt) {
  const Rig rig = standing_rig();
  const auto unexplained = [&](safety::Cause cause, Duration gap) {
    const CarReport car{.cause = static_cast<double>(cause)};
    const SignalValues v = observe({.rig = rig,
                                    .car = car,
                                    .radio_gap = milliseconds(20),
                                    .radio_gap_max = gap,
                                    .radio_limit = seconds(3)});
    EXPECT_EQ(value(v, Signal::kRadioGap), 0.02);
    EXPECT_EQ(value(v, Signal::kRadioGapMax), gap.seconds());
    return value(v, Signal::kRadioStopUnexplained);
  };
  EXPECT_EQ(unexplained(safety::Cause::kRadioLost, seconds(2)), 1.0);
  EXPECT_EQ(unexplained(safety::Cause::kRadioLost, milliseconds(3'001)), 0.0);
  EXPECT_EQ(unexplained(safety::Cause::kOperatorStop, seconds(2)), 0.0);
  EXPECT_EQ(unexplained(safety::Cause::kNone, seconds(2)), 0.0);
}

TEST(Signals, TheLimitOfTheGapIsThatOfTheCarFile) {
  pipeline::CarParams params;
  EXPECT_EQ(radio_limit_of(params), seconds(3));
  params.radio.link_loss.no_comm_drives = false;
  EXPECT_EQ(radio_limit_of(params), params.radio.link_loss.no_comm);
}

TEST(Signals, AnExpectationOfAScenarioIsGradedInItsWindow) {
  scenario::Scenario s = lap().scenario;
  s.duration = seconds(50);
  s.expect = {{.name = "f.yaml:1:1",
               .kind = grading::Kind::kWithin,
               .condition = {"speed_mps", grading::Op::kGreaterEqual, 12.5},
               .from = at_s(10),
               .to = at_s(30)},
              {.name = "f.yaml:2:1",
               .kind = grading::Kind::kNever,
               .condition = {"mode", grading::Op::kEqual, 4.0},
               .from = at_s(20)}};
  const auto rows = expectations_of(s);
  ASSERT_TRUE(rows);
  ASSERT_EQ(rows->size(), 2u);
  const grading::Expectation& within = (*rows)[0];
  EXPECT_EQ(within.name, "f.yaml:1:1");
  EXPECT_EQ(within.kind, grading::Kind::kWithin);
  EXPECT_EQ(within.condition.signal, "speed_mps");
  EXPECT_EQ(within.condition.op, grading::Op::kGreaterEqual);
  EXPECT_EQ(within.condition.number, 12.5);
  EXPECT_EQ(within.from, Instant{} + seconds(10));
  EXPECT_EQ(within.to, Instant{} + seconds(30));
  EXPECT_EQ(within.limit, seconds(20));
  EXPECT_EQ((*rows)[1].kind, grading::Kind::kNever);
  EXPECT_EQ((*rows)[1].to, Instant{} + seconds(50)) << "no end means the end of the run";
}

TEST(Signals, AnUnknownSignalIsRefusedWithItsPlace) {
  scenario::Scenario s = lap().scenario;
  s.expect = {{.name = "f.yaml:7:3", .condition = {"speed_of_light", grading::Op::kLess, 1.0}}};
  const auto signal = expectations_of(s);
  ASSERT_FALSE(signal);
  EXPECT_EQ(signal.error().place, "f.yaml:7:3");
  EXPECT_NE(signal.error().what.find("speed_of_light"), std::string::npos);
  s.expect = {{.name = "f.yaml:8:3",
               .kind = grading::Kind::kUntil,
               .condition = {"mode", grading::Op::kEqual, 2.0},
               .release = {"speed_of_sound", grading::Op::kLess, 1.0},
               .limit = seconds(1)}};
  const auto release = expectations_of(s);
  ASSERT_FALSE(release);
  EXPECT_EQ(release.error().place, "f.yaml:8:3");
  EXPECT_NE(release.error().what.find("speed_of_sound"), std::string::npos);
}

TEST(Signals, AWindowThatBeginsAfterTheRunOrIsTooShortIsRefused) {
  scenario::Scenario s = lap().scenario;
  s.duration = seconds(50);
  s.expect = {{.name = "f.yaml:9:3", .condition = {"mode", grading::Op::kEqual, 2.0}}};
  s.expect[0].from = at_s(60);
  const auto rows = expectations_of(s);
  ASSERT_FALSE(rows) << "it could never be judged";
  EXPECT_EQ(rows.error().place, "f.yaml:9:3");
  s.expect[0].from = at_s(45);
  s.expect[0].kind = grading::Kind::kRate;
  s.expect[0].span = seconds(5);
  EXPECT_TRUE(expectations_of(s));
  s.expect[0].span = seconds(6);
  EXPECT_FALSE(expectations_of(s));
}

}  // namespace
}  // namespace pitwall::bench
