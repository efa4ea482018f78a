// SPDX-License-Identifier: Apache-2.0
#include "hil/scenario/cars_section.hpp"

#include <gtest/gtest.h>

#include <span>
#include <string>

#include "hil/scenario/scenario.hpp"

namespace pitwall::scenario {
namespace {

using traffic::Action;
using traffic::Trigger;

// The section begins in line 8.
Result<Scenario, Problem> with_cars(const std::string& section, int seed = 3) {
  return read_scenario("schema: 1\nname: short\nseed: " + std::to_string(seed) +
                           "\nduration_s: 20\ntrack: t.yaml\ncar: c.yaml\n"
                           "race_control: [{at_s: 0.5, track: red}]\n" +
                           section,
                       "short.yaml");
}

const std::string kShort =
    "name: rival, number: 2, kind: ghost, start: {s_m: 60}, speed: {mps: 44}";
std::string car(const std::string& more) { return "cars: [{" + kShort + ", " + more + "}]\n"; }

TEST(CarsSection, IsReadInFull) {
  const auto read = with_cars(
      "cars:\n"
      "  - name: rival\n"
      "    number: 7\n"
      "    kind: ghost\n"
      "    start: {s_m: 60, n_m: -3, speed_mps: 40}\n"
      "    line: inner/apex\n"
      "    offset_m: 0.5\n"
      "    speed: {lap_share: 0.9}\n"
      "    limits: {accel_mps2: 3, brake_mps2: 9, lateral_mps2: 5}\n"
      "    drift: {sigma_m: 0.2, correlation_s: 12, most_m: 0.6}\n"
      "    speed_drift: {sigma_mps: 0.3, correlation_s: 6, most_mps: 0.9}\n"
      "    size: {length_m: 5, width_m: 2}\n"
      "    seed: 11\n"
      "    script:\n"
      "      - {at_s: 10, do: speed, speed: {by_station: [{s_m: 0, mps: 30}, {s_m: 9, mps: 40}]}}\n"
      "      - {at_station_m: 800, do: line, offset_m: -2, over_s: 3}\n"
      "      - {gap_above_m: -40, do: brake, decel_mps2: 6, to_mps: 20}\n"
      "      - {gap_below_m: 15, do: stand}\n"
      "      - {at_s: 30, do: spin, decel_mps2: 7, turn_deg: -180}\n");
  ASSERT_TRUE(read) << to_string(read.error());
  ASSERT_EQ(read->cars.size(), 1u);
  EXPECT_EQ(read->cars[0].name, "rival");
  EXPECT_EQ(read->cars[0].number, 7);
  const traffic::GhostPlan& plan = read->cars[0].ghost;
  EXPECT_EQ(plan.start_s_m, 60.0);
  EXPECT_EQ(plan.start_n_m, -3.0);
  EXPECT_EQ(plan.start_mps, 40.0);
  EXPECT_EQ(plan.line.name, "inner/apex");
  EXPECT_EQ(plan.line.offset_m, 0.5);
  EXPECT_EQ(plan.speed.lap_share, 0.9);
  EXPECT_EQ(plan.limits.accel_mps2, 3.0);
  EXPECT_EQ(plan.limits.brake_mps2, 9.0);
  EXPECT_EQ(plan.limits.lateral_mps2, 5.0);
  EXPECT_EQ(plan.drift.sigma_m, 0.2);
  EXPECT_EQ(plan.drift.correlation_s, 12.0);
  EXPECT_EQ(plan.drift.most_m, 0.6);
  EXPECT_EQ(plan.speed_drift.sigma_mps, 0.3);
  EXPECT_EQ(plan.speed_drift.correlation_s, 6.0);
  EXPECT_EQ(plan.speed_drift.most_mps, 0.9);
  EXPECT_EQ(plan.length_m, 5.0);
  EXPECT_EQ(plan.width_m, 2.0);
  EXPECT_EQ(plan.seed, 11u);
  ASSERT_EQ(plan.script.size(), 5u);
  EXPECT_EQ(plan.script[0].trigger, Trigger::kTime);
  EXPECT_EQ(plan.script[0].value, 10.0);
  ASSERT_EQ(plan.script[0].speed.by_station.size(), 2u);
  EXPECT_EQ(plan.script[0].speed.by_station[1].mps, 40.0);
  EXPECT_EQ(plan.script[1].trigger, Trigger::kStation);
  EXPECT_EQ(plan.script[1].action, Action::kLine);
  EXPECT_EQ(plan.script[1].line.offset_m, -2.0);
  EXPECT_EQ(plan.script[1].over_s, 3.0);
  EXPECT_EQ(plan.script[1].place.substr(0, 14), "short.yaml:23:");
  EXPECT_EQ(plan.script[2].trigger, Trigger::kGapAbove);
  EXPECT_EQ(plan.script[2].value, -40.0);
  EXPECT_EQ(plan.script[2].decel_mps2, 6.0);
  EXPECT_EQ(plan.script[2].to_mps, 20.0);
  EXPECT_EQ(plan.script[3].trigger, Trigger::kGapBelow);
  EXPECT_EQ(plan.script[3].action, Action::kStand);
  EXPECT_EQ(plan.script[4].action, Action::kSpin);
  EXPECT_NEAR(plan.script[4].turn_rad, -3.14159265358979, 1e-12);
}

TEST(CarsSection, MayBeLeftOutAndHasDefaults) {
  EXPECT_TRUE(with_cars("")->cars.empty());
  EXPECT_TRUE(with_cars("cars: []\n")->cars.empty());
  const auto read = with_cars("cars: [{" + kShort + "}]\n");
  ASSERT_TRUE(read) << to_string(read.error());
  const traffic::GhostPlan& plan = read->cars[0].ghost;
  EXPECT_FALSE(plan.start_n_m);
  EXPECT_EQ(plan.drift.sigma_m, 0.0);
  EXPECT_EQ(plan.speed_drift.sigma_mps, 0.0);
  EXPECT_EQ(plan.length_m, plant::Chassis{}.length_m);
  EXPECT_TRUE(plan.script.empty());
  EXPECT_EQ(plan.seed, with_cars("cars: [{" + kShort + "}]\n")->cars[0].ghost.seed);
  EXPECT_NE(plan.seed, with_cars("cars: [{" + kShort + "}]\n", 4)->cars[0].ghost.seed);
}

TEST(CarsSection, ACarWithAStackHasFilesAndAStart) {
  const auto read = with_cars(
      "cars: [{name: b, number: 2, kind: stack, car: c.yaml, plant: p.yaml, "
      "start: {s_m: 70, n_m: -2}}]\n",
      3);
  ASSERT_TRUE(read) << to_string(read.error());
  ASSERT_TRUE(read->cars[0].stack);
  const StackPlan& plan = *read->cars[0].stack;
  EXPECT_EQ(plan.car_file, "c.yaml");
  EXPECT_EQ(plan.plant_file, "p.yaml");
  EXPECT_EQ(plan.start_s_m, 70.0);
  EXPECT_EQ(plan.start_n_m, -2.0);
  EXPECT_NE(plan.seed, 3u) << "of its own";
}

struct Refusal {
  std::string section, what;
};

void expect_refusals(std::span<const Refusal> refusals) {
  for (const Refusal& refusal : refusals) {
    const auto read = with_cars(refusal.section);
    ASSERT_FALSE(read) << refusal.section;
    EXPECT_EQ(read.error().place.substr(0, 13), "short.yaml:8:") << to_string(read.error());
    EXPECT_NE(to_string(read.error()).find(refusal.what), std::string::npos)
        << refusal.section << " -> " << to_string(read.error());
  }
}

TEST(CarsSection, EveryMistakeIsRefusedWithItsPlaceAndReason) {
  const auto entry = [](const std::string& text) { return car("script: [{" + text + "}]"); };
  std::string nine = "cars: [", many = "script: [";
  for (int i = 2; i <= 10; ++i)
    nine += "{name: c" + std::to_string(i) + ", number: " + std::to_string(i) +
            ", kind: ghost, start: {s_m: 60}, speed: {mps: 44}}, ";
  for (int i = 0; i < 17; ++i) many += "{at_s: 1, do: stand}, ";
  const std::string other = "number: 3, kind: ghost, start: {s_m: 60}, speed: {mps: 44}}]\n";
  const Refusal refusals[] = {
      {nine + "]\n", "at most 8"},
      {"cars: [{name: \"\", " + other, "is empty"},
      {"cars: [{" + other, "name"},
      {"cars: [{" + kShort + "}, {name: rival, " + other, "has this name"},
      {"cars: [{" + kShort +
           "}, {name: b, number: 2, kind: ghost, start: {s_m: 60}, "
           "speed: {mps: 44}}]\n",
       "has this number"},
      {"cars: [{name: b, number: 1, kind: ghost}]\n", "number: 1 is outside"},
      {"cars: [{name: b, number: 2, kind: human}]\n", "not one of: ghost, stack"},
      {"cars: [{name: b, number: 2, kind: ghost, speed: {mps: 4}}]\n", "start"},
      {"cars: [{name: b, number: 2, kind: ghost, start: {s_m: 1}}]\n", "speed"},
      {"cars: [{name: b, number: 2, kind: ghost, start: {n_m: 1}, speed: {mps: 4}}]\n", "s_m"},
      {"cars: [{name: b, number: 2, kind: ghost, start: {s_m: 1}, speed: {}}]\n",
       "one of: mps, lap_share, by_station"},
      {"cars: [{name: b, number: 2, kind: ghost, start: {s_m: 1}, "
       "speed: {mps: 4, lap_share: 1}}]\n",
       "one of: mps, lap_share, by_station"},
      {"cars: [{name: b, number: 2, kind: ghost, start: {s_m: 1}, speed: {by_station: []}}]\n",
       "1 to 256"},
      {"cars: [{name: b, number: 2, kind: ghost, start: {s_m: 1}, "
       "speed: {by_station: [{s_m: 5, mps: 1}, {s_m: 5, mps: 2}]}}]\n",
       "must rise"},
      {car("paint: red"), "paint"},
      {car("line: \"\""), "names no line"},
      {car("offset_m: 51"), "offset_m"},
      {car("limits: {brake_mps2: 0}"), "brake_mps2"},
      {car("limits: {jerk: 3}"), "jerk"},
      {car("drift: {sigma_m: 0.2}"), "most_m"},
      {car("speed_drift: {sigma_mps: 0.2, most_mps: 0.1}"), "most_mps"},
      {car("drift: {sigma_m: 0.2, most_m: 0.1}"), "most_m"},
      {car("size: {length_m: 5}"), "width_m"},
      {car("seed: -1"), "seed"},
      {car(many + "]"), "at most 16"},
      {entry("do: stand"), "one of: at_s"},
      {entry("at_s: 1, gap_above_m: 2, do: stand"), "one of: at_s"},
      {entry("at_s: 1"), "do"},
      {entry("at_s: 1, do: jump"), "not one of: speed, line"},
      {entry("at_s: 1, do: speed"), "speed"},
      {entry("at_s: 1, do: line"), "over_s"},
      {entry("at_s: 1, do: brake"), "decel_mps2"},
      {entry("at_s: 1, do: brake, decel_mps2: 9"), "above the car's limit"},
      {entry("at_s: 1, do: stand, to_mps: 3"), "to_mps"},
      {entry("at_s: 1, do: spin, decel_mps2: 5"), "turn_deg"},
      {entry("at_s: 1, do: spin, decel_mps2: 5, turn_deg: 90}, {at_s: 9, do: stand"),
       "nothing can follow a spin"},
  };
  expect_refusals(refusals);
}

TEST(CarsSection, EveryMistakeOfACarWithAStackIsRefused) {
  const Refusal refusals[] = {
      {"cars: [{name: b, number: 2, kind: stack}]\n", "car"},
      {"cars: [{name: ../b, number: 2, kind: stack, car: c.yaml, start: {s_m: 1}}]\n",
       "letters, digits"},
      {"cars: [{name: b, number: 2, kind: stack, car: \"\"}]\n", "names no file"},
      {"cars: [{name: b, number: 2, kind: stack, car: c.yaml}]\n", "start"},
      {"cars: [{name: b, number: 2, kind: stack, car: c.yaml, start: {n_m: 1}}]\n", "s_m"},
      {"cars: [{name: b, number: 2, kind: stack, car: c.yaml, start: {s_m: 1}, plant: \"\"}]\n",
       "names no file"},
      {"cars: [{name: b, number: 2, kind: stack, car: c.yaml, start: {s_m: 1}, "
       "speed: {mps: 4}}]\n",
       "speed"},
  };
  expect_refusals(refusals);
}

}  // namespace
}  // namespace pitwall::scenario
