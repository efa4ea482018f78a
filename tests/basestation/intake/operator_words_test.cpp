// SPDX-License-Identifier: Apache-2.0
#include "basestation/intake/operator_words.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/basestation/radio_rig.hpp"

namespace pitwall::intake {
namespace {

using telemetry::CommandType;
using telemetry::field;

struct Pit : RadioRig {
  Pit() { set(field("ego.x"), 1.0); }

  Result<Obeyed, Problem> say(std::string_view words) { return station->obey(words, now); }
  // What the car was told by this command.
  std::optional<telemetry::DueCommand> arrives(std::string_view words) {
    if (const auto obeyed = say(words); !obeyed || !obeyed->command) return std::nullopt;
    told.clear();
    run(milliseconds(100));
    if (told.size() != 1) return std::nullopt;
    return told.front();
  }
};

TEST(OperatorWords, CommandsReachTheCarAsTheyWereMeant) {
  Pit pit;
  pit.run(seconds(1));
  ASSERT_TRUE(pit.say("take 7"));
  pit.run(milliseconds(100));
  const struct {
    const char* words;
    CommandType type;
    double argument;
  } cases[] = {{"command speed_limit 30.5", CommandType::kSpeedLimit, 30.5},
               {"  command\tarm  arm \n", CommandType::kArm, 1},
               {"command role attacker", CommandType::kRole, 2},
               {"command sensors_excluded imu1", CommandType::kSensorsExcluded, 8},
               {"command sensors_excluded 3", CommandType::kSensorsExcluded, 3},
               {"command race_line 4", CommandType::kRaceLine, 4}};
  for (const auto& c : cases) {
    ASSERT_TRUE(pit.say("take 7")) << "who holds it renews it";
    const auto due = pit.arrives(c.words);
    ASSERT_TRUE(due) << c.words;
    EXPECT_EQ(due->command.type, c.type);
    EXPECT_NEAR(due->command.argument, c.argument, 0.05);
    pit.car->decide(due->id, telemetry::Outcome::kApplied, pit.now);
    pit.run(milliseconds(100));
    ASSERT_FALSE(pit.station->commands().empty());
    EXPECT_EQ(pit.station->commands().back().fate, telemetry::Outcome::kApplied) << c.words;
  }
}

// One sensor after the other, quicker than the car tells its set: none is forgotten.
TEST(OperatorWords, SensorsAreExcludedAndAdmittedOneByOne) {
  Pit pit;
  pit.run(seconds(1));
  ASSERT_TRUE(pit.say("take 7"));
  EXPECT_FALSE(pit.say("exclude gnss0")) << "nobody knows what the car excludes";
  pit.set(field("localization.excluded"), 0.0);
  pit.run(seconds(1));
  const struct {
    const char* words;
    double set;
  } cases[] = {{"exclude gnss0", 1}, {"exclude imu1", 9},    {"exclude gnss0", 9},
               {"admit gnss0", 8},   {"exclude wheels", 24}, {"admit imu1", 16}};
  for (const auto& c : cases) {
    ASSERT_TRUE(pit.say("take 7"));
    const auto due = pit.arrives(c.words);
    ASSERT_TRUE(due) << c.words;
    EXPECT_EQ(due->command.type, CommandType::kSensorsExcluded);
    EXPECT_EQ(due->command.argument, c.set) << c.words;
    pit.car->decide(due->id, telemetry::Outcome::kApplied, pit.now);
    pit.set(field("localization.excluded"), c.set);
  }
  ASSERT_TRUE(pit.say("take 7"));
  const auto due = pit.arrives("exclude gnss1");
  ASSERT_TRUE(due);
  EXPECT_EQ(due->command.argument, 18);
  pit.car->decide(due->id, telemetry::Outcome::kRefused, pit.now);
  pit.run(seconds(1));
  ASSERT_TRUE(pit.say("take 7"));
  const auto next = pit.arrives("exclude imu0");
  ASSERT_TRUE(next);
  EXPECT_EQ(next->command.argument, 20) << "what was refused is not counted in";
  for (const char* wrong : {"exclude", "exclude gnss2", "admit lidar", "exclude gnss0 gnss1"})
    EXPECT_FALSE(pit.say(wrong)) << wrong;
}

TEST(OperatorWords, AStopIsLatchedAndLetGoByItsChallenge) {
  Pit pit;
  pit.run(seconds(1));
  ASSERT_TRUE(pit.say("stop emergency"));
  pit.run(milliseconds(100));
  EXPECT_EQ(pit.car->view(pit.now).stop, telemetry::StopLevel::kEmergency);
  EXPECT_FALSE(pit.say("release")) << "the car has not told its challenge";
  pit.set(field("mode.stop_challenge"), pit.car->view(pit.now).stop_challenge);
  pit.car->standstill(true);
  ASSERT_TRUE(pit.say("take 1"));
  pit.run(milliseconds(100));
  ASSERT_TRUE(pit.say("release"));
  pit.run(milliseconds(200));
  EXPECT_EQ(pit.car->view(pit.now).stop, telemetry::StopLevel::kNone);
}

TEST(OperatorWords, AJoystickSampleIsOneSample) {
  Pit pit;
  pit.run(seconds(2));
  ASSERT_TRUE(pit.say("joystick 0.4 0.25"));
  pit.run(milliseconds(60));
  const auto sample = pit.car->view(pit.now).joystick;
  ASSERT_TRUE(sample);
  EXPECT_NEAR(sample->throttle_cap, 0.4, 0.01);
  EXPECT_NEAR(sample->brake, 0.25, 0.01);
  pit.run(milliseconds(300));
  EXPECT_FALSE(pit.car->view(pit.now).joystick) << "nobody repeats it";
}

TEST(OperatorWords, OneConsoleHoldsTheAuthority) {
  Pit pit;
  pit.run(seconds(1));
  EXPECT_TRUE(pit.say("take 1"));
  const auto second = pit.say("take 2");
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().what, "console 1 holds it");
  EXPECT_TRUE(pit.say("renew 1"));
  EXPECT_FALSE(pit.say("renew 2"));
  EXPECT_TRUE(pit.say("hand 1 2"));
  EXPECT_TRUE(pit.say("drop 2"));
  EXPECT_TRUE(pit.say("take 3"));
}

TEST(OperatorWords, WhatIsNotUnderstoodIsSaidSo) {
  Pit pit;
  const char* const wrong[] = {"",
                               "halt",
                               "stop",
                               "stop now",
                               "stop controlled please",
                               "release it",
                               "take",
                               "take 0",
                               "take 255",
                               "take one",
                               "hand 1",
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
    const auto obeyed = pit.say(words);
    EXPECT_FALSE(obeyed) << words;
    EXPECT_FALSE(check_words(words)) << words;
    if (obeyed) continue;
    EXPECT_EQ(obeyed.error().place, "operator: " + std::string{words});
  }
  EXPECT_EQ(pit.station->words_refused(), std::size(wrong));
  EXPECT_EQ(pit.station->commands_given(), 0U);
}

TEST(OperatorWords, WithoutACarNoCommandIsGiven) {
  Pit pit;
  const auto obeyed = pit.say("command speed_limit 30");
  ASSERT_FALSE(obeyed);
  EXPECT_EQ(obeyed.error().what, "not given: no car was met, or too many are under way");
}

}  // namespace
}  // namespace pitwall::intake
