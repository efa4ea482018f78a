// SPDX-License-Identifier: Apache-2.0
#include "basestation/inputs/text_command.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/basestation/radio_rig.hpp"

namespace pitwall::inputs {
namespace {

using telemetry::CommandType;
using telemetry::field;

// A car that stands, disarmed, with a healthy link: what slows it passes, and what needs a reason.
struct Pit : RadioRig {
  Pit() {
    set(field("ego.x"), 1.0);
    set(field("ego.vx"), 0.0);
    set(field("mode.stop_latch"), 0.0);
  }
  // What the car was told by this command.
  std::optional<telemetry::DueCommand> arrives(std::string_view line) {
    reported.clear();
    const auto done = execute(line);
    EXPECT_TRUE(done) << line << ": " << (done ? "" : done.error().what);
    if (!done) return std::nullopt;
    run(milliseconds(100));
    if (reported.size() != 1) return std::nullopt;
    return reported.front();
  }
};

TEST(TextCommand, CommandsReachTheCarAsTheyWereMeant) {
  Pit pit;
  pit.run(seconds(1));
  ASSERT_TRUE(pit.execute("take 7"));
  pit.run(milliseconds(100));
  const struct {
    const char* words;
    CommandType type;
    double argument;
  } cases[] = {{"command speed_limit 30.5 because of a test drive", CommandType::kSpeedLimit, 30.5},
               {"  command\tarm  arm because all is well \n", CommandType::kArm, 1},
               {"command track_flag waving_green because we may", CommandType::kTrackFlag, 5},
               {"command sensors_excluded imu1", CommandType::kSensorsExcluded, 8},
               {"command sensors_excluded 3", CommandType::kSensorsExcluded, 3},
               {"command end_run end because it is over", CommandType::kEndRun, 1}};
  for (const auto& c : cases) {
    ASSERT_TRUE(pit.execute("take 7")) << "who holds it renews it";
    const auto due = pit.arrives(c.words);
    ASSERT_TRUE(due) << c.words;
    EXPECT_EQ(due->command.type, c.type);
    EXPECT_NEAR(due->command.argument, c.argument, 0.05);
    pit.car->decide(due->id, telemetry::Outcome::kApplied, pit.now);
    pit.run(milliseconds(100));
    const auto& tickets = pit.base->requests().queue().tickets();
    ASSERT_FALSE(tickets.empty());
    EXPECT_EQ(tickets.back().step, command::Step::kApplied) << c.words;
  }
}

// With the very words that a console is refused with.
TEST(TextCommand, AGateHoldsItBackAsAConsole) {
  Pit pit;
  pit.run(seconds(1));
  ASSERT_TRUE(pit.execute("take 7"));
  const auto text = pit.execute("command speed_limit 30");
  ASSERT_FALSE(text);
  const command::Person by_hand{.console = 7, .name = "Ada"};
  const auto hand = pit.base->requests().execute(
      command::IssueCommand{.type = CommandType::kSpeedLimit, .argument = 30.0}, by_hand, pit.now);
  ASSERT_FALSE(hand);
  EXPECT_EQ(text.error().what, hand.error().what);
  const auto& audit = pit.base->requests().audit().lines();
  EXPECT_NE(audit[audit.size() - 3].result.find("refused: gates: "), std::string::npos)
      << audit[audit.size() - 3].result;
}

TEST(TextCommand, AlarmsAreAcknowledgedAndReset) {
  Pit pit;
  pit.run(seconds(1));
  pit.loses = [](bool, telemetry::PathId) { return true; };
  pit.run(seconds(3));
  const auto lost = *alarms::find_alarm("link_lost");
  const auto state = [&] { return pit.base->evaluator().alarms().state(lost); };
  ASSERT_EQ(state(), alarms::State::kUnack);
  EXPECT_FALSE(pit.execute("ack wheel_slip")) << "is not active";
  ASSERT_TRUE(pit.execute("ack link_lost"));
  EXPECT_EQ(state(), alarms::State::kAcked);
  ASSERT_TRUE(pit.execute("ack all"));
  EXPECT_FALSE(pit.execute("reset wheel_slip"));
}

// One sensor after the other, quicker than the car tells its set: none is forgotten.
TEST(TextCommand, SensorsAreExcludedAndAdmittedOneByOne) {
  Pit pit;
  pit.run(seconds(1));
  ASSERT_TRUE(pit.execute("take 7"));
  EXPECT_FALSE(pit.execute("exclude gnss0")) << "nobody knows what the car excludes";
  pit.set(field("localization.excluded"), 0.0);
  pit.run(seconds(1));
  const struct {
    const char* words;
    double set;
  } cases[] = {{"exclude gnss0", 1},   {"exclude imu1", 9},      {"exclude gnss0", 9},
               {"admit gnss0", 8},     {"exclude wheels", 24},   {"admit imu1", 16},
               {"exclude lidar", 48},  {"exclude camera1", 176}, {"admit wheels", 160},
               {"exclude radar", 416}, {"admit camera1", 288},   {"admit lidar", 256},
               {"exclude imu1", 264},  {"admit radar", 8},       {"exclude wheels", 24},
               {"admit imu1", 16}};
  for (const auto& c : cases) {
    ASSERT_TRUE(pit.execute("take 7"));
    const auto due = pit.arrives(c.words);
    ASSERT_TRUE(due) << c.words;
    EXPECT_EQ(due->command.type, CommandType::kSensorsExcluded);
    EXPECT_EQ(due->command.argument, c.set) << c.words;
    pit.car->decide(due->id, telemetry::Outcome::kApplied, pit.now);
    pit.set(field("localization.excluded"), c.set);
  }
  ASSERT_TRUE(pit.execute("take 7"));
  const auto due = pit.arrives("exclude gnss1");
  ASSERT_TRUE(due);
  EXPECT_EQ(due->command.argument, 18);
  pit.car->decide(due->id, telemetry::Outcome::kRefused, pit.now);
  pit.run(seconds(1));
  ASSERT_TRUE(pit.execute("take 7"));
  const auto next = pit.arrives("exclude imu0");
  ASSERT_TRUE(next);
  EXPECT_EQ(next->command.argument, 20) << "what was refused is not counted in";
  for (const char* wrong : {"exclude", "exclude gnss2", "admit lidar0", "exclude gnss0 gnss1"})
    EXPECT_FALSE(pit.execute(wrong)) << wrong;
}

TEST(TextCommand, AStopIsLatchedAndLetGoByItsChallenge) {
  Pit pit;
  pit.run(seconds(1));
  ASSERT_TRUE(pit.execute("stop emergency"));
  pit.run(milliseconds(100));
  EXPECT_EQ(pit.car->view(pit.now).stop, telemetry::StopLevel::kEmergency);
  EXPECT_FALSE(pit.execute("release")) << "the car has not told its challenge";
  pit.set(field("mode.stop_challenge"), pit.car->view(pit.now).stop_challenge);
  pit.car->standstill(true);
  ASSERT_TRUE(pit.execute("take 1"));
  pit.run(milliseconds(100));
  ASSERT_TRUE(pit.execute("release"));
  pit.run(milliseconds(200));
  EXPECT_EQ(pit.car->view(pit.now).stop, telemetry::StopLevel::kNone);
}

TEST(TextCommand, AJoystickSampleIsOneSample) {
  Pit pit;
  pit.run(seconds(2));
  ASSERT_TRUE(pit.execute("joystick 0.4 0.25"));
  pit.run(milliseconds(60));
  const auto sample = pit.car->view(pit.now).joystick;
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->throttle_cap, 0.4, 0.01);
  EXPECT_NEAR(sample->brake, 0.25, 0.01);
  pit.run(milliseconds(300));
  EXPECT_FALSE(pit.car->view(pit.now).joystick) << "nobody repeats it";
}

TEST(TextCommand, WhatIsNotUnderstoodIsSaidSo) {
  Pit pit;
  const char* const wrong[] = {"",
                               "halt",
                               "stop",
                               "stop now",
                               "stop controlled please",
                               "release it",
                               "take 0",
                               "take 16",
                               "take one",
                               "hand 1 2",
                               "ack",
                               "ack no_such_alarm",
                               "reset all",
                               "command arm arm because",
                               "command",
                               "command speed_limit",
                               "command speed_limit fast",
                               "command speed_limit -1",
                               "command speed_limit 121",
                               "command speed_limit nan",
                               "command fly 1",
                               "command release_stop 7",
                               "joystick 0.5",
                               "joystick 2 0",
                               "joystick nan 0",
                               "command speed_limit 1 2 3"};
  for (const char* const words : wrong) {
    const auto executed = pit.execute(words);
    EXPECT_FALSE(executed) << words;
    EXPECT_FALSE(parse_text_command(words)) << words;
    if (executed) continue;
    EXPECT_EQ(executed.error().place, "operator: " + std::string{words});
  }
  EXPECT_EQ(pit.base->requests().refused(), std::size(wrong));
  EXPECT_EQ(pit.base->requests().queue().issued(), 0U);
}

TEST(TextCommand, WithoutACarNoCommandIsGiven) {
  Pit pit;
  const auto done = pit.execute("command speed_limit 30");
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().what.find("link none"), std::string::npos) << done.error().what;
}

}  // namespace
}  // namespace pitwall::inputs
