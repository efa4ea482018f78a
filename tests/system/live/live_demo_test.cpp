// SPDX-License-Identifier: Apache-2.0
// The demo as a user runs it, for a short scenario: real vcan, separate processes, a base station
// that hears the car; and what candump saw on the bus, read by python3-can and decoded by
// python3-canmatrix, is what our own decoder says.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "hil/replay/formats/candump.hpp"
#include "protocol/can/dbc_parser.hpp"
#include "protocol/can/decode.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall {
namespace {

namespace fs = std::filesystem;
const std::string kRoot = PITWALL_SOURCE_DIR;
constexpr const char* kScenario = "hil/scenarios/launch_and_stop.yaml";
constexpr int kEvery = 7;  // every seventh frame is decoded: canmatrix is slow, 7 meets every id

std::string program() {
  const char* path = std::getenv("PITWALL_BENCH_PROGRAM");
  return path == nullptr ? kRoot + "/build/release/hil/pitwall-hil" : path;
}

int run(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

struct Figures {
  std::vector<std::pair<std::string, bool>> verdicts;
  std::int64_t to_car = 0, from_car = 0, lost = -1;
};

Figures read_run(yaml::StrictMap map) {
  Figures f;
  for (yaml::StrictMap& v : map.maps("verdicts"))
    f.verdicts.emplace_back(v.text("text"), v.flag("pass"));
  yaml::StrictMap can = map.map("can");
  f.to_car = can.integer("to_car", 0, 1'000'000'000);
  f.from_car = can.integer("from_car", 0, 1'000'000'000);
  f.lost = can.integer("lost", 0, 1'000'000'000);
  return f;
}

class LiveDemo : public ::testing::Test {
 protected:
  // One run of the demo serves every test of this file.
  static void SetUpTestSuite() {
    folder_ = fs::path(kRoot) / "out" / "test_live";
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    code_ =
        run("'" + program() + "' demo --headless --duration 45 --scenario " + kScenario +
            " --out '" + folder_.string() + "' --json '" + (folder_ / "demo.json").string() + "'");
  }

  static fs::path folder_;
  static int code_;
};
fs::path LiveDemo::folder_;
int LiveDemo::code_ = -1;

TEST_F(LiveDemo, EveryExpectationHoldsAndNoFrameIsLost) {
  ASSERT_EQ(code_, 0);
  const auto document = yaml::load_file(folder_ / "demo.json");
  ASSERT_TRUE(document) << to_string(document.error());
  const Figures live = read_run(document->root().map("run"));
  EXPECT_GE(live.verdicts.size(), 6u);
  for (const auto& [text, pass] : live.verdicts) EXPECT_TRUE(pass) << text;
  EXPECT_EQ(live.lost, 0);
  EXPECT_GT(live.to_car, 40'000);
  EXPECT_GT(live.from_car, 30'000);
  EXPECT_EQ(document->root().integer("candump_frames", 0, 1'000'000'000),
            live.to_car + live.from_car);
}

TEST_F(LiveDemo, TheBaseStationHearsTheCar) {
  const auto document = yaml::load_file(folder_ / "base.json");
  ASSERT_TRUE(document) << to_string(document.error());
  yaml::StrictMap base = document->root();
  EXPECT_EQ(base.text("source"), "simulation");
  EXPECT_GT(base.integer("packets", 0, 1'000'000'000), 45 * 50 * 9 / 10);
  EXPECT_EQ(base.integer("lost", 0, 1'000'000'000), 0);
  EXPECT_EQ(base.integer("refused", 0, 1'000'000'000), 0);
}

TEST_F(LiveDemo, LockstepGivesTheSameVerdicts) {
  const std::string json = (folder_ / "lockstep.json").string();
  ASSERT_EQ(run("'" + program() + "' run " + kScenario + " --duration 45 --json '" + json +
                "' > /dev/null"),
            0);
  const auto live = yaml::load_file(folder_ / "run.json");
  const auto lockstep = yaml::load_file(json);
  ASSERT_TRUE(live && lockstep);
  EXPECT_EQ(read_run(live->root()).verdicts, read_run(lockstep->root()).verdicts);
}

TEST_F(LiveDemo, CanmatrixDecodesTheCandumpToOurValues) {
  const auto text = transport::read_file((folder_ / "candump.log").string());
  ASSERT_TRUE(text) << to_string(text.error());
  const auto log = replay::read_candump(*text, "candump.log");
  ASSERT_TRUE(log) << to_string(log.error());
  const std::string dbc = kRoot + "/protocol/can/dbc/av21.dbc";
  const auto database = can::parse_dbc(*transport::read_file(dbc), dbc);
  ASSERT_TRUE(database) << to_string(database.error());

  const std::string decoded = (folder_ / "decoded.txt").string();
  ASSERT_EQ(run("/usr/bin/python3 '" + kRoot + "/tests/system/live/decode_candump.py' '" + dbc +
                "' '" + (folder_ / "candump.log").string() + "' " + std::to_string(kEvery) +
                " > '" + decoded + "' 2> /dev/null"),
            0);
  std::istringstream lines(*transport::read_file(decoded));
  std::size_t compared = 0, total = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first;
    words >> first;
    if (first == "total") {
      words >> total;
      continue;
    }
    std::uint32_t id = 0;
    words >> id;
    const can::Frame& frame = log->frames[std::stoul(first)].frame;
    ASSERT_EQ(frame.id, id);
    for (const can::Message& message : database->messages) {
      if (message.id != id || message.extended) continue;
      for (std::string pair; words >> pair;) {
        const auto equals = pair.find('=');
        for (const can::Signal& signal : message.signals) {
          if (signal.name != pair.substr(0, equals)) continue;
          EXPECT_NEAR(can::decode(signal, frame), std::stod(pair.substr(equals + 1)), 1e-9)
              << pair << " in frame " << first;
          ++compared;
        }
      }
    }
  }
  EXPECT_EQ(total, log->frames.size());
  EXPECT_GT(compared, 20'000u);
}

}  // namespace
}  // namespace pitwall
