// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/wall/replay_wall.hpp"

#include <gtest/gtest.h>

#include "basestation/outlets/wall/memory.hpp"
#include "basestation/outlets/wall/recording.hpp"
#include "basestation/replay/read_back.hpp"
#include "protocol/transport/file.hpp"
#include "tests/basestation/radio_rig.hpp"
#include "tests/basestation/replay/race.hpp"

namespace pitwall::outlets::wall {
namespace {

std::unique_ptr<web::WebServer> server() {
  auto started = web::WebServer::start({.ip = transport::kLoopbackIp, .port = 0}, {});
  EXPECT_TRUE(started);
  return *std::move(started);
}

TEST(ReplayWall, GoesOnWithTheTimeThatPasses) {
  const auto folder = transport::TemporaryFolder::create("pitwall_wall");
  replay::testing::record_race(folder->path(), seconds(6));
  const auto web = server();
  ReplayWall wall{{}, *replay::Player::open(folder->path()), *web};
  EXPECT_EQ(wall.player().now(), replay::testing::kRaceStart);
  for (int i = 0; i < 100; ++i) wall.serve(milliseconds(40));
  EXPECT_EQ(wall.player().now(), replay::testing::kRaceStart + seconds(4));
  for (int i = 0; i < 100; ++i) wall.serve(milliseconds(40));
  EXPECT_TRUE(wall.player().ended());
}

TEST(Recording, AWallThatStartsAgainRemembersFieldsTrendsAndLogs) {
  const auto folder = transport::TemporaryFolder::create("pitwall_wall");
  RadioRig rig;
  const auto web = server();
  Wall wall{{}, *rig.station, *web};
  replay::testing::record_race(folder->path(), seconds(6));
  Memory memory{wall};
  const Instant now = replay::testing::kRaceStart + seconds(7);
  const auto back = replay::read_back(folder->path(), replay::testing::kRaceClock, now,
                                      replay::kHistorySpan, memory);
  EXPECT_GT(back.messages, 1'000U);
  const auto field = telemetry::fields_of(telemetry::Group::kEgo).first + 1;
  const auto past = wall.trends().range(field, replay::testing::kRaceStart, now, 1'000);
  EXPECT_GT(past.size(), 20U);
  std::vector<std::string> said;
  auto recorder = start_recording(folder->path() + "/new", {}, &wall,
                                  [&](const std::string& line) { said.push_back(line); });
  ASSERT_TRUE(recorder);
  EXPECT_TRUE(said.empty());  // there was nothing
  wall.room().record_with({});
}

}  // namespace
}  // namespace pitwall::outlets::wall
