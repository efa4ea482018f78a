// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/delivery/event_content.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace pitwall::telemetry {
namespace {

std::vector<EventContent> one_of_each() {
  return {LostEvents{0x01020304},
          FaultEvent{31, false, 3.25F},
          ModeEvent{2, 3, 31},
          FlagEvent{FlagKind::kVehicle, 4, 5},
          ArmingEvent{5},
          LapEvent{12, 37.125F},
          RestartEvent{1},
          TextEvent{"pit stop"},
          ThreatEvent{4, false, true, 49'870}};
}

TEST(EventContent, ComesBackAsItWasMade) {
  for (const EventContent& content : one_of_each()) {
    const Event event = make_event(content, Instant{77});
    EXPECT_EQ(event.at, Instant{77});
    EXPECT_EQ(static_cast<std::size_t>(event.kind), content.index());
    EXPECT_EQ(content_of(event), content);
  }
}

// The bytes that delivery/events.hpp promises, written by hand.
TEST(EventContent, IsTheBytesThatTheHeaderOfEventsNames) {
  const auto bytes = [](const EventContent& content) {
    const Event event = make_event(content, {});
    return std::vector<std::uint8_t>(event.payload.begin(), event.payload.end());
  };
  using Bytes = std::vector<std::uint8_t>;
  EXPECT_EQ(bytes(LostEvents{0x01020304}), (Bytes{4, 3, 2, 1}));
  EXPECT_EQ(bytes(FaultEvent{31, true, 1.0F}), (Bytes{31, 1, 0, 0, 0x80, 0x3F}));
  EXPECT_EQ(bytes(ModeEvent{2, 3, 31}), (Bytes{2, 3, 31}));
  EXPECT_EQ(bytes(FlagEvent{FlagKind::kTrack, 4, 1}), (Bytes{0, 4, 1}));
  EXPECT_EQ(bytes(LapEvent{258, 2.0F}), (Bytes{2, 1, 0, 0, 0, 0x40}));
  EXPECT_EQ(bytes(ThreatEvent{5, true, false, 0x01020304}), (Bytes{5, 1, 0, 4, 3, 2, 1}));
}

TEST(EventContent, OfAnotherLengthIsNone) {
  for (const EventContent& content : one_of_each()) {
    Event event = make_event(content, {});
    if (event.kind == EventKind::kText) continue;
    ASSERT_TRUE(event.payload.push(0));
    EXPECT_EQ(content_of(event), std::nullopt);
    event.payload.clear();
    EXPECT_EQ(content_of(event), std::nullopt);
  }
}

TEST(EventContent, AFlagThatIsNeitherIsNone) {
  Event fault = make_event(FaultEvent{}, {}), flag = make_event(FlagEvent{}, {});
  fault.payload[1] = 2;
  flag.payload[0] = 2;
  EXPECT_EQ(content_of(fault), std::nullopt);
  EXPECT_EQ(content_of(flag), std::nullopt);
  for (const std::size_t at : {1U, 2U}) {
    Event threat = make_event(ThreatEvent{}, {});
    threat.payload[at] = 2;
    EXPECT_EQ(content_of(threat), std::nullopt);
  }
  fault.kind = static_cast<EventKind>(kEventKinds);
  EXPECT_EQ(content_of(fault), std::nullopt);
}

TEST(EventContent, ATextThatIsTooLongIsCut) {
  const std::string text(3 * kEventPayload, 'x');
  const Event event = make_event(TextEvent{text}, {});
  EXPECT_EQ(content_of(event), EventContent{TextEvent{std::string_view(text).substr(0, 48)}});
  EXPECT_EQ(content_of(make_event(TextEvent{""}, {})), EventContent{TextEvent{""}});
}

}  // namespace
}  // namespace pitwall::telemetry
