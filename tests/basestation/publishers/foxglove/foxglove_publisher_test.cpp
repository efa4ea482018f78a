// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/foxglove/foxglove_publisher.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "protocol/transport/clock.hpp"
#include "tests/basestation/publishers/foxglove/viewer.hpp"
#include "tests/basestation/radio_rig.hpp"

namespace pitwall::publishers::foxglove {
namespace {

using telemetry::Group;

std::unique_ptr<FoxglovePublisher> publisher(FoxglovePublisher::ReadStatus read_status = {}) {
  auto started =
      FoxglovePublisher::start({.name = "Pitwall", .clock = {.boot = "b"}}, std::move(read_status));
  EXPECT_TRUE(started) << to_string(started.error());
  return *std::move(started);
}

void sample(FoxglovePublisher& publisher) {
  telemetry::Snapshot state;
  telemetry::GroupSet groups;
  groups.add(Group::kEgo);
  state.at(Group::kEgo) = Instant{seconds(1).ns};
  publisher.feed().sample(state, groups, Instant{seconds(1).ns});
}

TEST(FoxglovePublisher, AClientSeesWhatTheCarSays) {
  const auto served = publisher();
  Viewer viewer;
  ASSERT_EQ(viewer.open(served->local().port), 101u);
  const auto channels = viewer.channels();
  EXPECT_EQ(viewer.info().text("name"), "Pitwall");
  viewer.subscribe(4, channels.at("/car/ego"));
  std::atomic<bool> seen = false;
  std::thread car{[&] {
    while (!seen) {
      sample(*served);
      transport::sleep_until(transport::monotonic_now() + milliseconds(5));
    }
  }};
  const std::string message = viewer.bytes(1);
  seen = true;
  car.join();
  EXPECT_EQ(message.at(1), 4);
  EXPECT_EQ(message.size(), kMessageHeader + recorder::encode(Group::kEgo, {}).size());
}

TEST(FoxglovePublisher, BothNamesOfTheProtocolAreSpokenAndNoOther) {
  const auto served = publisher();
  const std::uint16_t port = served->local().port;
  for (const std::string_view name : kSubprotocols) {
    Viewer viewer;
    EXPECT_EQ(viewer.open(port, std::string{name}), 101u) << name;
  }
  EXPECT_NE(Viewer{}.open(port, "foxglove.websocket.v2"), 101u);
  EXPECT_NE(Viewer{}.open(port, "foxglove.sdk.v1", "https://evil.com"), 101u);
  EXPECT_EQ(Viewer{}.open(port, "foxglove.sdk.v1", "http://localhost:8080"), 101u);
}

TEST(FoxglovePublisher, WhatIsRefusedIsToldAndCounted) {
  const auto served = publisher();
  Viewer viewer;
  ASSERT_EQ(viewer.open(served->local().port), 101u);
  viewer.web_client().send_text(R"({"op":"advertise","channels":[]})");
  EXPECT_NE(viewer.text("status").text("message").find("read only"), std::string::npos);
  viewer.web_client().send_bytes(std::string("\1\0\0\0\0cmd", 8));
  EXPECT_EQ(viewer.text("status").number("level"), 2.0);
  viewer.web_client().send_text("nonsense");
  EXPECT_NE(viewer.text("status").text("message").find("message"), std::string::npos);
  viewer.bytes(2);
  viewer.bytes(2);  // figures are told after each turn
  std::uint64_t published = 0, malformed = 0;
  const service::PublisherFigures figures = *served->figures();
  for (const auto& [what, count] : figures.refused) {
    if (what == "clientPublish") published = count;
    if (what == "malformed") malformed = count;
  }
  EXPECT_EQ(published, 2U);
  EXPECT_EQ(malformed, 1U);
}

TEST(FoxglovePublisher, TheBaseIsLookedAtTenTimesASecond) {
  int looks = 0;
  const auto served = publisher([&](ros_view::BaseStatus&, Instant) { ++looks; });
  RadioRig rig;
  for (Instant now{seconds(100).ns}; now < Instant{seconds(101).ns}; now += milliseconds(10)) {
    served->publish(*rig.base, now);
  }
  EXPECT_EQ(looks, 10);
}

TEST(FoxglovePublisher, APortThatIsTakenIsSaid) {
  const auto first = publisher();
  const auto second = FoxglovePublisher::start({.listen = first->local(), .clock = {.boot = "b"}});
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().place, "--foxglove");
}

}  // namespace
}  // namespace pitwall::publishers::foxglove
