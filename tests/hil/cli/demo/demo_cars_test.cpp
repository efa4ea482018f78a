// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/demo/demo_cars.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "basestation/inputs/command_script.hpp"
#include "hil/cli/live/car_plans.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/yaml/strict_map.hpp"
#include "tests/hil/cli/live/shipped_scenario.hpp"

namespace pitwall::cli {
namespace {

TEST(DemoCars, OneIsWhereADemoAlwaysWas) {
  const auto cars = demo_cars(shipped("matches/competition"), "out/demo");
  ASSERT_EQ(cars.size(), 1u) << "a ghost has no station";
  EXPECT_EQ(cars[0].folder, "out/demo");
  EXPECT_EQ(cars[0].base_recording(), "out/demo/recording");
  EXPECT_EQ(cars[0].own_recording, "out/demo/car_recording");
  EXPECT_EQ(cars[0].base_port, kDemoBasePort);
}

TEST(DemoCars, TwoAreWhereTheirRunPutsThemAndHaveNothingInCommon) {
  const bench::Loaded two = shipped("matches/competition_two_stacks");
  const auto cars = demo_cars(two, "out/demo");
  RunOptions options;
  options.interface = "unix:out/demo/bus";
  options.folder = "out/demo";
  options.keys = "out/demo/keys";
  options.record_folder = "out/demo/car_recording";
  options.radio_port = kDemoBasePort;
  options.sensors_file = std::string(PITWALL_SOURCE_DIR) + "/vehicle/config/sensors/av21.yaml";
  const auto plans = plans_of(options, two);
  ASSERT_TRUE(plans) << to_string(plans.error());
  ASSERT_EQ(cars.size(), 2u);
  ASSERT_EQ(plans->size(), 2u);
  std::set<std::string> taken;
  for (std::size_t i = 0; i < cars.size(); ++i) {
    const bench::LivePlan& plan = (*plans)[i];
    EXPECT_EQ(plan.folder, cars[i].folder);
    EXPECT_EQ(plan.keys, cars[i].keys);
    EXPECT_EQ(plan.radio[0].onward, cars[i].base_port);
    EXPECT_NE(std::ranges::find(plan.vehicle, cars[i].own_recording), plan.vehicle.end());
    for (const std::string& own :
         {cars[i].folder, cars[i].keys, cars[i].name, cars[i].own_recording,
          std::to_string(cars[i].base_port), "number " + std::to_string(cars[i].number)})
      EXPECT_TRUE(taken.insert(own).second) << own;
  }
}

TEST(DemoCars, TheRecordingsOfTheDemoBeforeAreKeptAside) {
  namespace fs = std::filesystem;
  const auto made = transport::TemporaryFolder::create("pitwall-demo-cars-");
  ASSERT_TRUE(made);
  const DemoCar car = demo_cars(shipped("matches/competition"), made->path()).front();
  ASSERT_TRUE(set_recordings_aside(car)) << "there was no demo yet";
  for (const fs::path recording : {car.base_recording(), car.own_recording}) {
    const fs::path before = recording.string() + "_before";
    for (const char* const segment : {"first.mcap", "second.mcap"}) {
      fs::create_directory(recording);
      std::ofstream{recording / segment} << "bytes";
      ASSERT_TRUE(set_recordings_aside(car));
      EXPECT_FALSE(fs::exists(recording));
      EXPECT_TRUE(fs::exists(before / segment));
    }
    EXPECT_FALSE(fs::exists(before / "first.mcap")) << "one demo is kept, not all";
  }
}

TEST(DemoCars, TheBasesFileNamesEachWithItsOwn) {
  const auto cars = demo_cars(shipped("matches/competition_two_stacks"), "out/demo");
  const auto document = yaml::load_text(cars_text(cars), "cars.yaml");
  ASSERT_TRUE(document) << to_string(document.error());
  auto rows = document->root().maps("cars");
  ASSERT_EQ(rows.size(), 2u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].integer("number", 0, 255), cars[i].number);
    EXPECT_EQ("out/demo/" + rows[i].text("keys"), cars[i].keys + "/base.keys");
    EXPECT_EQ("out/demo/" + rows[i].text("record"), cars[i].base_recording());
    EXPECT_EQ("out/demo/" + rows[i].text("json"), cars[i].folder + "/base.json");
    EXPECT_NE(rows[i].texts("listen", 1, 2)[0].find(std::to_string(cars[i].base_port)),
              std::string::npos);
    EXPECT_EQ(rows[i].text_or("command", "none"), i == 0 ? "operator.txt" : "none");
  }
}

TEST(DemoCars, TheBasesOperatorSaysWhatTheScenarioHasHimSay) {
  const bench::Loaded loaded = shipped("matches/competition");
  ASSERT_EQ(demo_cars(loaded, "out/demo").front().commands, "out/demo/operator.txt");
  auto script =
      inputs::CommandScript::parse(commands_text(loaded.scenario.operator_texts), "operator.txt");
  ASSERT_TRUE(script) << to_string(script.error());
  for (const scenario::OperatorText& row : loaded.scenario.operator_texts) {
    EXPECT_EQ(script->due(), row.at);
    EXPECT_EQ(script->next(row.at), " " + row.text);
  }
  EXPECT_FALSE(script->due());
  EXPECT_EQ(demo_cars(shipped("launch_and_stop"), "out/demo").front().commands, "");
}

}  // namespace
}  // namespace pitwall::cli
