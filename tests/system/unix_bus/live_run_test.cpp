// A live run as a user starts it on a machine without CAN: the bench brings the hub and the car,
// and the verdicts are those of lockstep.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "protocol/transport/file.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall {
namespace {

namespace fs = std::filesystem;
constexpr const char* kScenario = "hil/scenarios/launch_and_stop.yaml";
constexpr const char* kLength = " --duration 15";  // the car is let go at 11 s

std::string program() {
  const char* path = std::getenv("PITWALL_BENCH_PROGRAM");
  return path == nullptr ? std::string(PITWALL_SOURCE_DIR) + "/build/release/hil/pitwall-hil"
                         : path;
}

struct Run {
  std::vector<std::pair<std::string, bool>> verdicts;
  std::int64_t to_car = 0, from_car = 0, lost = -1, bus_losses = -1, refusals = -1;
  double speed_max_mps = 0.0;
};

Result<Run, Problem> read_run(const std::string& file) {
  const auto document = yaml::load_file(file);
  if (!document) return Unexpected{document.error()};
  yaml::StrictMap map = document->root();
  Run out;
  for (yaml::StrictMap& v : map.maps("verdicts"))
    out.verdicts.emplace_back(v.text("text"), v.flag("pass"));
  yaml::StrictMap can = map.map("can");
  out.to_car = can.integer("to_car", 0, 1'000'000);
  out.from_car = can.integer("from_car", 0, 1'000'000);
  out.lost = can.integer("lost", 0, 1'000'000);
  out.bus_losses = map.integer("bus_losses", 0, 1'000'000);
  out.refusals = map.integer("bus_refusals", 0, 1'000'000);
  out.speed_max_mps = map.number("speed_max_mps", 0.0, 200.0);
  return out;
}

std::vector<std::string> failed(const Run& run) {
  std::vector<std::string> out;
  for (const auto& [text, pass] : run.verdicts)
    if (!pass) out.push_back(text);
  return out;
}

TEST(LiveRun, OnItsOwnHubGivesTheVerdictsOfLockstepAndLosesNothing) {
  auto folder = transport::TemporaryFolder::create("pitwall-unix-live-");
  ASSERT_TRUE(folder);
  const std::string f = folder->path();
  const std::string run = "'" + program() + "' run " + kScenario + kLength;
  // Neither ends with 0: what the scenario expects later than 15 s has not held yet.
  std::system((run + " --json " + f + "/lockstep.json > " + f + "/lockstep.txt 2>&1").c_str());
  const std::string live_run = run + " --live --candump --record " + f +
                               "/record --interface unix:" + f + "/bus --out " + f +
                               "/out --json " + f + "/live.json > " + f + "/live.txt 2>&1";
  std::system(live_run.c_str());
  const auto lockstep = read_run(f + "/lockstep.json");
  const auto live = read_run(f + "/live.json");
  const std::string output = transport::read_file(f + "/live.txt").value_or("");
  ASSERT_TRUE(lockstep) << to_string(lockstep.error());
  ASSERT_TRUE(live) << to_string(live.error()) << "\n" << output;
  EXPECT_EQ(live->verdicts, lockstep->verdicts) << output;
  EXPECT_EQ(failed(*live),
            (std::vector<std::string>{"within 17 s speed_mps > 34, from 11 s, to 28 s",
                                      "within 16 s speed_mps < 0.5, from 28 s, to 44 s"}))
      << "what the scenario expects later than 15 s, and nothing else";
  EXPECT_GE(live->verdicts.size(), 6u);
  EXPECT_EQ(live->lost, 0) << output;
  EXPECT_EQ(live->bus_losses, 0) << output;
  EXPECT_EQ(live->refusals, 0) << output;
  EXPECT_GT(live->to_car, 10'000);
  EXPECT_GT(live->from_car, 8'000);
  EXPECT_GT(live->speed_max_mps, 10.0);  // it drove
  EXPECT_NEAR(live->speed_max_mps, lockstep->speed_max_mps, 1.0);
  // The hub says what it did, and leaves nothing behind.
  EXPECT_NE(output.find(", 0 dropped, 0 malformed packets refused;"), std::string::npos) << output;
  EXPECT_FALSE(fs::exists(f + "/bus"));
  // candump speaks SocketCAN only: told, not failed.
  EXPECT_NE(output.find("candump"), std::string::npos) << output;
  EXPECT_FALSE(fs::exists(f + "/out/candump.log"));
  // What the car recorded of itself, driven again by the same build: not a bit differs.
  const std::string compare =
      "'" + program() + "' compare " + f + "/record > " + f + "/compare.txt 2>&1";
  EXPECT_EQ(std::system(compare.c_str()), 0);
  const std::string compared = transport::read_file(f + "/compare.txt").value_or("");
  EXPECT_NE(compared.find("frames and "), std::string::npos) << compared;
  EXPECT_NE(compared.find(": 0 signals differ"), std::string::npos) << compared;
}

}  // namespace
}  // namespace pitwall
