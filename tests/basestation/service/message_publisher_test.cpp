// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/message_publisher.hpp"

#include <gtest/gtest.h>

#include <map>

#include "protocol/telemetry/delivery/event_content.hpp"
#include "tests/basestation/radio_rig.hpp"

namespace pitwall::service {
namespace {

constexpr command::Person kBea{.console = 16, .name = "Bea"};

struct Published : RadioRig {
  Published() {
    set(telemetry::field("ego.x"), 1.0);
    base->messages().subscribe(
        [this](std::string_view type, std::string_view, Instant) { ++counts[std::string{type}]; });
  }
  // Of the messages in this time.
  std::map<std::string, int> during(Duration length) {
    counts.clear();
    run(length);
    return counts;
  }
  std::map<std::string, int> counts;
};

TEST(MessagePublisher, WhatDoesNotChangeIsNotPublishedAgain) {
  Published base;
  base.run(seconds(3));
  auto counts = base.during(seconds(10));
  EXPECT_EQ(counts["checklist"], 10);
  EXPECT_NEAR(counts["link"], 20, 1);
  for (const char* const type :
       {"hello", "alarms", "authority", "settings", "expected", "audit", "command", "event"}) {
    EXPECT_EQ(counts[type], 0) << type;
  }
}

TEST(MessagePublisher, AHeldAuthorityIsPublishedEachSecond) {
  Published base;
  base.run(seconds(1));
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(base.base->requests().execute(command::ClaimAuthority{}, kBea, base.now));
    const int published = base.during(seconds(1))["authority"];
    EXPECT_GE(published, 1) << i;
    EXPECT_LE(published, 2) << i;
  }
}

TEST(MessagePublisher, EachEventAndEachAuditLineIsPublishedOnce) {
  Published base;
  base.run(seconds(2));
  base.counts.clear();
  for (const char* const text : {"one", "two", "three"}) {
    ASSERT_TRUE(base.car->log(telemetry::make_event(telemetry::TextEvent{text}, base.now)));
    ASSERT_TRUE(base.base->requests().execute(command::Stop{}, kBea, base.now));
    base.run(milliseconds(200));
  }
  EXPECT_EQ(base.counts["event"], 3);
  EXPECT_EQ(base.counts["audit"], 3);
}

TEST(MessagePublisher, EntriesArePublishedEachMinute) {
  Published base;
  base.run(seconds(1));
  ASSERT_TRUE(base.base->requests().execute(command::ClaimAuthority{}, kBea, base.now));
  ASSERT_TRUE(base.base->requests().execute(command::ReportFuel{.litres = 40.0}, kBea, base.now));
  EXPECT_EQ(base.during(seconds(1))["expected"], 1);
  EXPECT_EQ(base.during(seconds(60))["expected"], 1);
}

}  // namespace
}  // namespace pitwall::service
