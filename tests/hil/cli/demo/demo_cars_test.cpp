// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/demo/demo_cars.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "protocol/yaml/strict_map.hpp"

namespace pitwall::cli {
namespace {

TEST(DemoCars, OneIsWhereADemoAlwaysWas) {
  const auto cars = demo_cars(1, "out/demo", DemoBus::kVcan);
  ASSERT_EQ(cars.size(), 1u);
  EXPECT_EQ(cars[0].folder, "out/demo");
  EXPECT_EQ(cars[0].interface(), "vcan0");
  EXPECT_EQ(cars[0].line_ports(), "23531:23431:23429:23532");
}

class DemoBuses : public testing::TestWithParam<DemoBus> {};

TEST_P(DemoBuses, NoTwoHaveAnythingInCommon) {
  std::set<std::string> taken;
  std::size_t claimed = 0;
  const auto claim = [&](const std::string& what) {
    taken.insert(what);
    ++claimed;
  };
  for (const DemoCar& car : demo_cars(kDemoCarsMax, "out/demo", GetParam())) {
    for (const int port : {car.base_port, car.uplink_port, car.guest_uplink_port, car.radio_port}) {
      claim(std::to_string(port));
    }
    claim(car.folder);
    claim(car.name);
    claim("number " + std::to_string(car.number));
    claim(car.interface());
  }
  EXPECT_EQ(taken.size(), claimed);
}

INSTANTIATE_TEST_SUITE_P(Both, DemoBuses, testing::Values(DemoBus::kVcan, DemoBus::kSocket));

TEST(DemoCars, SeveralTakeSocketsWhereAGuestForEachWouldFallBehind) {
  EXPECT_EQ(bus_for(1, 1), DemoBus::kVcan);
  EXPECT_EQ(bus_for(2, 2), DemoBus::kSocket);
  EXPECT_EQ(bus_for(2, 3), DemoBus::kSocket);
  EXPECT_EQ(bus_for(2, 4), DemoBus::kVcan);
  EXPECT_EQ(bus_for(2, 0), DemoBus::kSocket) << "a machine that does not tell";
  EXPECT_EQ(demo_cars(2, "out/demo", DemoBus::kSocket)[1].interface(), "unix:out/demo/car_8/bus");
}

TEST(DemoCars, TheRecordingsOfTheDemoBeforeAreKeptAside) {
  namespace fs = std::filesystem;
  const fs::path folder =
      fs::temp_directory_path() / ("pitwall-demo-cars-" + std::to_string(getpid()));
  fs::create_directory(folder);
  const DemoCar car = demo_cars(1, folder.string(), DemoBus::kVcan).front();
  ASSERT_TRUE(set_recordings_aside(car)) << "there was no demo yet";
  for (const fs::path recording : {car.base_recording(), car.own_recording()}) {
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
  fs::remove_all(folder);
}

TEST(DemoCars, TheBasesFileNamesEachWithItsOwn) {
  const auto cars = demo_cars(2, "out/demo", DemoBus::kVcan);
  const auto document = yaml::load_text(cars_text(cars), "cars.yaml");
  ASSERT_TRUE(document) << to_string(document.error());
  auto rows = document->root().maps("cars");
  ASSERT_EQ(rows.size(), 2u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string place = "car_" + std::to_string(cars[i].number);
    EXPECT_EQ(rows[i].integer("number", 0, 255), cars[i].number);
    EXPECT_EQ("out/demo/" + place, cars[i].folder);
    for (const char* const key : {"keys", "record", "judgement", "json"}) {
      EXPECT_EQ(rows[i].text(key).find(place + "/"), 0u) << key;
    }
    EXPECT_NE(rows[i].texts("listen", 1, 2)[0].find(std::to_string(cars[i].base_port)),
              std::string::npos);
  }
}

}  // namespace
}  // namespace pitwall::cli
