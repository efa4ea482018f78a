// SPDX-License-Identifier: Apache-2.0
#include "vehicle/parameters/car_layers.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "tests/vehicle/parameters/mutation.hpp"

namespace pitwall::parameters {
namespace {

using testing::av21;

// Files by their path.
using Files = std::map<std::string, std::string>;

ReadFile reader(const Files& files) {
  return [&files](const std::string& path) -> Result<std::string, Problem> {
    const auto at = files.find(path);
    if (at == files.end()) return refuse(path, "no such file");
    return at->second;
  };
}

Result<CarFile, Problem> load(const Files& files, const std::string& path = "cars/race.yaml") {
  return load_car(path, reader(files));
}

std::string refusal(const Files& files) {
  const auto car = load(files);
  return car ? std::string{} : to_string(car.error());
}

Files with_race(const std::string& text) {
  return {{"cars/av21.yaml", av21()}, {"cars/race.yaml", text}};
}

TEST(CarLayers, WhatAFileDoesNotWriteIsThatOfTheOneItIsLike) {
  const auto car =
      load(with_race("schema: 1\nlike: av21.yaml\nname: Racer\n"
                     "planning: {line: {speed_max_mps: 81}}\n"));
  ASSERT_TRUE(car) << to_string(car.error());
  const CarFile plain = *read_car(av21(), "av21.yaml");
  EXPECT_EQ(car->name, "Racer");
  EXPECT_EQ(car->source, "cars/race.yaml");
  EXPECT_EQ(car->params.planning.line.speed_max_mps, 81.0);
  EXPECT_EQ(car->params.planning.line.grip_share, plain.params.planning.line.grip_share);
  EXPECT_EQ(car->params.control.lap.gain, plain.params.control.lap.gain);
  EXPECT_EQ(plain.text, av21());
}

TEST(CarLayers, AListIsReplacedAsAWhole) {
  const std::string why =
      refusal(with_race("like: av21.yaml\ngateway: {inbound: {wheel_speed_mps: [0, 100, 120]}}\n"));
  EXPECT_NE(why.find("3 entries, expected 2"), std::string::npos) << why;
}

TEST(CarLayers, AKeyIsTakenAwayByNothing) {
  const auto car =
      load(with_race("like: av21.yaml\nplanning:\n  line:\n    offset_m: ~\n"
                     "    bank: a.json\n    name: inner/apex\n"));
  ASSERT_TRUE(car) << to_string(car.error());
  EXPECT_EQ(car->params.planning.line.bank, "a.json");
  const std::string why = refusal(with_race("like: av21.yaml\nplanning:\n  line: {ofset_m: ~}\n"));
  EXPECT_EQ(why.rfind("cars/race.yaml:3:10: error: unknown key", 0), 0u) << why;
}

TEST(CarLayers, ABadKeyIsToldWithTheFileAndTheLineThatItStandsIn) {
  const Files wrong{{"cars/av21.yaml", testing::with(av21(), "mass_kg: 790.0", "mass_kg: -1")},
                    {"cars/race.yaml", "like: av21.yaml\n"}};
  const std::string below = refusal(wrong);
  EXPECT_EQ(below.rfind("cars/av21.yaml:9:", 0), 0u) << below;
  const std::string above = refusal(with_race("like: av21.yaml\n\nbicycle: {mass_kg: -1}\n"));
  EXPECT_EQ(above.rfind("cars/race.yaml:3:20:", 0), 0u) << above;
  const std::string unknown = refusal(with_race("like: av21.yaml\nbicycle: {mas_kg: 800}\n"));
  EXPECT_EQ(unknown.rfind("cars/race.yaml:2:11: error: unknown key", 0), 0u) << unknown;
  const std::string twice = refusal(with_race("like: av21.yaml\nname: a\nname: b\n"));
  EXPECT_EQ(twice.rfind("cars/race.yaml:3:", 0), 0u) << twice;
  const std::string kind = refusal(with_race("like: av21.yaml\nplanning: fast\n"));
  EXPECT_EQ(kind.rfind("cars/race.yaml:2:11: error: planning: expected a mapping", 0), 0u) << kind;
}

TEST(CarLayers, FilesMayBeInOtherFoldersAndOfSeveralSteps) {
  const Files files{{"cars/race.yaml", "like: ../base/b.yaml\nname: c\n"},
                    {"base/b.yaml", "like: a/a.yaml\nname: b\nbicycle: {mass_kg: 801}\n"},
                    {"base/a/a.yaml", av21()}};
  const auto car = load(files);
  ASSERT_TRUE(car) << to_string(car.error());
  EXPECT_EQ(car->name, "c");
  EXPECT_EQ(car->params.control.bicycle.mass_kg, 801.0);
}

TEST(CarLayers, RefusesAMissingFileACircleAndALongChain) {
  const auto expect = [](const Files& files, const std::string& why) {
    EXPECT_EQ(refusal(files), why);
  };
  expect({}, "cars/race.yaml: error: no such file");
  expect({{"cars/race.yaml", "name: a\nlike: gone.yaml\n"}},
         "cars/race.yaml:2:7: error: like: cars/gone.yaml: no such file");
  expect({{"cars/race.yaml", "like: \"\"\n"}}, "cars/race.yaml:1:7: error: like: names no file");
  expect({{"cars/race.yaml", "like: ../cars/race.yaml\n"}},
         "cars/race.yaml:1:7: error: like: cars/race.yaml is like this file itself; expected no "
         "circle");
  expect({{"cars/race.yaml", "like: b.yaml\n"}, {"cars/b.yaml", "\nlike: race.yaml\n"}},
         "cars/b.yaml:2:7: error: like: cars/race.yaml is like this file itself; expected no "
         "circle");
  Files chain{{"cars/race.yaml", "like: 1.yaml\n"}};
  for (std::size_t i = 1; i < kCarFilesMost; ++i)
    chain["cars/" + std::to_string(i) + ".yaml"] = "like: " + std::to_string(i + 1) + ".yaml\n";
  chain["cars/" + std::to_string(kCarFilesMost) + ".yaml"] = av21();
  expect(chain,
         "cars/3.yaml:1:7: error: like: cars/4.yaml is file 5 of a chain; expected 4 or "
         "fewer");
  chain["cars/3.yaml"] = av21();
  expect(chain, "");
}

TEST(CarLayers, TheTextHoldsAllFiles) {
  const Files files = with_race("like: av21.yaml\n");
  EXPECT_EQ(load(files)->text, "like: av21.yaml\n\n# ---- av21.yaml\n" + av21());
}

TEST(CarLayers, TheRacingCarThatShipsDiffersInItsPaceAndPasses) {
  const std::string folder = PITWALL_SOURCE_DIR "/vehicle/config/cars/";
  const auto car = load_car(folder + "av21_race.yaml",
                            [](const std::string& path) -> Result<std::string, Problem> {
                              std::ifstream file(path, std::ios::binary);
                              if (!file) return refuse(path, "cannot be opened");
                              return std::string{std::istreambuf_iterator<char>(file), {}};
                            });
  ASSERT_TRUE(car) << to_string(car.error());
  const planning::Params plain = read_car(av21(), "av21.yaml")->params.planning;
  EXPECT_TRUE(car->params.planning.passing);
  EXPECT_GT(car->params.planning.line.speed_max_mps, plain.line.speed_max_mps);
  EXPECT_GT(car->params.planning.racing.accel_max_mps2, plain.racing.accel_max_mps2);
}

}  // namespace
}  // namespace pitwall::parameters
