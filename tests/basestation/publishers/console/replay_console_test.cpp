// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/console/replay_console.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/file.hpp"
#include "tests/basestation/replay/race.hpp"

namespace pitwall::publishers::console {
namespace {

std::unique_ptr<web::WebServer> server() {
  auto started = web::WebServer::start({.ip = kLoopbackIp, .port = 0}, {});
  EXPECT_TRUE(started);
  return *std::move(started);
}

TEST(ReplayConsole, GoesOnWithTheTimeThatPasses) {
  const auto folder = transport::TemporaryFolder::create("pitwall_wall");
  replay::testing::record_race(folder->path(), seconds(6));
  const auto web = server();
  ReplayConsole console{
      {}, *replay::Player::open(folder->path()), service::RecordingIndex{std::nullopt}, *web};
  EXPECT_EQ(console.player().now(), replay::testing::kRaceStart);
  for (int i = 0; i < 100; ++i) console.serve(milliseconds(40));
  EXPECT_EQ(console.player().now(), replay::testing::kRaceStart + seconds(4));
  for (int i = 0; i < 100; ++i) console.serve(milliseconds(40));
  EXPECT_TRUE(console.player().ended());
}

struct Other : replay::Listener {
  int states = 0, texts = 0, restarts = 0;
  void state(const telemetry::Snapshot&, telemetry::GroupSet, Instant) override { ++states; }
  void text(recorder::Topic, Instant, std::string_view) override { ++texts; }
  void restart(Instant) override { ++restarts; }
};

TEST(ReplayConsole, AToolIsToldTheSameAndMayWind) {
  const auto folder = transport::TemporaryFolder::create("pitwall_wall");
  replay::testing::record_race(folder->path(), seconds(6));
  const auto web = server();
  ReplayConsole console{
      {}, *replay::Player::open(folder->path()), service::RecordingIndex{std::nullopt}, *web};
  Other other;
  console.tell_also(other);
  for (int i = 0; i < 50; ++i) console.serve(milliseconds(40));
  EXPECT_GT(other.states, 50);
  EXPECT_EQ(other.restarts, 0);
  console.control_playback(0.0, replay::testing::kRaceStart + seconds(1));
  EXPECT_EQ(other.restarts, 1);
  console.serve(seconds(1));
  EXPECT_EQ(console.player().now(), replay::testing::kRaceStart + seconds(1)) << "it pauses there";
  console.control_playback(2.0, std::nullopt);
  console.serve(seconds(1));
  EXPECT_EQ(console.player().now(), replay::testing::kRaceStart + seconds(3));
}

}  // namespace
}  // namespace pitwall::publishers::console
