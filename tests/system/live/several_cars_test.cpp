// Several cars in one live run, as a user starts it: a car and ghosts on real SocketCAN; two full
// stacks, each on a Unix bus of its own, at one base station.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "protocol/json/json_value.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr std::int64_t kMany = 1'000'000;

struct Car {
  std::vector<std::pair<std::string, bool>> verdicts;
  std::int64_t to_car = 0, from_car = 0, lost = -1, bus_losses = -1, refusals = -1;
  std::int64_t ticks = 0, missed = -1;
  double speed_max_mps = 0.0;
};

Car read_car(yaml::StrictMap& map) {
  Car out;
  for (yaml::StrictMap& verdict : map.maps("verdicts"))
    out.verdicts.emplace_back(verdict.text("text"), verdict.flag("pass"));
  yaml::StrictMap can = map.map("can");
  out.to_car = can.integer("to_car", 0, kMany);
  out.from_car = can.integer("from_car", 0, kMany);
  out.lost = can.integer("lost", 0, kMany);
  out.bus_losses = map.integer("bus_losses", 0, kMany);
  out.refusals = map.integer("bus_refusals", 0, kMany);
  out.speed_max_mps = map.number("speed_max_mps", 0.0, 200.0);
  if (!map.has("real_time")) return out;  // lockstep
  yaml::StrictMap time = map.map("real_time");
  out.ticks = time.integer("ticks", 0, kMany);
  out.missed = time.integer("missed_deadlines", 0, kMany);
  return out;
}

class SeveralCars : public testing::Test {
 protected:
  // The run in lockstep, and with the words `live`: what is lost, and whether both are the same.
  void run_both(const std::string& scenario, int seconds, std::size_t cars, const Words& live) {
    const Words common{"hil/scenarios/" + scenario + ".yaml", "--cut", "--duration",
                       std::to_string(seconds)};
    Words words = common;
    words.insert(words.end(), {"--json", path("lockstep.json")});
    ASSERT_EQ(run(words), 0);
    words = common;
    words.insert(words.end(), {"--live", "--json", path("live.json"), "--out", path("out")});
    words.insert(words.end(), live.begin(), live.end());
    ASSERT_EQ(run(words), 0);
    const std::vector<Car> virtual_cars = cars_of("lockstep.json"), real = cars_of("live.json");
    ASSERT_EQ(virtual_cars.size(), cars);
    ASSERT_EQ(real.size(), cars);
    for (std::size_t i = 0; i < cars; ++i) {
      SCOPED_TRACE(i);
      expect_whole(real[i], seconds);
      EXPECT_EQ(real[i].verdicts, virtual_cars[i].verdicts);
      EXPECT_GT(virtual_cars[i].speed_max_mps, 1.0) << "it drove";
      EXPECT_NEAR(real[i].speed_max_mps, virtual_cars[i].speed_max_mps, 1.0);
    }
  }

  int run(const Words& words) {
    const char* program = std::getenv("PITWALL_BENCH_PROGRAM");
    if (program == nullptr) return ADD_FAILURE() << "PITWALL_BENCH_PROGRAM is not set", -1;
    Words argv{program, "run"};
    argv.insert(argv.end(), words.begin(), words.end());
    auto process = transport::Process::spawn({.argv = argv, .folder = PITWALL_SOURCE_DIR});
    return process ? process->wait().shell_code() : -1;
  }
  std::string path(const std::string& name) const { return folder_.path() + "/" + name; }

  // Of our car, then of the others.
  std::vector<Car> cars_of(const std::string& file) {
    const auto document = yaml::load_file(path(file));
    EXPECT_TRUE(document) << (document ? "" : to_string(document.error()));
    if (!document) return {};
    yaml::StrictMap root = document->root();
    EXPECT_TRUE(root.flag("passed"));
    std::vector<Car> cars{read_car(root)};
    if (root.has("others"))
      for (yaml::StrictMap& other : root.maps("others")) cars.push_back(read_car(other));
    return cars;
  }

  // Of the match of a run, as they ended.
  std::vector<std::string> attempts_of(const std::string& file) {
    const auto result = json::JsonValue::parse(transport::read_file(path(file)).value_or(""), file);
    EXPECT_TRUE(result) << (result ? "" : to_string(result.error()));
    std::vector<std::string> out;
    const json::JsonValue* const match = result ? result->find("match") : nullptr;
    if (match == nullptr) return out;
    for (const json::JsonValue& attempt : match->items("attempts"))
      out.push_back(attempt.text("attacker") + " " + attempt.text("ending"));
    return out;
  }

  static void expect_whole(const Car& car, int seconds) {
    EXPECT_EQ(car.lost, 0);
    EXPECT_EQ(car.bus_losses, 0);
    EXPECT_EQ(car.refusals, 0);
    EXPECT_GT(car.to_car, 700 * seconds);
    EXPECT_GT(car.from_car, 600 * seconds);
    EXPECT_GE(car.ticks, 99 * seconds);
    EXPECT_LE(100 * car.missed, car.ticks);
  }

  void expect_base_hears(const std::string& file, int packets) {
    const auto document = yaml::load_file(path(file));
    ASSERT_TRUE(document) << to_string(document.error());
    yaml::StrictMap base = document->root();
    EXPECT_GT(base.integer("packets", 0, kMany), packets);
    EXPECT_EQ(base.integer("lost", 0, kMany), 0);
    EXPECT_EQ(base.integer("refused", 0, kMany), 0) << "of the other car's keys";
  }

  transport::TemporaryFolder folder_ = *transport::TemporaryFolder::create("pitwall-cars-");
};

TEST_F(SeveralCars, TwoStacksRaceOnABusEachAtOneBaseStation) {
  constexpr int kSeconds = 52;  // the first attempt is over
  run_both("matches/competition_two_stacks", kSeconds, 2,
           {"--interface", "unix:" + path("bus"), "--log", path("events.mcap"), "--sensors",
            "vehicle/config/sensors/av21.yaml"});
  EXPECT_EQ(attempts_of("live.json"), (std::vector<std::string>{"own passed"}));
  EXPECT_GT(fs::file_size(path("events.mcap")), 100'000u);
  EXPECT_GT(fs::file_size(path("events.rival.mcap")), 100'000u);
  EXPECT_FALSE(fs::exists(path("bus")) || fs::exists(path("bus.rival"))) << "hubs are gone";
  constexpr int kPackets = kSeconds * 50 * 9 / 10;
  expect_base_hears("out/base.json", kPackets);
  expect_base_hears("out/rival/base.json", kPackets);
}

TEST_F(SeveralCars, OneDrivesAmongGhostsOnSocketCan) {
  run_both("five_ghosts", 12, 1, {});
  const auto document = yaml::load_file(path("live.json"));
  ASSERT_TRUE(document);
  EXPECT_EQ(document->root().integer("other_cars", 0, 9), 5);
}

}  // namespace
}  // namespace pitwall
