// SPDX-License-Identifier: Apache-2.0
#include "basestation/command/command_queue.hpp"

#include <gtest/gtest.h>

#include "tests/basestation/command/people.hpp"
#include "tests/basestation/healthy_race.hpp"
#include "tests/basestation/radio_rig.hpp"

namespace pitwall::command {
namespace {

using telemetry::CommandType;
using telemetry::field;
using telemetry::Outcome;

// A healthy race in front of the queue, and behind it a real radio with a car's end.
struct CommandPit {
  HealthyRace wall;
  RadioRig radio;
  Audit audit;
  CommandQueue authority{{}, true, audit};

  CommandPit() {
    wall.run(seconds(5));
    radio.set(field("mode.mode"), 2.0);
    radio.run(seconds(2));
    EXPECT_TRUE(radio.station->endpoint().authority().take(kAda.console, radio.now));
    radio.run(milliseconds(200));
  }
  telemetry::StationEndpoint& endpoint() { return radio.station->endpoint(); }
  GateInputs inputs() {
    return {wall.reported.vehicle, wall.evaluator, endpoint().authority().holder(radio.now),
            radio.now};
  }
  TicketId stage(double mps) {
    const auto staged = authority.stage(kAda, CommandType::kSpeedLimit, mps, inputs());
    EXPECT_TRUE(staged);
    return staged.value_or(0);
  }
  Result<bool, Problem> send(TicketId id, const std::optional<Override>& with = std::nullopt) {
    return authority.send(id, kAda, with, inputs(), endpoint());
  }
  void run(Duration length) {
    for (const Instant end = radio.now + length; radio.now < end;) {
      radio.run(milliseconds(100));
      (void)endpoint().authority().renew(kAda.console, radio.now);
      authority.follow(wall.reported.vehicle, endpoint(), radio.now);
    }
  }
  Step step(TicketId id) const { return authority.ticket(id)->step; }
};

TEST(CommandQueue, WhatDoesNotExistCannotBeStaged) {
  CommandPit pit;
  const auto refused = [&](CommandType type, double argument) {
    const auto staged = pit.authority.stage(kAda, type, argument, pit.inputs());
    EXPECT_EQ(pit.audit.lines().back().result.substr(0, 7), staged ? "gates p" : "refused");
    return staged ? std::string{} : staged.error().what;
  };
  EXPECT_EQ(refused(CommandType::kTrackFlag, 9.0), "no such value");
  EXPECT_EQ(refused(CommandType::kTrackFlag, 3.5), "no such value");
  EXPECT_EQ(refused(CommandType::kSensorsExcluded, 512.0), "no such value");
  EXPECT_EQ(refused(CommandType::kArm, 2.0), "no such value");
  EXPECT_EQ(refused(CommandType::kReset, 0.0), "no such value");
  EXPECT_EQ(refused(CommandType::kSpeedLimit, 121.0), "out of range");
  for (const auto type :
       {CommandType::kRaceLine, CommandType::kRole, CommandType::kSendParameters}) {
    EXPECT_EQ(refused(type, 1.0), "no car carries this out");
  }
  EXPECT_TRUE(pit.authority.tickets().empty());
  EXPECT_EQ(refused(CommandType::kTrackFlag, 3.0), "");
  EXPECT_EQ(pit.audit.lines().back().what, "stage track flag YELLOW");
}

TEST(CommandQueue, ACommandClimbsTheLadderOfTheRealRadio) {
  CommandPit pit;
  const TicketId id = pit.stage(54.0);
  EXPECT_EQ(pit.step(id), Step::kStaged);
  ASSERT_TRUE(pit.send(id));
  EXPECT_EQ(pit.step(id), Step::kGated);
  pit.run(milliseconds(300));
  EXPECT_EQ(pit.step(id), Step::kReceived);
  ASSERT_EQ(pit.radio.reported.size(), 1U);
  pit.radio.car->decide(pit.radio.reported.front().id, Outcome::kApplied, pit.radio.now);
  pit.run(milliseconds(300));
  const Ticket& ticket = *pit.authority.ticket(id);
  EXPECT_EQ(ticket.step, Step::kApplied);
  EXPECT_FALSE(ticket.echoed);
  pit.wall.set(field("planner.operator_limit"), 54.0);
  pit.wall.run(seconds(1));
  pit.authority.follow(pit.wall.reported.vehicle, pit.endpoint(), pit.wall.now);
  EXPECT_TRUE(pit.authority.ticket(id)->echoed);
  std::optional<Instant> before;
  for (const Step step :
       {Step::kStaged, Step::kGated, Step::kSent, Step::kReceived, Step::kApplied}) {
    const auto at = ticket.at.at(static_cast<std::size_t>(step));
    ASSERT_TRUE(at) << text_of(step);
    EXPECT_TRUE(!before || *at >= *before) << text_of(step);
    before = at;
  }
}

TEST(CommandQueue, TheCarsRefusalIsShownInItsWords) {
  CommandPit pit;
  const TicketId id = pit.stage(54.0);
  ASSERT_TRUE(pit.send(id));
  pit.run(milliseconds(300));
  pit.radio.car->decide(pit.radio.reported.front().id, Outcome::kRefused, pit.radio.now);
  pit.run(milliseconds(300));
  EXPECT_EQ(pit.step(id), Step::kRefused);
  EXPECT_EQ(pit.authority.ticket(id)->text, telemetry::text_of(Outcome::kRefused));
  EXPECT_EQ(pit.audit.lines().back().who, "Ada");
}

TEST(CommandQueue, GatesAreJudgedAnewWhenItIsSent) {
  CommandPit pit;
  const TicketId id = pit.stage(54.0);
  EXPECT_TRUE(all_pass(pit.authority.ticket(id)->gates));
  pit.wall.tyres(29.0);
  pit.wall.run(seconds(1));
  const auto sent = pit.send(id);
  ASSERT_FALSE(sent);
  EXPECT_NE(sent.error().what.find("tyres: 29.0 degC"), std::string::npos) << sent.error().what;
  EXPECT_EQ(pit.step(id), Step::kStaged);
  EXPECT_NE(pit.audit.lines().back().result.find("refused"), std::string::npos);
  pit.run(milliseconds(300));
  EXPECT_TRUE(pit.radio.reported.empty());
}

TEST(CommandQueue, AnOverrideWantsAReasonAndASecondPerson) {
  CommandPit pit;
  pit.wall.tyres(29.0);
  pit.wall.run(seconds(1));
  const TicketId id = pit.stage(54.0);
  EXPECT_FALSE(pit.send(id, Override{"", kBob}));
  EXPECT_FALSE(pit.send(id, Override{"qualifying", {}}));
  EXPECT_FALSE(pit.send(id, Override{"qualifying", kAda}));
  EXPECT_FALSE(pit.send(id, Override{"qualifying", {kAda.console, "Bob"}}));  // the same console
  ASSERT_TRUE(pit.send(id, Override{"qualifying", kBob}));
  EXPECT_EQ(pit.authority.ticket(id)->overridden->second, kBob);
  bool logged = false;
  for (const AuditLine& line : pit.audit.lines()) {
    logged = logged || (line.what == "override speed limit 54 m/s" &&
                        line.result.find("with Bob: qualifying (tyres") == 0);
  }
  EXPECT_TRUE(logged);
  pit.run(milliseconds(300));
  EXPECT_EQ(pit.radio.reported.size(), 1U);
}

TEST(CommandQueue, TheWayToTheCarCannotBeOverridden) {
  CommandPit pit;
  pit.wall.packets = false;
  pit.wall.run(seconds(2));
  const TicketId id = pit.stage(40.0);
  EXPECT_FALSE(pit.send(id, Override{"qualifying", kBob}));
  pit.wall.packets = true;
  pit.wall.run(seconds(5));
  pit.endpoint().authority().drop(kAda.console, pit.radio.now);
  EXPECT_FALSE(pit.send(id, Override{"qualifying", kBob}));
}

TEST(CommandQueue, ATicketIsSentOnceAndExpires) {
  CommandPit pit;
  const TicketId sent = pit.stage(54.0), left = pit.stage(53.0), cancelled = pit.stage(52.0);
  ASSERT_TRUE(pit.send(sent));
  EXPECT_FALSE(pit.send(sent));
  EXPECT_FALSE(pit.authority.cancel(sent, kAda, pit.radio.now));
  EXPECT_TRUE(pit.authority.cancel(cancelled, kAda, pit.radio.now));
  EXPECT_FALSE(pit.send(cancelled));
  EXPECT_FALSE(pit.send(99));
  EXPECT_FALSE(pit.authority.cancel(99, kAda, pit.radio.now));
  pit.run(seconds(31));
  EXPECT_EQ(pit.step(left), Step::kExpired);
  EXPECT_FALSE(pit.send(left));
}

TEST(CommandQueue, OutOfRangeIsNoTicket) {
  CommandPit pit;
  for (const double argument : {-1.0, 121.0, kUnset}) {
    EXPECT_FALSE(pit.authority.stage(kAda, CommandType::kSpeedLimit, argument, pit.inputs()));
  }
  EXPECT_TRUE(pit.authority.tickets().empty());
  EXPECT_EQ(pit.audit.count(), 3U);
}

TEST(CommandQueue, AStopWantsNothing) {
  CommandPit pit;
  pit.endpoint().authority().drop(kAda.console, pit.radio.now);
  pit.wall.packets = false;
  pit.wall.run(seconds(5));
  pit.authority.stop(telemetry::StopLevel::kEmergency, telemetry::StopReason::kOperator, kBob,
                     pit.radio.now, pit.endpoint());
  EXPECT_EQ(pit.audit.lines().back().what, "EMERGENCY STOP");
  pit.radio.run(milliseconds(200));
  EXPECT_EQ(pit.radio.car->view(pit.radio.now).stop, telemetry::StopLevel::kEmergency);
}

TEST(CommandQueue, EveryChangeOfATicketHasItsRevision) {
  CommandPit pit;
  const TicketId a = pit.stage(54.0), b = pit.stage(53.0);
  EXPECT_EQ(pit.authority.ticket(a)->revision, 1U);
  EXPECT_EQ(pit.authority.ticket(b)->revision, 2U);
  const std::uint64_t before = pit.authority.revision();
  ASSERT_TRUE(pit.send(b));
  ASSERT_TRUE(pit.authority.cancel(a, kAda, pit.radio.now));
  EXPECT_GT(pit.authority.ticket(b)->revision, before);
  EXPECT_GT(pit.authority.ticket(a)->revision, pit.authority.ticket(b)->revision);
  EXPECT_EQ(pit.authority.revision(), pit.authority.ticket(a)->revision);
}

TEST(CommandQueue, WhatIsIssuedPassesTheGatesAtOnceOrHasEnded) {
  CommandPit pit;
  const auto issue = [&](double mps, const std::optional<Override>& with = std::nullopt) {
    return pit.authority.issue(kAda, CommandType::kSpeedLimit, mps, with, pit.inputs(),
                               pit.endpoint());
  };
  ASSERT_TRUE(issue(54.0));
  EXPECT_EQ(pit.authority.tickets().back().step, Step::kGated);
  EXPECT_EQ(pit.authority.issued(), 1U);
  const auto refused = issue(90.0);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("step"), std::string::npos) << refused.error().what;
  EXPECT_EQ(pit.authority.tickets().back().step, Step::kRefused);
  EXPECT_FALSE(issue(90.0, Override{.reason = "dry line", .second = {}})) << "nobody agrees";
  EXPECT_TRUE(issue(90.0, Override{.reason = "dry line", .second = kBob}));
  EXPECT_EQ(pit.authority.issued(), 2U);
}

// Without tokens nobody can prove to be a second person.
TEST(CommandQueue, WithoutTokensAnOverrideTakesAReason) {
  CommandPit pit;
  CommandQueue queue{{}, false, pit.audit};
  const auto issue = [&](const std::string& reason) {
    return queue.issue(kAda, CommandType::kSpeedLimit, 90.0,
                       Override{.reason = reason, .second = {}}, pit.inputs(), pit.endpoint());
  };
  EXPECT_FALSE(issue(""));
  EXPECT_TRUE(issue("dry line"));
}

TEST(CommandQueue, KeepsTheNewestTickets) {
  CommandPit pit;
  for (std::size_t i = 0; i < CommandQueue::kKept + 5; ++i) pit.stage(50.0);
  EXPECT_EQ(pit.authority.tickets().size(), CommandQueue::kKept);
  EXPECT_EQ(pit.authority.ticket(5), nullptr);
  EXPECT_EQ(pit.authority.ticket(6)->id, 6U);
}

}  // namespace
}  // namespace pitwall::command
