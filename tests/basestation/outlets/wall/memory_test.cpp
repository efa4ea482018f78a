// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/wall/memory.hpp"

#include <gtest/gtest.h>

#include "basestation/replay/read_back.hpp"
#include "protocol/transport/file.hpp"
#include "tests/basestation/radio_rig.hpp"
#include "tests/basestation/replay/race.hpp"

namespace pitwall::outlets::wall {
namespace {

struct Base {
  RadioRig rig;
  std::unique_ptr<web::WebServer> web =
      *web::WebServer::start({.ip = transport::kLoopbackIp, .port = 0}, {});
  Wall wall{{}, *rig.station, *web};
};

TEST(Memory, AWallThatStartsAgainRemembersFieldsAndTrends) {
  const auto folder = transport::TemporaryFolder::create("pitwall_wall");
  Base base;
  replay::testing::record_race(folder->path(), seconds(6));
  Memory memory{base.wall};
  const Instant now = replay::testing::kRaceStart + seconds(7);
  const auto back = replay::read_back(folder->path(), replay::testing::kRaceClock, now,
                                      replay::kHistorySpan, memory);
  EXPECT_GT(back.messages, 1'000U);
  const auto field = telemetry::fields_of(telemetry::Group::kEgo).first + 1;
  const auto past = base.wall.trends().range(field, replay::testing::kRaceStart, now, 1'000);
  EXPECT_GT(past.size(), 20U);
}

}  // namespace
}  // namespace pitwall::outlets::wall
