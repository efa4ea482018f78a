// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/console/replay_console.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "protocol/transport/file.hpp"
#include "tests/basestation/replay/race.hpp"
#include "tests/support/web_client.hpp"

namespace pitwall::publishers::console {
namespace {

std::unique_ptr<web::WebServer> server() {
  web::HttpConfig http;
  http.cars.push_back({.number = 7});
  auto started = web::WebServer::start({.ip = kLoopbackIp, .port = 0}, std::move(http));
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

TEST(ReplayConsole, ItHasNoPagesOfABench) {
  const auto folder = transport::TemporaryFolder::create("pitwall_wall");
  replay::testing::record_race(folder->path(), seconds(1));
  const auto web = server();
  ReplayConsole console{
      {}, *replay::Player::open(folder->path()), service::RecordingIndex{std::nullopt}, *web};
  std::string answer;
  std::atomic<bool> answered = false;
  std::thread browser([&] {
    answer = web::bare(web->local().port,
                       "GET /bench/7/runs/1/report.html HTTP/1.1\r\nHost: 127.0.0.1\r\n"
                       "Connection: close\r\n\r\n",
                       false);
    answered = true;
  });
  while (!answered) console.serve(milliseconds(1));
  browser.join();
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 404")) << answer;
  EXPECT_TRUE(answer.ends_with("a replay has no bench server\n"));
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
