// SPDX-License-Identifier: Apache-2.0
#include "basestation/settings/cars_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/support/replaced.hpp"

namespace pitwall::settings {
namespace {

constexpr const char* kTwo = R"(cars:
  - number: 7
    name: Blue
    keys: keys/7/base.keys
    stamp_file: state/7.stamp
    listen: ["127.0.0.1:23431", "127.0.0.1:23432"]
    track: tracks/own.yaml
    record: /var/7
    judgement: seven.yaml
    budget_kbit_s: 128
    joystick: /dev/input/event3
    stop_port: 23437
  - number: 8
    keys: keys/8/base.keys
    listen: ["127.0.0.1:23441"]
    signed: true
)";

Result<std::vector<Arguments>, Problem> read(std::string_view text, const Arguments& whole = {}) {
  return read_cars_text(text, "cars.yaml", "race", whole);
}

TEST(CarsFile, EachCarHasTheCommandLineWithItsOwnWordsInIt) {
  Arguments whole;
  whole.web_port = 8080;
  whole.track = "lvms";
  whole.budget_kbit = 300.0;
  whole.cars_file = "race/cars.yaml";
  const auto cars = read(kTwo, whole);
  ASSERT_TRUE(cars) << to_string(cars.error());
  ASSERT_EQ(cars->size(), 2u);
  const Arguments& first = cars->front();
  EXPECT_EQ(first.car, 7);
  EXPECT_EQ(first.car_name, "Blue");
  EXPECT_EQ(first.keys, "race/keys/7/base.keys") << "beside the file";
  EXPECT_EQ(first.stamp_file, "race/state/7.stamp");
  EXPECT_EQ(first.listen.size(), 2u);
  EXPECT_EQ(first.track, "race/tracks/own.yaml");
  EXPECT_EQ(first.record_folder, "/var/7");
  EXPECT_EQ(first.judgement_file, "race/seven.yaml");
  EXPECT_EQ(first.budget_kbit, 128.0);
  EXPECT_EQ(first.joystick, "/dev/input/event3");
  EXPECT_EQ(first.stop_port, 23'437);
  EXPECT_EQ(first.web_port, 8080);
  const Arguments& second = cars->back();
  EXPECT_EQ(second.car, 8);
  EXPECT_EQ(second.track, "lvms") << "that of all";
  EXPECT_EQ(second.budget_kbit, 300.0);
  EXPECT_TRUE(second.signed_only);
  EXPECT_FALSE(first.signed_only);
  EXPECT_TRUE(second.stamp_file.empty()) << "beside its keys";
  EXPECT_TRUE(second.record_folder.empty());
  EXPECT_TRUE(second.joystick.empty());
}

TEST(CarsFile, WithoutAFileTheCommandLineIsTheCar) {
  Arguments whole;
  whole.car = 3;
  const auto cars = cars_of(whole);
  ASSERT_TRUE(cars);
  ASSERT_EQ(cars->size(), 1u);
  EXPECT_EQ(cars->front().car, 3);
}

TEST(CarsFile, IsReadFromItsFolder) {
  const std::filesystem::path folder =
      std::filesystem::path{::testing::TempDir()} / ("cars_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  Arguments whole;
  whole.cars_file = folder / "cars.yaml";
  EXPECT_FALSE(cars_of(whole)) << "there is none";
  std::ofstream{whole.cars_file} << kTwo;
  const auto cars = cars_of(whole);
  ASSERT_TRUE(cars) << to_string(cars.error());
  EXPECT_EQ(cars->back().keys, (folder / "keys/8/base.keys").string());
  EXPECT_TRUE(cars->back().cars_file.empty());
  std::filesystem::remove_all(folder);
}

TEST(CarsFile, NoTwoCarsShareAnything) {
  const std::string two = kTwo;
  for (const auto& [what, with] : std::vector<std::pair<std::string, std::string>>{
           {"number: 8", "number: 7"},
           {"keys/8/base.keys", "keys/8/../7/base.keys"},
           {"23441", "23432"},
           {"signed: true", "record: /var/7"},
           {"signed: true", "stamp_file: ./state/7.stamp"},
           {"signed: true", "judgement: ./seven.yaml"},
           {"signed: true", "joystick: /dev/input/event3"},
           {"signed: true", "stop_port: 23437"}}) {
    const auto cars = read(testing::replaced(two, what, with));
    ASSERT_FALSE(cars) << with;
    EXPECT_NE(cars.error().what.find("is used by another car"), std::string::npos) << with;
    EXPECT_EQ(cars.error().place.find("cars.yaml:1"), 0u) << cars.error().place;
  }
}

TEST(CarsFile, CarsMayKeepNoStamps) {
  const auto cars = read(
      "cars:\n  - {number: 1, keys: a, stamp_file: none}\n"
      "  - {number: 2, keys: b, stamp_file: none, listen: [\"127.0.0.1:0\"]}\n");
  ASSERT_TRUE(cars) << to_string(cars.error());
  EXPECT_EQ(cars->front().stamp_file, kNoStampFile);
  EXPECT_EQ(cars->back().stamp_file, kNoStampFile);
}

TEST(CarsFile, TwoMayListenAtAnyPortThatIsFree) {
  EXPECT_TRUE(
      read("cars:\n  - {number: 1, keys: a, listen: [\"127.0.0.1:0\"]}\n"
           "  - {number: 2, keys: b, listen: [\"127.0.0.1:0\"]}\n"));
  EXPECT_FALSE(read("cars:\n  - {number: 1, keys: a}\n  - {number: 2, keys: b}\n"))
      << "the same usual address";
}

TEST(CarsFile, MistakesAreToldWithTheirPlace) {
  const std::string two = kTwo;
  for (const std::string& text :
       {std::string{"cars: []\n"}, std::string{"cars:\n"}, std::string{"car: 7\n"},
        testing::replaced(two, "number: 8", "number: 256"),
        testing::replaced(two, "number: 8", "number: -1"),
        testing::replaced(two, "    keys: keys/8/base.keys\n", ""),
        testing::replaced(two, "signed: true", "x: 1"),
        testing::replaced(two, "budget_kbit_s: 128", "budget_kbit_s: 63"),
        testing::replaced(two, "budget_kbit_s: 128", "budget_kbit_s: .nan"),
        testing::replaced(two, "[\"127.0.0.1:23441\"]", "[]"),
        testing::replaced(two, "stop_port: 23437", "stop_port: 0")}) {
    const auto cars = read(text);
    ASSERT_FALSE(cars) << text;
    EXPECT_EQ(cars.error().place.find("cars.yaml"), 0u) << text;
  }
  std::string five = "cars:\n";
  for (int car = 1; car <= 5; ++car) {
    five += "  - {number: " + std::to_string(car) + ", keys: k" + std::to_string(car) + "}\n";
  }
  EXPECT_FALSE(read(five));
}

}  // namespace
}  // namespace pitwall::settings
