// The benchmark of players, end to end and short: every player complete and in order, figures that
// fit together. How fast anybody is depends on the machine and is not asked here.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>

#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall {
namespace {

void expect_quantiles(yaml::StrictMap figures) {
  double before_us = 0.0;
  for (const char* key : {"p50_us", "p90_us", "p99_us", "max_us"}) {
    const double value_us = figures.number(key, 0.0, 1e9);
    EXPECT_GE(value_us, before_us) << key;
    before_us = value_us;
  }
  EXPECT_GT(before_us, 0.0);
}

// Of 2 s: 330 datagrams a second, three times.
void expect_whole(yaml::StrictMap sensors) {
  std::vector<yaml::StrictMap> runs = sensors.maps("runs");
  ASSERT_EQ(runs.size(), 1U);
  for (yaml::StrictMap& receiver : runs[0].maps("receivers")) {
    EXPECT_EQ(receiver.integer("arrived", 900, 1'100), receiver.integer("wanted", 900, 1'100));
    EXPECT_EQ(receiver.integer("lost", 0, 1'000'000), 0);
    EXPECT_EQ(receiver.integer("extra", 0, 1'000'000), 0);
    EXPECT_TRUE(receiver.flag("in_order"));
  }
  yaml::StrictMap order = runs[0].map("order");
  EXPECT_EQ(order.integer("broken", 0, 1'000'000), 0);
  EXPECT_GT(order.integer("shown", 0, 1'000'000), 0);
}

TEST(BenchReplay, EveryPlayerIsCompleteAndInOrder) {
  const char* program = std::getenv("PITWALL_BENCH_PROGRAM");
  ASSERT_NE(program, nullptr);
  auto folder = transport::TemporaryFolder::create("pitwall-bench-");
  ASSERT_TRUE(folder.has_value());
  const std::string file = folder->path() + "/figures.json";
  auto bench = transport::Process::spawn(
      {.argv = {program, "replay", "--length", "2", "--runs", "1", "--json", file}});
  ASSERT_TRUE(bench.has_value());
  const int code = bench->wait().shell_code();
  ASSERT_TRUE(code == 0 || code == 1) << code;  // 1: a gate of time was missed
  const auto json = yaml::load_file(file);
  ASSERT_TRUE(json) << to_string(json.error());
  yaml::StrictMap map = json->root();
  const std::int64_t frames = map.integer("frames", 4'000, 6'000);
  std::vector<yaml::StrictMap> players = map.maps("players");
  ASSERT_EQ(players.size(), 4U);
  for (yaml::StrictMap& player : players) {
    const std::string name{player.text("name")};
    SCOPED_TRACE(name);
    const std::int64_t passes = name == "pitwall-hil + sensors" ? 3 : 1;
    expect_quantiles(player.map("lateness"));
    expect_quantiles(player.map("gap_error"));
    std::vector<yaml::StrictMap> runs = player.maps("runs");
    ASSERT_EQ(runs.size(), 1U);
    EXPECT_EQ(runs[0].integer("arrived", 0, 1'000'000), passes * frames);
    EXPECT_EQ(runs[0].integer("lost", 0, 1'000'000), 0);
    EXPECT_EQ(runs[0].integer("extra", 0, 1'000'000), 0);
    EXPECT_TRUE(runs[0].flag("in_order"));
  }
  expect_whole(map.map("sensors"));
  yaml::StrictMap own = map.map("own_report");
  EXPECT_EQ(own.integer("sent", 0, 1'000'000), frames);
  // Bursts share calls: there are never more of them than frames.
  EXPECT_LE(own.integer("calls", 1, 1'000'000), frames);
  EXPECT_EQ(map.flag("held"), code == 0);
}

}  // namespace
}  // namespace pitwall
