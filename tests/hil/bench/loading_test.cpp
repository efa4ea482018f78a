// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/loading.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/file.hpp"
#include "tests/hil/bench/flying_lap.hpp"
#include "vehicle/parameters/car_file.hpp"
#include "vehicle/parameters/car_setup.hpp"
#include "vehicle/parameters/track_file.hpp"
#include "vehicle/raceline/bank_builder.hpp"
#include "vehicle/raceline/bank_file.hpp"

namespace pitwall::bench {
namespace {

// A folder of its own with the shipped scenario, track and car, to be spoilt.
class Loading : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(folder_);
    scenario_ = text_of("hil/scenarios/lvms_flying_lap.yaml");
    replace(scenario_, "vehicle/config/tracks/lvms.yaml", "track.yaml");
    replace(scenario_, "vehicle/config/cars/av21.yaml", "car.yaml");
    track_ = text_of("vehicle/config/tracks/lvms.yaml");
    car_ = text_of("vehicle/config/cars/av21.yaml");
  }

  static std::string text_of(const std::string& path) {
    const auto text = transport::read_file(kRoot + "/" + path);
    EXPECT_TRUE(text);
    return *text;
  }
  static void replace(std::string& text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  }
  std::string path(const std::string& name) const { return folder_->path() + "/" + name; }

  Result<Loaded, Problem> load_all() {
    EXPECT_TRUE(transport::write_file(path("scenario.yaml"), scenario_));
    EXPECT_TRUE(transport::write_file(path("track.yaml"), track_));
    EXPECT_TRUE(transport::write_file(path("car.yaml"), car_));
    return load(path("scenario.yaml"), folder_->path());
  }
  std::string refusal() {
    const auto loaded = load_all();
    return loaded ? "" : to_string(loaded.error());
  }
  void expect_refusal(const std::string& place, const std::string& word) {
    const std::string text = refusal();
    EXPECT_NE(text.find(place), std::string::npos) << "\"" << text << "\" lacks " << place;
    EXPECT_NE(text.find(word), std::string::npos) << "\"" << text << "\" lacks " << word;
  }

  Result<transport::TemporaryFolder, Problem> folder_ =
      transport::TemporaryFolder::create("pitwall-loading-");
  std::string scenario_, track_, car_;
};

TEST_F(Loading, FindsTrackAndCarBelowTheFolder) {
  const auto loaded = load_all();
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(loaded->scenario.name, "lvms_flying_lap");
  EXPECT_NEAR(loaded->setup.track.length_m(), 2454.3, 1.0);
}

TEST_F(Loading, TakesAbsoluteNamesAsTheyAre) {
  replace(scenario_, "track.yaml", kRoot + "/vehicle/config/tracks/ims.yaml");
  const auto loaded = load_all();
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_GT(loaded->setup.track.length_m(), 3'000.0);
}

TEST_F(Loading, AMissingFileIsNamed) {
  const auto none = load(path("none.yaml"), "");
  ASSERT_FALSE(none);
  EXPECT_NE(to_string(none.error()).find(path("none.yaml")), std::string::npos);
  replace(scenario_, "track.yaml", "no_track.yaml");
  expect_refusal(path("no_track.yaml"), "error");
  replace(scenario_, "no_track.yaml", "track.yaml");
  replace(scenario_, "car.yaml", "no_car.yaml");
  expect_refusal(path("no_car.yaml"), "error");
}

TEST_F(Loading, AFolderIsNoFile) {
  replace(scenario_, "track.yaml", ".");
  EXPECT_NE(refusal(), "");
}

TEST_F(Loading, ABadScenarioIsToldWithItsLine) {
  const std::string good = scenario_;
  replace(scenario_, "seed: 7", "sead: 7");
  expect_refusal("scenario.yaml:", "se");
  scenario_ = good;
  replace(scenario_, "track: orange", "track: purple");
  expect_refusal("scenario.yaml:13:", "purple");
  scenario_ = good;
  replace(scenario_, "duration_s: 180", "duration_s: -1");
  expect_refusal("scenario.yaml:6:", "duration_s");
  scenario_ = good;
  replace(scenario_, "schema: 1", "schema: 2");
  expect_refusal("scenario.yaml:3:", "schema 1");
  scenario_ = good + "\n  - [unclosed";
  expect_refusal("scenario.yaml:", "error");
  scenario_.clear();
  expect_refusal("scenario.yaml", "error");
}

TEST_F(Loading, ABadTrackIsToldWithItsLine) {
  replace(track_, "length_m: 2454.3", "length_m: 24543");
  expect_refusal("track.yaml", "error");
  track_ = text_of("vehicle/config/tracks/lvms.yaml");
  replace(track_, "{s_m: 50, curvature_per_m: 0.00210", "{s_m: 50, curvature_per_m: no");
  expect_refusal("track.yaml:20:", "curvature_per_m");
}

TEST_F(Loading, ABadCarIsToldWithItsLine) {
  replace(car_, "vehicle_number: 21", "vehicle_number: -3");
  expect_refusal("car.yaml:", "vehicle_number");
  car_ = text_of("vehicle/config/cars/av21.yaml");
  replace(car_, "steering_ratio: 19.5", "steering_ratios: 19.5");
  expect_refusal("car.yaml:", "steering_ratio");
}

TEST_F(Loading, ThePlantIsTheBuiltInOneOrThatOfItsFile) {
  EXPECT_EQ(load_all()->scenario.plant.chassis.mass_kg, plant::Params{}.chassis.mass_kg);
  scenario_ += "plant: plant.yaml\n";
  expect_refusal(path("plant.yaml"), "error");
  const std::string head = "schema: 1\nname: light\nbase: av21\nchassis:\n  mass_kg: {value: ";
  ASSERT_TRUE(transport::write_file(path("plant.yaml"), head + "700, source: a scale}\n"));
  const auto loaded = load_all();
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(loaded->scenario.plant.chassis.mass_kg, 700.0);
  ASSERT_TRUE(transport::write_file(path("plant.yaml"), head + "-700, source: a scale}\n"));
  expect_refusal("plant.yaml:5:", "chassis.mass_kg");
}

// The lines of a bank leave room for the width of the car file; the walls meet the modelled one.
TEST_F(Loading, TheCarAndItsModelAreOfOneWidth) {
  replace(car_, "width_m: 1.93", "width_m: 1.83");
  expect_refusal("car.yaml", "width_m is 1.830, but the modelled car is 1.930 m wide");
}

TEST_F(Loading, ABankIsReadFromBesideTheCarFile) {
  replace(car_, "    offset_m: 0.0\n", "    bank: <track>.json\n    name: inner/apex\n");
  expect_refusal(path("track.json"), "error");
  const auto car = parameters::read_car(car_, path("car.yaml"));
  const auto track = parameters::read_track(track_, path("track.yaml"));
  const auto map = world::TrackMap::build(*track);
  const auto bank = raceline::build_bank(*track, *map, parameters::bank_for(car->params));
  ASSERT_TRUE(bank) << to_string(bank.error());
  ASSERT_TRUE(transport::write_file(path("track.json"), raceline::to_json(*bank)));
  const auto loaded = load_all();
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(bank->lines[loaded->setup.line.number - 1].name, "inner/apex");
}

}  // namespace
}  // namespace pitwall::bench
