// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/command/command_ledger.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/protocol/telemetry/command/two_ends.hpp"

namespace pitwall::telemetry {
namespace {

using testing::CommandHistory;
using testing::kOperator;
using testing::TwoEnds;

// A peer repeated a command in five packets, fifty milliseconds, and forgot it: a fade of a tenth
// of a second swallowed one in five.
TEST(CommandLedger, ACommandOutlivesAFadeOfAnyLengthUnlikeFiveRepeats) {
  for (const int fade_ms : {50, 120, 400, 1'500}) {
    TwoEnds rig({.seed = 1});
    rig.run(seconds(1));
    rig.up.cut = true;
    const auto id = rig.issue(CommandType::kSpeedLimit, 33.3);
    rig.run(milliseconds(fade_ms));
    EXPECT_FALSE(outcome(rig, *id));
    rig.up.cut = false;
    rig.run(milliseconds(100));
    EXPECT_EQ(outcome(rig, *id), Outcome::kApplied) << fade_ms;
  }
  TwoEnds rig({.seed = 1});
  rig.run(seconds(1));
  rig.up.cut = true;
  const auto id = rig.issue(CommandType::kSpeedLimit, 33.3);
  rig.run(seconds(30));
  rig.up.cut = false;
  rig.run(milliseconds(100));
  EXPECT_EQ(outcome(rig, *id), Outcome::kExpired) << "past its time it still learns its fate";
  EXPECT_EQ(rig.histories[*id].applied, 0);
}

// A peer told copies of a command from a second press by the clock: within a second the second
// press was dropped without a word.
TEST(CommandLedger, ASecondPressWithinASecondCounts) {
  TwoEnds rig({.fading = {.loss = 0.3}, .seed = 2});
  rig.run(seconds(1));
  for (int i = 0; i < 10; ++i) {
    const auto id = rig.issue(CommandType::kSpeedLimit, 30.0);
    rig.run(milliseconds(400));
    EXPECT_EQ(outcome(rig, *id), Outcome::kApplied);
    EXPECT_EQ(rig.histories[*id].applied, 1);
  }
}

// A peer had "five metres more": copies that came more than a second apart counted twice. Here a
// copy never counts twice, whenever it comes, and what is said is a value, not a step.
TEST(CommandLedger, CopiesHoweverLateAreOneCommandAndNoCommandIsRelative) {
  TwoEnds rig({.delay_min = milliseconds(1), .delay_max = seconds(5), .twice = 1.0, .seed = 3});
  rig.once = false;
  rig.run(seconds(6));
  std::vector<CommandId> ids;
  for (int i = 0; i < 100; ++i) {
    if (const auto id = rig.issue(CommandType::kSpeedLimit, i)) ids.push_back(*id);
    rig.run(milliseconds(500));
  }
  rig.run(seconds(10));
  for (const CommandId id : ids) EXPECT_LE(rig.histories[id].applied, 1) << id;
  EXPECT_GT(rig.ledger.counters().repeated, 1'000U);
  for (const CommandRow& row : kCommandTable) {
    EXPECT_GE(row.min, 0.0) << row.name << " could be a step down";
    EXPECT_EQ(row.name.find("more"), std::string_view::npos);
    EXPECT_EQ(row.name.find("toggle"), std::string_view::npos);
  }
}

TEST(CommandLedger, WithoutComparedClocksNothingIsAppliedAndNothingForgotten) {
  TwoEnds rig({.seed = 4});
  rig.run(seconds(1));
  rig.clock_known = false;
  const auto id = rig.issue(CommandType::kTrackFlag, 3.0);
  rig.run(seconds(1));
  EXPECT_FALSE(outcome(rig, *id));
  EXPECT_TRUE(rig.transmitter.progress(*id)->received) << "known to the car, not decided";
  EXPECT_EQ(rig.histories[*id].applied, 0);
  rig.clock_known = true;
  rig.run(milliseconds(100));
  EXPECT_EQ(outcome(rig, *id), Outcome::kApplied);
  rig.clock_known = false;
  const auto late = rig.issue(CommandType::kTrackFlag, 3.0);
  rig.run(seconds(3));
  rig.clock_known = true;
  rig.run(milliseconds(100));
  EXPECT_EQ(outcome(rig, *late), Outcome::kExpired);
}

TEST(CommandLedger, AConsumerThatDoesNotAskInTimeGetsNothingLate) {
  TwoEnds rig({.seed = 5});
  rig.run(seconds(1));
  rig.consumer_asks = false;
  const auto id = rig.issue(CommandType::kArm, 1.0);
  rig.run(milliseconds(2'100));
  rig.consumer_asks = true;
  rig.run(milliseconds(100));
  EXPECT_EQ(outcome(rig, *id), Outcome::kExpired);
  EXPECT_EQ(rig.histories[*id].applied, 0);
}

TEST(CommandLedger, TheAgeIsLookedAtWhenTheConsumerAsksAndToTheNanosecond) {
  const Instant sent{seconds(50).ns};
  const CommandRecord stated{.number = 1,
                             .base_run = short_boot(9),
                             .car_boot = short_boot(5),
                             .type = static_cast<std::uint8_t>(CommandType::kSendParameters),
                             .step = 1};
  const auto bytes = to_bytes(stated);
  Received received;
  received.at = sent + milliseconds(30);
  received.sent_earliest = sent;
  const Duration reported = parse_command(bytes)->age;
  const Instant expires = sent - reported + row_of(CommandType::kSendParameters).time_to_live;
  for (const Duration past : {Duration{}, nanoseconds(1)}) {
    CommandLedger ledger(5);
    ledger.set_peer_boot(9);
    ASSERT_TRUE(ledger.take({RecordType::kCommand, bytes}, received, {}));
    EXPECT_EQ(ledger.take_due(expires + past, {}).has_value(), past == Duration{});
  }
}

// What memory no longer holds is not begun anew.
TEST(CommandLedger, ANumberOlderThanMemoryIsNeverHandedOut) {
  CommandLedger ledger(5);
  ledger.set_peer_boot(9);
  const Instant now{seconds(50).ns};
  Received received;
  received.at = now;
  received.sent_earliest = now;
  const auto offer = [&](CommandId number) {
    const CommandRecord stated{.number = number,
                               .base_run = short_boot(9),
                               .car_boot = short_boot(5),
                               .type = static_cast<std::uint8_t>(CommandType::kSendParameters),
                               .step = 1};
    const auto bytes = to_bytes(stated);
    EXPECT_TRUE(ledger.take({RecordType::kCommand, bytes}, received, {}));
    const auto due = ledger.take_due(now, {});
    if (due) ledger.decide(due->id, Outcome::kApplied, now);
    return due.has_value();
  };
  EXPECT_TRUE(offer(1'000));
  EXPECT_FALSE(offer(1'000 - CommandLedger::kDepth));
  EXPECT_FALSE(offer(1'000 - CommandLedger::kDepth - 7));
  EXPECT_FALSE(offer(1));
  EXPECT_TRUE(offer(1'001));
}

TEST(CommandLedger, ACommandForTheRunBeforeIsAnsweredByItsName) {
  TwoEnds rig({.seed = 6});
  rig.run(seconds(1));
  rig.up.cut = true;
  const auto old = rig.issue(CommandType::kArm, 1.0);
  rig.run(milliseconds(100));
  // The car begins anew; the base does not know it yet.
  rig.ledger = CommandLedger{TwoEnds::kCarBoot + 1};
  rig.ledger.set_peer_boot(TwoEnds::kBaseBoot);
  rig.up.cut = false;
  rig.run(milliseconds(200));
  EXPECT_EQ(outcome(rig, *old), Outcome::kOtherRun);
  EXPECT_EQ(rig.histories[*old].applied, 0);
  rig.transmitter.set_peer_boot(TwoEnds::kCarBoot + 1, rig.now);
  const auto fresh = rig.issue(CommandType::kArm, 1.0);
  rig.run(milliseconds(200));
  EXPECT_EQ(outcome(rig, *fresh), Outcome::kApplied);
}

// Numbers begin again with the base; neither old records nor answers to old commands count for new.
TEST(CommandLedger, ABaseThatBeginsAgainIsNotMistakenForTheOneBefore) {
  TwoEnds rig({.seed = 8});
  rig.run(seconds(1));
  ASSERT_EQ(rig.issue(CommandType::kSpeedLimit, 30.0), CommandId{1});
  rig.consumer_asks = false;
  rig.run(milliseconds(100));
  const auto due = rig.ledger.take_due(rig.car_now(), rig.view);  // handed out, not yet answered
  ASSERT_TRUE(due);
  rig.transmitter = CommandTransmitter{TwoEnds::kBaseBoot + 1};
  rig.transmitter.set_peer_boot(TwoEnds::kCarBoot, rig.now);
  const auto before = rig.ledger.counters().other_base;
  ASSERT_EQ(rig.issue(CommandType::kSpeedLimit, 99.0), CommandId{1});
  rig.run(milliseconds(100));
  EXPECT_GT(rig.ledger.counters().other_base, before) << "before the sessions say so it is ignored";
  rig.ledger.set_peer_boot(TwoEnds::kBaseBoot + 1);
  rig.run(milliseconds(100));
  const auto now_due = rig.ledger.take_due(rig.car_now(), rig.view);  // both are in its hands
  ASSERT_TRUE(now_due);
  rig.ledger.decide(due->id, Outcome::kRefused, rig.car_now());
  rig.run(milliseconds(100));
  EXPECT_FALSE(outcome(rig, 1)) << "that answer was to another command";
  rig.ledger.decide(now_due->id, Outcome::kApplied, rig.car_now());
  rig.run(milliseconds(100));
  EXPECT_EQ(outcome(rig, 1), Outcome::kApplied);
  EXPECT_EQ(rig.transmitter.progress(1)->command.argument, 99.0);
}

TEST(CommandLedger, AnUnknownTypeIsAnsweredUnsupported) {
  CommandLedger ledger(5);
  ledger.set_peer_boot(9);
  const auto bytes = to_bytes(CommandRecord{
      .number = 1, .base_run = short_boot(9), .car_boot = short_boot(5), .type = 200});
  Received received;
  EXPECT_TRUE(ledger.take({RecordType::kCommand, bytes}, received, {}));
  EXPECT_EQ(ledger.counters().decided[static_cast<std::size_t>(Outcome::kUnsupported)], 1U);
}

TEST(CommandLedger, MalformedRecordsHaveNoEffectAndAreCounted) {
  CommandLedger ledger(5);
  ledger.set_peer_boot(9);
  const std::vector<std::uint8_t> bytes(300, 0xFF);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto payload = std::span<const std::uint8_t>{bytes}.first(size);
    for (const RecordType type : {RecordType::kCommand, RecordType::kCommandResultAck}) {
      const bool fits = (type == RecordType::kCommand && size == kCommandSize) ||
                        (type == RecordType::kCommandResultAck && size == kResultAckSize);
      if (fits) continue;
      EXPECT_FALSE(ledger.take({type, payload}, {}, {}));
    }
    EXPECT_FALSE(ledger.take({RecordType::kEvent, payload}, {}, {}));
  }
  EXPECT_EQ(ledger.counters().received, 0U);
  EXPECT_EQ(ledger.counters().malformed, 3U * 300U - 2U);
}

TEST(CommandLedger, AnAnswerThatCallsALateCommandAppliedIsCorrected) {
  TwoEnds rig({.seed = 9});
  rig.run(seconds(1));
  rig.consumer_asks = false;
  const auto id = rig.issue(CommandType::kArm, 1.0);
  rig.run(milliseconds(100));
  const auto due = rig.ledger.take_due(rig.car_now(), rig.view);
  ASSERT_TRUE(due);
  EXPECT_FALSE(rig.ledger.take_due(rig.car_now(), rig.view));
  rig.ledger.decide(due->id, Outcome::kReceived, rig.car_now());  // no answer
  rig.ledger.decide(due->id, Outcome::kApplied, due->expires + nanoseconds(1));
  rig.run(milliseconds(100));
  EXPECT_EQ(outcome(rig, *id), Outcome::kExpired);
}

// What is handed out may be applied until the authority itself ends, and not a moment longer.
TEST(CommandLedger, AnExpiryIsNeverLaterThanTheAuthority) {
  TwoEnds rig({.seed = 10});
  rig.run(seconds(1));
  rig.renews = false;
  rig.run(milliseconds(1'500));
  rig.consumer_asks = false;
  rig.issue(CommandType::kArm, 1.0);
  rig.run(milliseconds(60));
  const auto due = rig.ledger.take_due(rig.car_now(), rig.view);
  ASSERT_TRUE(due);
  EXPECT_EQ(rig.view.holder(due->expires), kOperator);
  EXPECT_EQ(rig.view.holder(due->expires + nanoseconds(1)), 0);
}

}  // namespace
}  // namespace pitwall::telemetry
