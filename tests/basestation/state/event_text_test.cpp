// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/event_text.hpp"

#include <gtest/gtest.h>

#include "protocol/telemetry/delivery/event_content.hpp"

namespace pitwall::state {
namespace {

using telemetry::Command;
using telemetry::CommandType;

std::string output(const telemetry::EventContent& content) {
  return event_text(telemetry::make_event(content, {}));
}

TEST(LogText, CommandsHaveTheirUnitOrLabel) {
  EXPECT_EQ(command_text({.type = CommandType::kSpeedLimit, .argument = 30.5, .issuer = 1}),
            "speed limit 30.5 m/s");
  const auto excluded = [](double bits) {
    return command_text({.type = CommandType::kSensorsExcluded, .argument = bits, .issuer = 1});
  };
  EXPECT_EQ(excluded(0), "sensors excluded none");
  EXPECT_EQ(excluded(1), "sensors excluded gnss0");
  EXPECT_EQ(excluded(6), "sensors excluded gnss1, imu0");
  EXPECT_EQ(command_text({.type = CommandType::kArm, .argument = 1, .issuer = 1}), "arm \"arm\"");
  EXPECT_EQ(command_text({.type = CommandType::kRaceLine, .argument = 3, .issuer = 1}),
            "race line 3");
}

TEST(LogText, ProgressSaysHowFarAndHowLong) {
  telemetry::CommandProgress p;
  p.issued = Instant{seconds(1).ns};
  const Instant now = p.issued + milliseconds(500);
  EXPECT_EQ(progress_text(p, now), "not sent for 500 ms");
  p.sent = p.issued;
  EXPECT_EQ(progress_text(p, now), "sent, no answer for 500 ms");
  p.received = p.issued + milliseconds(40);
  EXPECT_EQ(progress_text(p, now), "received by the car after 40 ms");
  p.decided = p.issued + milliseconds(60);
  p.outcome = telemetry::Outcome::kApplied;
  EXPECT_EQ(progress_text(p, now), "applied after 60 ms");
}

TEST(LogText, EventsAreSentences) {
  EXPECT_EQ(output(telemetry::ModeEvent{.from = 1, .to = 2}), "mode: standby -> driving");
  EXPECT_EQ(output(telemetry::ModeEvent{.from = 2, .to = 4, .cause = 1}),
            "mode: driving -> emergency stop, operator: emergency stop");
  EXPECT_EQ(output(telemetry::LapEvent{.number = 3, .time_s = 45.25F}), "lap 3: 45.250 s");
  EXPECT_EQ(output(telemetry::LostEvents{.count = 7}),
            "7 events were lost: the car's queue was full");
  EXPECT_EQ(output(telemetry::FlagEvent{.from = 0, .to = 1}), "track flag: none -> RED");
  EXPECT_EQ(output(telemetry::ThreatEvent{.threat = 4, .seen_by_base = true}),
            "radio, seen by the base: Recorded openings of key exchanges are replayed");
  EXPECT_EQ(
      output(telemetry::ThreatEvent{.threat = 0, .begins = false, .most_per_s = 10}),
      "radio, seen by the car: over, at most 10/s: Key exchange messages do not fit our keys");
  EXPECT_EQ(output(telemetry::ThreatEvent{.threat = 200}),
            "radio: an attack that this base does not know");
}

TEST(LogText, TextFromTheAirIsShownWithoutControlCharacters) {
  EXPECT_EQ(output(telemetry::TextEvent{"a\x1b[2Jb\n"}), "a?[2Jb?");
}

TEST(LogText, AnUnknownEventIsNoCrash) {
  telemetry::Event event;
  event.kind = telemetry::EventKind::kLap;
  EXPECT_EQ(event_text(event), "an event that this base does not know");
}

}  // namespace
}  // namespace pitwall::state
