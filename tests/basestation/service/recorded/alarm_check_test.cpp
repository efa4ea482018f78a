// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/recorded/alarm_check.hpp"

#include <gtest/gtest.h>

#include <random>

#include "basestation/service/messages/evaluator_text.hpp"
#include "basestation/service/messages/message_text.hpp"
#include "protocol/transport/file.hpp"
#include "tests/basestation/healthy_race.hpp"
#include "tests/basestation/replay/race.hpp"

namespace pitwall::service {
namespace {

using recorder::Topic;
using telemetry::field;

// A wall that judges a bad race and records as the real one does: states, inputs, what it tells.
struct LiveWall {
  replay::testing::Recording recording;
  alarms::Evaluator evaluator;
  state::VehicleState vehicle;
  telemetry::Snapshot state = HealthyRace{}.reported.snapshot;
  std::mt19937 random{7};
  Instant now = kStart;
  std::uint64_t revision = 0, lines = 0;

  explicit LiveWall(const std::string& folder) : recording(folder) { begin(); }
  void begin() {
    evaluator = alarms::Evaluator{};
    revision = lines = 0;
    evaluator.tell_inputs([this](const alarms::EvaluatorInput& input, Instant at) {
      recording.text(Topic::kInput, at, input_text(input, at));
    });
    recording.text(Topic::kJudge, now, judge_text(evaluator, true, now));
  }
  bool one_in(unsigned n) { return random() % n == 0; }
  double below(unsigned n) { return static_cast<double>(random() % n); }

  void input(const alarms::EvaluatorInput& input) {
    evaluator.advance(vehicle, now);
    static_cast<void>(evaluator.take(input));
  }
  void packet() {
    if (one_in(40)) state.values[field("tyres.temperature_rear_left")] = 20.0 + below(80);
    if (one_in(40)) state.values[field("wheels.rear_left")] = 48.0 + below(10);
    if (one_in(40)) state.values[field("gnss0.status")] = below(3);
    if (one_in(40)) state.values[field("track.offset")] = one_in(2) ? kUnset : below(4);
    telemetry::GroupSet groups;
    for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
      if (row.direction != telemetry::Direction::kDown || one_in(3)) continue;
      state.at(row.group) = now - milliseconds(static_cast<std::int64_t>(random() % 40));
      groups.add(row.group);
    }
    evaluator.advance(vehicle, now);
    evaluator.receive(now);
    vehicle.update(state, groups);
    recording.state(state, groups, now);
  }
  void act() {
    for (const alarms::ListedAlarm& alarm : evaluator.alarms().active()) {
      using Kind = alarms::AlarmAction::Kind;
      const Kind kind = one_in(3) ? Kind::kShelve : one_in(2) ? Kind::kReset : Kind::kAcknowledge;
      input(alarms::AlarmAction{
          .kind = kind, .alarm = alarm.id, .length = seconds(3), .by = "A", .reason = "test"});
    }
  }
  void publish() {
    evaluator.advance(vehicle, now);
    const alarms::Engine& engine = evaluator.alarms();
    if (engine.revision() != revision) {
      revision = engine.revision();
      recording.text(Topic::kAlarms, now, alarms_text(engine));
    }
    for (const alarms::AlarmEvent& event : engine.history()) {
      if (event.number <= lines) continue;
      lines = event.number;
      recording.text(Topic::kAlarmEvent, now, alarm_event_text(event));
    }
  }
  void run(Duration length) {
    bool silent = false;
    Instant measured{};
    for (const Instant end = now + length; now < end;) {
      now += milliseconds(1 + static_cast<std::int64_t>(random() % 40));
      if (one_in(100)) silent = !silent;
      if (!silent) packet();
      if (one_in(50)) input(alarms::PacketReceived{now - milliseconds(3)});
      if (now - measured >= milliseconds(100)) {
        measured = now;
        input(state::LinkFigures{.received = evaluator.known().link.received,
                                 .down_loss = 0.001 * below(300),
                                 .up_loss = 0.0,
                                 .round_trip_ms = 20.0 + below(200)});
        input(state::BaseFigures{.disk_minutes = 5.0 + below(100)});
      }
      if (one_in(200)) act();
      if (one_in(300)) input(state::Expectations{.round_speed_mps = 50.0 + below(3)});
      publish();
    }
  }
};

TEST(AlarmCheck, FromItsFilesARaceIsJudgedToTheVerySameAlarms) {
  const auto folder = transport::TemporaryFolder::create("pitwall_judge");
  std::string last;
  {
    LiveWall live{folder->path()};
    live.run(seconds(50));  // three segments
    last = alarms_text(live.evaluator.alarms());
  }
  std::vector<std::string> remarks;
  const auto judged = check_alarms(folder->path(), remarks);
  ASSERT_TRUE(judged) << to_string(judged.error());
  EXPECT_TRUE(remarks.empty());
  EXPECT_GT(judged->lists(), 50U);
  EXPECT_GT(judged->lines(), 50U);
  EXPECT_EQ(judged->different(), 0U) << judged->differences().front();
  EXPECT_EQ(alarms_text(judged->watch().alarms()), last);
}

TEST(AlarmCheck, AnotherBeginningOfTheSameRaceIsJudgedByItself) {
  const auto folder = transport::TemporaryFolder::create("pitwall_judge");
  {
    LiveWall live{folder->path()};
    live.run(seconds(10));
    live.begin();
    live.run(seconds(10));
  }
  std::vector<std::string> remarks;
  const auto judged = check_alarms(folder->path(), remarks);
  ASSERT_TRUE(judged);
  EXPECT_EQ(judged->different(), 0U) << judged->differences().front();
}

// The test of the test: one input less, and the lists differ.
TEST(AlarmCheck, AnInputThatWasNotRecordedShows) {
  const auto folder = transport::TemporaryFolder::create("pitwall_judge");
  {
    LiveWall live{folder->path()};
    live.run(seconds(5));
    live.evaluator.tell_inputs({});
    live.evaluator.base({.disk_minutes = 1.0});
    for (int i = 0; i < 300; ++i) {
      live.now += milliseconds(10);
      live.publish();
    }
  }
  std::vector<std::string> remarks;
  const auto judged = check_alarms(folder->path(), remarks);
  ASSERT_TRUE(judged);
  EXPECT_GT(judged->different(), 0U);
  EXPECT_FALSE(judged->differences().empty());
}

TEST(AlarmCheck, AFolderWithoutAJudgeIsRefused) {
  const auto folder = transport::TemporaryFolder::create("pitwall_judge");
  std::vector<std::string> remarks;
  EXPECT_FALSE(check_alarms(folder->path(), remarks));
  replay::testing::record_race(folder->path(), seconds(1));
  EXPECT_FALSE(check_alarms(folder->path(), remarks));
}

}  // namespace
}  // namespace pitwall::service
