// What can be told of the live bench without a CAN interface: what is refused, and that then
// nothing has been started. The rest runs where CAN is (tests/system/live).
// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/live.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "protocol/transport/file.hpp"
#include "tests/hil/bench/flying_lap.hpp"

namespace pitwall::bench {
namespace {

// A car that would leave a trace if it were started.
struct Trap {
  Result<transport::TemporaryFolder, Problem> folder =
      transport::TemporaryFolder::create("pitwall-live-");
  std::string trace = folder->path() + "/started";
  std::size_t logged = 0;

  LivePlan plan() {
    return {.interface = "no_such_can",
            .vehicle = {"/usr/bin/touch", trace},
            .folder = folder->path(),
            .candump = true,
            .log = [this](std::span<const std::uint8_t> bytes) {
              return logged += bytes.size(), true;
            }};
  }
  bool untouched() const { return std::filesystem::is_empty(folder->path()) && logged == 0; }
};

TEST(Live, AnInterfaceThatDoesNotExistIsAProblemThatNamesIt) {
  Trap trap;
  const auto run = run_live(lap(), trap.plan());
  ASSERT_FALSE(run);
  EXPECT_NE(to_string(run.error()).find("no_such_can"), std::string::npos)
      << to_string(run.error());
  EXPECT_TRUE(trap.untouched());
}

TEST(Live, WhatTheBenchDoesNotKnowIsRefusedBeforeTheBusIsOpened) {
  Trap trap;
  scenario::Scenario wrong = lap().scenario;
  wrong.expect[0].signal = "speed_of_light";
  const auto signal = run_live(Loaded{wrong, lap().setup}, trap.plan());
  ASSERT_FALSE(signal);
  EXPECT_NE(to_string(signal.error()).find("speed_of_light"), std::string::npos);

  wrong = lap().scenario;
  wrong.faults.push_back({.kind = "earthquake", .place = "x.yaml:3:1"});
  const auto fault = run_live(Loaded{wrong, lap().setup}, trap.plan());
  ASSERT_FALSE(fault);
  EXPECT_EQ(fault.error().place, "x.yaml:3:1");

  wrong = lap().scenario;
  wrong.receivers.emplace();
  const auto receivers = run_live(Loaded{wrong, lap().setup}, trap.plan());
  ASSERT_FALSE(receivers);
  EXPECT_EQ(receivers.error().place, "receivers");
  EXPECT_TRUE(trap.untouched());
}

}  // namespace
}  // namespace pitwall::bench
