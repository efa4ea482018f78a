// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/virtual_station.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "protocol/telemetry/delivery/event_content.hpp"
#include "tests/hil/bench/flying_lap.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::bench {
namespace {

using faults::BenchFault;
using faults::BenchFaultKind;

// A car that stands, with nothing but its radio.
class Radio {
 public:
  explicit Radio(std::vector<BenchFault> faults = {},
                 std::vector<scenario::OperatorText> words = {},
                 std::vector<scenario::RadioPath> paths = {}) {
    scenario_.operator_texts = std::move(words);
    scenario_.radio = std::move(paths);
    FaultPlan plan;
    for (const BenchFault& fault : faults)
      (is_radio_fault(fault.kind) ? plan.radio : plan.processes).push_back(fault);
    station_ = std::make_unique<VirtualStation>(scenario_, lap().setup, plan);
    out_->chosen.standstill = true;
  }

  // True while the car heard its base within a second.
  bool run_to(std::int64_t end_ms, bool car_runs = true) {
    for (; ms_ <= end_ms; ++ms_) {
      if (ms_ % 10 == 0 && car_runs) tick(at_ms(ms_));
      station_->advance(at_ms(ms_));
    }
    return alive_at_ && at_ms(end_ms) - *alive_at_ < seconds(1);
  }

  VirtualStation& station() { return *station_; }
  const std::optional<Instant>& alive_at() const { return alive_at_; }
  const pipeline::Inputs& inputs() const { return *in_; }
  pipeline::Outputs& outputs() { return *out_; }
  std::vector<world::OperatorCommand> received;  // of the operator, by the pipeline

 private:
  void tick(Instant now) {
    in_.emplace(pipeline::Inputs{
        .now = now, .dt = milliseconds(10), .can = {}, .sensors = none_, .requests = {}});
    station_->receive(*in_);
    alive_at_ = in_->radio_at;
    out_->answers = {};
    for (const world::OperatorCommand& command : in_->commands) {
      received.push_back(command);
      EXPECT_TRUE(out_->answers.push(
          {.id = command.id, .answer = world::CommandAnswer::kApplied, .at = now}));
    }
    ++car_->ticks;
    station_->publish(*car_, *in_, *out_, {});
  }

