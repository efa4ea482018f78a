// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/foxglove/foxglove_server.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "tests/basestation/publishers/foxglove/viewer.hpp"

namespace pitwall::publishers::foxglove {
namespace {

std::unique_ptr<FoxgloveServer> server() {
  auto started = FoxgloveServer::start({.name = "Pitwall", .clock = {.boot = "b"}});
  EXPECT_TRUE(started);
  return *std::move(started);
}

// One turn after a client has said something.
std::vector<PlaybackControl> turn_when_received(FoxgloveServer& server) {
  const int fd = server.fd();
  transport::wait_readable({&fd, 1}, transport::monotonic_now() + seconds(20));
  auto asked = server.receive();
  server.turn(Instant{}, Instant{});
  return asked;
}

TEST(FoxgloveDesk, WhatStandsIsToldToWhoComesLater) {
  const auto served = server();
  served->take(feed::Reported{.topic = recorder::Topic::kAlarms, .at = Instant{3}, .json = "{1}"});
  served->take(feed::Reported{.topic = recorder::Topic::kAlarms, .at = Instant{4}, .json = "{2}"});
  Viewer viewer;
  ASSERT_EQ(viewer.open(served->local().port), 101u);
  turn_when_received(*served);
  const auto channels = viewer.channels();
  viewer.subscribe(1, channels.at("/base/alarms"));
  turn_when_received(*served);
  EXPECT_EQ(viewer.bytes(1).substr(kMessageHeader), "{2}");
}

TEST(FoxgloveDesk, AClientThatDoesNotReadIsToldWhichTopicsItLost) {
  const auto served = server();
  Viewer slow;
  ASSERT_EQ(slow.open(served->local().port), 101u);
  turn_when_received(*served);
  const auto channels = slow.channels();
  slow.subscribe(1, channels.at("/base/audit"));
  turn_when_received(*served);
  const std::string line(20'000, 'x');
  for (int i = 0; i < 1'500; ++i) {
    served->take(feed::Reported{.topic = recorder::Topic::kAudit, .at = Instant{i}, .json = line});
    served->turn(Instant{}, Instant{});
  }
  std::string status;
  // What the sockets' thread has not come to yet is lost a moment later.
  for (Instant now{seconds(1).ns}; status.empty(); now += FoxgloveServer::kLossEvery) {
    served->turn(now, Instant{});
    while (const auto incoming = slow.web_client().receive()) {
      if (!incoming->text && incoming->bytes[0] == 2) break;  // the time of this turn
      if (incoming->text) status += incoming->bytes;
    }
    ASSERT_LT(now, Instant{seconds(60).ns});
  }
  EXPECT_NE(status.find("/base/audit"), std::string::npos) << status;
  EXPECT_NE(status.find(R"("level": 1)"), std::string::npos);
  const auto figures = served->figures();
  ASSERT_EQ(figures.dropped.size(), 1U);
  EXPECT_EQ(figures.dropped[0].first, "/base/audit");
  EXPECT_GT(figures.dropped[0].second, 100U);
}

TEST(FoxgloveDesk, NobodyIsThereNothingIsSent) {
  const auto served = server();
  feed::Sample sample{.received = Instant{}};
  served->take(sample);
  served->turn(Instant{seconds(1).ns}, Instant{});
  EXPECT_EQ(served->figures().sent, 0U);
  EXPECT_EQ(served->figures().clients, 0U);
}

}  // namespace
}  // namespace pitwall::publishers::foxglove
