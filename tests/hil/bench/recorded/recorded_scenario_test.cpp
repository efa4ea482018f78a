// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/recorded_scenario.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace pitwall::bench {
namespace {

const ScenarioSource kSource{"out/race", {.car = "cars/\"my\" car.yaml", .track = "lvms.yaml"}};

RunFacts facts() {
  RunFacts out;
  out.first_frame = milliseconds(250);
  out.length = seconds(30);
  out.start = {.known_at = milliseconds(400), .s_m = 2250.004, .n_m = -0.126, .speed_mps = 0.0};
  out.tyres_c = 84.96;
  out.flags = {{.at = milliseconds(500), .track = world::TrackFlag::kRed},
               {.at = seconds(9),
                .track = world::TrackFlag::kYellow,
                .vehicle = world::VehicleFlag::kBlackPitIn,
                .round_target_speed_mph = 60.0}};
  out.modes = {{Duration{}, 0.0}, {milliseconds(400), 1.0}, {seconds(9), 2.0}, {seconds(30), 3.0}};
  out.speed_max_mps = 20.0;
  out.off_line_max_m = 0.25;
  return out;
}

scenario::Scenario read(const RunFacts& from) {
  const std::string text = scenario_text(from, kSource);
  auto scenario = scenario::read_scenario(text, "made");
  EXPECT_TRUE(scenario) << to_string(scenario.error()) << "\n" << text;
  return scenario ? *scenario : scenario::Scenario{};
}

TEST(RecordedScenario, IsReadByTheBenchAsTheRunWas) {
  const scenario::Scenario made = read(facts());
  EXPECT_EQ(made.duration, seconds(30));
  EXPECT_EQ(made.car_file, kSource.files.car);
  EXPECT_EQ(made.track_file, "lvms.yaml");
  EXPECT_NEAR(made.start.s_m, 2250.0, 0.005);
  EXPECT_NEAR(made.start.n_m, -0.13, 0.005);
  EXPECT_NEAR(made.tyres.temperature_c, 85.0, 0.05);
  ASSERT_EQ(made.race_control.size(), 2U);
  EXPECT_EQ(made.race_control[1].at, seconds(9));
  EXPECT_EQ(made.race_control[1].vehicle, world::VehicleFlag::kBlackPitIn);
  EXPECT_EQ(made.race_control[1].round_target_speed_mph, 60.0);
  EXPECT_TRUE(made.operator_texts.empty());
}

TEST(RecordedScenario, ExpectsTheModesTheSpeedAndTheLineWithTheirSlack) {
  const auto expect = read(facts()).expect;
  // Two changes, and not the one at the end; three modes that were not; two speeds; the line.
  ASSERT_EQ(expect.size(), 2U + 3U + 3U);
  EXPECT_EQ(expect[0].kind, grading::Kind::kWithin);
  EXPECT_EQ(expect[0].condition.number, 1.0);
  EXPECT_EQ(expect[0].from, Instant{});
  EXPECT_EQ(expect[1].condition.number, 2.0);
  EXPECT_EQ(expect[1].from, Instant{} + seconds(8));
  EXPECT_EQ(expect[1].to, Instant{} + seconds(10));
  EXPECT_EQ(expect[2].kind, grading::Kind::kNever);
  EXPECT_EQ(expect[2].condition.number, 4.0);
  EXPECT_EQ(expect[5].condition.number, 18.0);
  EXPECT_EQ(expect[6].condition.number, 22.0);
  EXPECT_EQ(expect[7].condition.signal, "abs_cross_track_m");
  EXPECT_EQ(expect[7].condition.number, 0.75);
}

TEST(RecordedScenario, AnOperatorTakesTheAuthorityBeforeItsFirstCommand) {
  RunFacts with = facts();
  with.operator_texts = {{seconds(12), "command speed_limit 20"}, {seconds(20), "stop controlled"}};
  const auto texts = read(with).operator_texts;
  ASSERT_GT(texts.size(), 10U) << "it renews it";
  EXPECT_EQ(texts.front().text, "take 1");
  EXPECT_EQ(texts.front().at, seconds(10));
  EXPECT_EQ(std::ranges::count(texts, "command speed_limit 20", &scenario::OperatorText::text), 1);
  EXPECT_EQ(std::ranges::count(texts, "stop controlled", &scenario::OperatorText::text), 1);
}

TEST(RecordedScenario, ItsHeaderNamesTheSourceAndWhatIsNotThere) {
  RunFacts lacking = facts();
  lacking.tyres_c = kUnset;
  lacking.joystick_ticks = 7;
  lacking.guardian_ticks = 3;
  const std::string text = scenario_text(lacking, kSource);
  for (const char* part :
       {"recording out/race", "0.25 s after its first tick", "No recording tells",
        "joystick was used in 7 ticks", "guardian drove in 3 ticks", "# Tyres: "})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  EXPECT_EQ(text.find("\ntyres:"), std::string::npos);
  EXPECT_EQ(scenario_text(facts(), {"a\nschema: 2", {}}).find("\nschema: 2"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::bench