  scenario::Scenario scenario_ = lap().scenario;
  std::unique_ptr<VirtualStation> station_;
  std::unique_ptr<pipeline::Car> car_ = std::make_unique<pipeline::Car>();
  std::unique_ptr<pipeline::Outputs> out_ = std::make_unique<pipeline::Outputs>();
  world::SensorInput none_;
  std::optional<pipeline::Inputs> in_;
  std::optional<Instant> alive_at_;
  std::int64_t ms_ = 0;
};

// Age of the car's mode as the base has it.
Duration age_at_base(Radio& radio, std::int64_t ms) {
  const telemetry::StationEndpoint& base = radio.station().base()->link().endpoint();
  return radio.station().base_time(at_ms(ms)) - base.state().at(telemetry::Group::kMode);
}

scenario::OperatorText say(std::int64_t ms, const std::string& text) {
  return {milliseconds(ms), text};
}

TEST(VirtualStation, IsHeardWithinAHandshakeAndFiftyTimesASecond) {
  Radio radio;
  EXPECT_TRUE(radio.run_to(500));
  EXPECT_TRUE(radio.station().car().schema_agrees());
  radio.run_to(10'000);
  const auto report = radio.station().car().report(at_ms(10'000));
  EXPECT_GT(report.association.opened, 450u);
  EXPECT_EQ(report.sessions, 1u);
  EXPECT_LT(at_ms(10'000) - *radio.alive_at(), milliseconds(50));
}

TEST(VirtualStation, EveryFaultSilencesItForItsTimeAndNoLonger) {
  for (const auto kind : {BenchFaultKind::kBaseKilled, BenchFaultKind::kBasePaused,
                          BenchFaultKind::kBaseStationSilent, BenchFaultKind::kRadioDown}) {
    Radio radio({{.kind = kind, .start = at_ms(5'000), .duration = seconds(5)}});
    EXPECT_TRUE(radio.run_to(4'990));
    EXPECT_FALSE(radio.run_to(9'900)) << faults::row_of(kind).name;
    EXPECT_GE(*radio.alive_at(), at_ms(4'850)) << faults::row_of(kind).name;
    EXPECT_LT(*radio.alive_at(), at_ms(5'010)) << faults::row_of(kind).name;
    EXPECT_TRUE(radio.run_to(10'400)) << "back within a handshake " << faults::row_of(kind).name;
    EXPECT_GT(*radio.alive_at(), at_ms(10'300)) << "of itself, not of before";
    const bool restarted = kind == BenchFaultKind::kBaseKilled;
    EXPECT_GE(radio.station().car().report(at_ms(10'400)).sessions, restarted ? 2u : 1u)
        << faults::row_of(kind).name;
  }
}

// A queue of 400 ms is alive at 50 Hz, and yet what comes out of it is old.
TEST(VirtualStation, WhatComesOutOfALongQueueIsAsOldAsItIs) {
  Radio radio({{.kind = BenchFaultKind::kRadioDelay,
                .start = at_ms(5'000),
                .duration = seconds(10),
                .value = 0.4}});
  radio.run_to(4'990);
  EXPECT_LT(at_ms(4'990) - *radio.alive_at(), milliseconds(100));
  radio.run_to(8'000);
  EXPECT_GE(at_ms(8'000) - *radio.alive_at(), milliseconds(400));
}

TEST(VirtualStation, ACarThatBeginsAnewHasHeardNothing) {
  Radio radio;
  radio.run_to(1'000);
  radio.run_to(2'000, false);
  radio.station().restart_car();
  EXPECT_FALSE(radio.station().car().view(at_ms(2'000)).alive_at);
  EXPECT_TRUE(radio.run_to(2'500));
}

TEST(VirtualStation, ACommandIsAppliedOnceAndItsFateIsKnown) {
  Radio radio({}, {say(1'000, "take 1"), say(1'500, "command speed_limit 30 because of a test"),
                   say(1'600, "command track_flag 3 because of a test"),
                   say(1'700, "command end_run 1 because of a test")});
  radio.run_to(3'000);
  ASSERT_EQ(radio.received.size(), 2u) << "the end of the run is the adapter's own business";
  EXPECT_EQ(radio.received[0].kind, world::OperatorCommandKind::kSpeedLimit);
  EXPECT_NEAR(radio.received[0].argument, 30.0, 0.05);
  EXPECT_TRUE(radio.station().refusals().empty());
  ASSERT_EQ(radio.station().commands().size(), 3u);
  for (const telemetry::CommandId id : radio.station().commands()) {
    const auto* progress = radio.station().base()->link().endpoint().progress(id);
    ASSERT_NE(progress, nullptr);
    EXPECT_EQ(progress->outcome, telemetry::Outcome::kApplied);
  }
}

TEST(VirtualStation, WhatTheOperatorSaysInVainIsTold) {
  Radio radio({}, {say(1'000, "take 1"), say(1'100, "take 2")});
  radio.run_to(2'000);
  ASSERT_EQ(radio.station().refusals().size(), 1u);
  EXPECT_NE(radio.station().refusals()[0].find("take 2"), std::string::npos);
}

TEST(VirtualStation, AStopReachesThePipelineAndHoldsOverARestartOfTheBase) {
  Radio radio(
      {{.kind = BenchFaultKind::kBaseKilled, .start = at_ms(2'000), .duration = seconds(1)}},
      {say(1'000, "stop emergency")});
  radio.run_to(990);
  EXPECT_EQ(radio.inputs().operator_inputs.stop, world::StopRequest::kNone);
  radio.run_to(1'100);
  EXPECT_EQ(radio.inputs().operator_inputs.stop, world::StopRequest::kEmergency);
  radio.run_to(5'000);
  EXPECT_EQ(radio.inputs().operator_inputs.stop, world::StopRequest::kEmergency);
}

TEST(VirtualStation, ABaseThatMovesIsFollowedThereAndBack) {
  Radio radio(
      {{.kind = BenchFaultKind::kBaseMoved, .start = at_ms(2'000), .duration = seconds(3)}});
  for (std::int64_t ms = 500; ms <= 8'000; ms += 100) {
    ASSERT_TRUE(radio.run_to(ms)) << ms;
    EXPECT_LT(at_ms(ms) - *radio.alive_at(), milliseconds(300)) << ms;
    EXPECT_LT(age_at_base(radio, ms), milliseconds(300)) << ms;
  }
  const auto report = radio.station().car().report(at_ms(8'000));
  EXPECT_EQ(report.association.roams, 2U);
  EXPECT_EQ(report.sessions, 1U);
}

TEST(VirtualStation, ASpareBaseTakesOverWithinTwoSecondsOfItsStart) {
  for (const std::int64_t away_ms : {100, 1'000, 5'000, 60'000}) {
    Radio radio(
        {{.kind = BenchFaultKind::kBaseMoved, .start = at_ms(2'000), .duration = seconds(9)},
         {.kind = BenchFaultKind::kBaseReplaced,
          .start = at_ms(4'000),
          .duration = milliseconds(away_ms)}});
    const std::int64_t there_ms = 4'000 + away_ms;
    radio.run_to(there_ms - 1);
    EXPECT_EQ(radio.station().base(), nullptr);
    const auto roams = radio.station().car().report(at_ms(there_ms)).association.roams;
    radio.run_to(there_ms + 2'000);
    EXPECT_GT(*radio.alive_at(), at_ms(there_ms)) << away_ms;
    EXPECT_LT(age_at_base(radio, there_ms + 2'000), milliseconds(100)) << away_ms;
    const auto report = radio.station().car().report(at_ms(there_ms + 2'000));
    EXPECT_EQ(report.association.roams, roams + 1) << away_ms;
    EXPECT_EQ(report.sessions, 2U) << away_ms;
  }
}

// What the car has latched is the car's, what an operator may do is the base's.
TEST(VirtualStation, AtASpareBaseTheStopHoldsAndTheAuthorityIsTakenAnew) {
  Radio radio(
      {{.kind = BenchFaultKind::kBaseReplaced, .start = at_ms(3'000), .duration = seconds(1)}},
      {say(1'000, "take 1"), say(1'500, "stop controlled"), say(7'000, "command speed_limit 20"),
       say(7'100, "take 1"), say(8'000, "release because of a test")});
  radio.run_to(6'900);
  EXPECT_TRUE(radio.station().refusals().empty());
  EXPECT_EQ(radio.inputs().operator_inputs.stop, world::StopRequest::kControlled);
  radio.run_to(7'900);
  EXPECT_TRUE(radio.received.empty());
  EXPECT_TRUE(radio.station().commands().empty());
  ASSERT_EQ(radio.station().refusals().size(), 1U);
  EXPECT_NE(radio.station().refusals()[0].find("gate authority: nobody holds it"),
            std::string::npos);
  EXPECT_EQ(radio.inputs().operator_inputs.stop, world::StopRequest::kControlled);
  radio.run_to(9'000);
  EXPECT_EQ(radio.inputs().operator_inputs.stop, world::StopRequest::kNone);
  EXPECT_EQ(radio.station().refusals().size(), 1U);
}

TEST(VirtualStation, ABaseThatBeginsAgainKnowsTheNewestStampAndASpareOneDoesNot) {
  for (const auto kind : {BenchFaultKind::kBaseKilled, BenchFaultKind::kBaseReplaced}) {
    Radio radio({{.kind = kind, .start = at_ms(2'000), .duration = seconds(1)}});
    radio.run_to(1'999);
    const telemetry::Stamp before = radio.station().base()->link().endpoint().newest_stamp();
    EXPECT_GT(before, 0U);
    radio.run_to(2'999);
    EXPECT_EQ(radio.station().base(), nullptr);
    radio.run_to(3'000);  // and nothing was heard yet
    EXPECT_EQ(radio.station().base()->link().endpoint().newest_stamp(),
              kind == BenchFaultKind::kBaseKilled ? before : 0U);
    radio.run_to(5'000);
    const telemetry::Stamp after = radio.station().base()->link().endpoint().newest_stamp();
    EXPECT_GT(after, before);
    radio.station().restart_car();
    radio.run_to(7'000);  // a car looks for a second at the first address alone
    EXPECT_GT(radio.station().base()->link().endpoint().newest_stamp(), after)
        << "nor does a car go back";
    EXPECT_EQ(radio.station()
                  .base()
                  ->link()
                  .report(radio.station().base_time(at_ms(7'000)))
                  .association.refused[static_cast<std::size_t>(telemetry::Refusal::kOldStamp)],
              0U);
  }
}

TEST(VirtualStation, AJoystickLivesOnlyWhileItSpeaks) {
  std::vector<scenario::OperatorText> words;
  for (int ms = 1'000; ms < 2'000; ms += 50) words.push_back(say(ms, "joystick 0.4 0.1"));
  Radio radio({}, words);
  radio.run_to(1'500);
  ASSERT_TRUE(radio.inputs().operator_inputs.joystick);
  EXPECT_NEAR(radio.inputs().operator_inputs.joystick->throttle_cap, 0.4, 0.01);
  EXPECT_LE(radio.inputs().operator_inputs.joystick->at, at_ms(1'500));
  radio.run_to(2'300);
  EXPECT_FALSE(radio.inputs().operator_inputs.joystick);
}

TEST(VirtualStation, EventsArriveEachOnceThroughFades) {
  Radio radio({}, {}, {{link::bursty(0.3, milliseconds(120), 32'000.0, milliseconds(15)), {}}});
  radio.run_to(1'000);
  for (int lap = 1; lap <= 20; ++lap) {
    radio.outputs().received.race_control.ever_received = true;
    radio.outputs().received.race_control.lap_count = static_cast<std::uint8_t>(lap);
    radio.run_to(1'000 + lap * 100);
  }
  radio.run_to(6'000);
  int next = 1;
  for (const telemetry::Event& event : radio.station().events())
    if (event.kind == telemetry::EventKind::kLap) {
      const auto content = telemetry::content_of(event);
      ASSERT_TRUE(content);
      EXPECT_EQ(std::get<telemetry::LapEvent>(*content).number, next++);
    }
  EXPECT_EQ(next, 21);
}

TEST(VirtualStation, OneSeedIsOneRun) {
  const auto figures = [](std::uint64_t) {
    Radio radio({}, {}, {{link::bursty(0.3, milliseconds(120), 32'000.0, milliseconds(15)), {}}});
    radio.run_to(5'000);
    const auto report = radio.station().car().report(at_ms(5'000));
    return std::tuple{report.association.opened, report.paths[0].spent.bytes, radio.alive_at()->ns,
                      radio.station().channel().longest_silence(at_ms(5'000)).ns};
  };
  EXPECT_EQ(figures(1), figures(1));
}

}  // namespace
}  // namespace pitwall::bench
