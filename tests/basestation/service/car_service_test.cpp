// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/car_service.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/basestation/oval_course.hpp"
#include "tests/basestation/radio_rig.hpp"

namespace pitwall::service {
namespace {

using telemetry::field;

constexpr command::Person kAda{.console = 16, .name = "Ada"};

struct Pit : RadioRig {
  explicit Pit(const RigOptions& wanted = {}) : RadioRig(wanted) {
    set(field("mode.mode"), 2.0);
    set(field("ego.x"), 12.5);
    set(field("ego.vx"), 50.0);
    base->messages().subscribe([this](std::string_view type, std::string_view text, Instant) {
      ++messages[std::string{type}];
      newest[std::string{type}] = text;
    });
  }
  alarms::State alarm(std::string_view key) const {
    return base->evaluator().alarms().state(*alarms::find_alarm(key));
  }

  std::map<std::string, int> messages;
  std::map<std::string, std::string> newest;
};

// Nobody reads it, and it judges, derives and publishes all the same.
TEST(CarService, JudgesWithoutAnyPublisher) {
  Pit pit;
  pit.run(seconds(2));
  EXPECT_EQ(pit.base->view(state::id_of(field("ego.x")), pit.now).value, 12.5);
  EXPECT_EQ(pit.base->view(state::id_of(state::BaseField::kLinkState), pit.now).value, 1.0);
  EXPECT_EQ(pit.alarm("link_lost"), alarms::State::kNormal);
  pit.loses = [](bool to_base, telemetry::PathId) { return to_base; };
  pit.run(seconds(1));
  EXPECT_EQ(pit.alarm("link_lost"), alarms::State::kUnack);
  ASSERT_TRUE(
      pit.base->requests().execute(command::AcknowledgeAlarms{.key = "link_lost"}, kAda, pit.now));
  EXPECT_EQ(pit.alarm("link_lost"), alarms::State::kAcked);
  pit.loses = [](bool, telemetry::PathId) { return false; };
  pit.run(seconds(5));
  EXPECT_EQ(pit.alarm("link_lost"), alarms::State::kNormal);
  EXPECT_GE(pit.messages["alarm_event"], 3);
  EXPECT_GE(pit.messages["link"], 10);
  for (const char* const type :
       {"hello", "alarms", "authority", "expected", "settings", "checklist", "fuel"}) {
    EXPECT_GE(pit.messages[type], 1) << type;
  }
}

// A gate says the same to whoever asks, and leaves its line.
TEST(CarService, ACommandPassesTheGatesOfThisMoment) {
  Pit pit;
  pit.run(seconds(2));
  ASSERT_TRUE(pit.base->requests().execute(command::ClaimAuthority{}, kAda, pit.now));
  pit.run(milliseconds(100));
  const command::IssueCommand faster{.type = telemetry::CommandType::kSpeedLimit, .argument = 80.0};
  const auto refused = pit.base->requests().execute(faster, kAda, pit.now);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("tyres: not received yet"), std::string::npos)
      << refused.error().what;
  EXPECT_NE(pit.base->requests().audit().lines().back().result.find("refused: gates"),
            std::string::npos);
  const command::IssueCommand slower{.type = telemetry::CommandType::kSpeedLimit, .argument = 40.0};
  ASSERT_TRUE(pit.base->requests().execute(slower, kAda, pit.now));
  pit.run(milliseconds(200));
  ASSERT_EQ(pit.reported.size(), 1U);
  EXPECT_NEAR(pit.reported[0].command.argument, 40.0, 0.05);
  EXPECT_GE(pit.messages["command"], 3);
}

// By the radio, with a second of loss over the line at the end of the second lap.
TEST(CarService, TimesTheLapsOfItsCourse) {
  const Oval oval{.straight_m = 100.0, .radius_m = 50.0};
  RigOptions options;
  options.service.evaluator.course = oval.course();
  Pit pit{options};
  constexpr double kSpeed_mps = 50.0;
  const double lap_s = oval.length_m() / kSpeed_mps;
  double way_m = 0.8 * oval.length_m();
  while (way_m < 4.5 * oval.length_m()) {
    const bool lost = std::abs(way_m - 3.0 * oval.length_m()) < 25.0;
    pit.loses = [lost](bool to_base, telemetry::PathId) { return to_base && lost; };
    pit.set(field("track.station"), std::fmod(way_m, oval.length_m()));
    pit.run(RadioRig::kTick);
    way_m += kSpeed_mps * RadioRig::kTick.seconds();
  }
  const auto& laps = pit.base->laps()->laps();
  ASSERT_EQ(laps.size(), 5U);
  // A station is rounded to 0.1 m, a tick is a millisecond: at either end of the lap.
  EXPECT_NEAR(laps[1].time_s(), lap_s, 2.0 * (0.05 / kSpeed_mps + 0.001));
  EXPECT_TRUE(laps[2].start_seen && !laps[2].finish_seen);
  EXPECT_TRUE(!laps[3].start_seen && laps[3].finish_seen);
  EXPECT_EQ(pit.base->laps()->best(), &laps[1]);
  EXPECT_EQ(pit.messages["laps"], 5) << "at each line, and at the first sample";
  EXPECT_NE(pit.newest["laps"].find("\"best\": 2"), std::string::npos);
}

TEST(CarService, AStopIsInTheNextPacketWhoeverSaysIt) {
  Pit pit;
  pit.run(seconds(1));
  ASSERT_TRUE(pit.base->requests().execute(command::Stop{telemetry::StopLevel::kEmergency},
                                           {.console = 200, .name = "nobody"}, pit.now));
  pit.run(milliseconds(50));
  EXPECT_EQ(pit.car->view(pit.now).stop, telemetry::StopLevel::kEmergency);
}

TEST(CarService, TellsWhoItIsAndWhatItKnowsOfTheCar) {
  Pit pit{{.real_car = false, .service = {.car = 7, .name = "Seven"}}};
  EXPECT_EQ(pit.base->identity().mode, "NONE");
  pit.run(seconds(1));
  const CarIdentity identity = pit.base->identity();
  EXPECT_EQ(identity.car, 7);
  EXPECT_EQ(identity.mode, "HIL");
  EXPECT_NE(pit.newest["hello"].find(R"("mode": "HIL")"), std::string::npos);
  EXPECT_EQ(
      pit.base->past(state::id_of(field("ego.x")), pit.now - seconds(1), pit.now, 100).back().value,
      12.5F);
}

TEST(CarService, AMarkIsALineForAll) {
  Pit pit;
  pit.base->mark("here", kAda, pit.now);
  EXPECT_NE(pit.newest["mark"].find("here"), std::string::npos);
  EXPECT_NE(pit.newest["mark"].find("Ada"), std::string::npos);
}

TEST(CarService, ASilentJoystickIsAnAlarm) {
  Pit pit;
  bool silent = false;
  pit.base->watch_joystick([&](Instant) {
    return silent ? command::JoystickState::kLost : command::JoystickState::kReleased;
  });
  pit.run(seconds(1));
  EXPECT_EQ(pit.alarm("joystick_lost"), alarms::State::kNormal);
  silent = true;
  pit.run(milliseconds(300));
  EXPECT_EQ(pit.alarm("joystick_lost"), alarms::State::kUnack);
  silent = false;
  pit.run(seconds(2));
  EXPECT_EQ(pit.alarm("joystick_lost"), alarms::State::kReturnedUnack);
}

// The whole way of a console: each step refused before its time, with its reason.
TEST(CarService, AfterAStopItLeadsBackToDrivingStepByStep) {
  using enum command::RecoveryStep;
  Pit pit;
  const auto live = [&](double mode, double speed_mps) {
    pit.set(field("mode.mode"), mode);
    pit.set(field("ego.vx"), speed_mps);
    pit.car->standstill(speed_mps == 0.0);
    for (int i = 0; i < 10; ++i) {
      const telemetry::OperatorView seen = pit.car->view(pit.now);
      pit.set(field("mode.stop_latch"), static_cast<double>(seen.stop));
      pit.set(field("mode.stop_challenge"), static_cast<double>(seen.stop_challenge));
      (void)pit.base->requests().execute(command::ClaimAuthority{.claim = command::Claim::kRenew},
                                         kAda, pit.now);
      pit.run(milliseconds(100));
    }
  };
  const auto recover = [&](command::RecoveryStep step, std::optional<double> challenge = {}) {
    const auto done = pit.base->requests().execute(
        command::Recover{.step = step, .challenge = challenge}, kAda, pit.now);
    return done ? std::string{} : done.error().what;
  };
  constexpr double kDisarmed = 0.0, kStandby = 1.0, kDriving = 2.0, kStopping = 3.0, kHalted = 5.0;
  live(kDriving, 50.0);
  EXPECT_FALSE(pit.base->stopped());
  ASSERT_TRUE(pit.base->requests().execute(command::Stop{telemetry::StopLevel::kControlled}, kAda,
                                           pit.now));
  ASSERT_TRUE(pit.base->requests().execute(command::ClaimAuthority{.claim = command::Claim::kTake},
                                           kAda, pit.now));
  live(kStopping, 30.0);
  ASSERT_TRUE(pit.base->stopped());
  EXPECT_EQ(pit.base->stopped()->by, "Ada");
  EXPECT_NE(recover(kRelease).find("standing"), std::string::npos) << "while it moves";
  live(kHalted, 0.0);
  const double challenge = pit.base->stopped()->challenge;
  ASSERT_GT(challenge, 0.0);
  EXPECT_EQ(recover(kRelease, challenge + 1.0), "another stop was latched since it was looked at");
  EXPECT_EQ(pit.car->view(pit.now).stop, telemetry::StopLevel::kControlled);
  EXPECT_EQ(recover(kRelease, challenge), "");
  live(kHalted, 0.0);
  EXPECT_EQ(pit.car->view(pit.now).stop, telemetry::StopLevel::kNone);
  EXPECT_EQ(recover(kAcknowledge), "");
  EXPECT_NE(recover(kAcknowledge), "") << "there is nothing left to acknowledge";
  EXPECT_EQ(recover(kReset), "");
  live(kDisarmed, 0.0);
  ASSERT_TRUE(pit.base->stopped());
  EXPECT_TRUE(pit.base->stopped()->steps.at(2).done);
  EXPECT_EQ(recover(kArm), "");
  live(kStandby, 0.0);
  EXPECT_FALSE(pit.base->stopped());
  std::vector<telemetry::CommandType> reported;
  for (const telemetry::DueCommand& due : pit.reported) reported.push_back(due.command.type);
  EXPECT_EQ(reported, (std::vector{telemetry::CommandType::kReset, telemetry::CommandType::kArm}));
}

}  // namespace
}  // namespace pitwall::service
