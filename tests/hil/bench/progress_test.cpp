// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/progress.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "hil/bench/lockstep/lockstep.hpp"
#include "protocol/json/json_value.hpp"
#include "tests/hil/bench/flying_lap.hpp"

namespace pitwall::bench {
namespace {

using json::JsonValue;

JsonValue parsed(const std::string& line) {
  auto value = JsonValue::parse(line, "line");
  EXPECT_TRUE(value) << line;
  return value ? *std::move(value) : JsonValue{};
}

// Twenty seconds: the engine is started, the car drives off, and red is shown. A receiver is lost
// for a while.
scenario::Scenario short_drive() {
  scenario::Scenario scenario = lap().scenario;
  scenario.duration = seconds(20);
  scenario.faults = {
      {.kind = "gnss_unit_outage", .at = seconds(2), .lasts = seconds(3), .place = {}}};
  scenario.race_control = {
      {.at = milliseconds(500), .track = world::TrackFlag::kRed},
      {.at = seconds(4), .track = world::TrackFlag::kOrange},
      {.at = seconds(9), .track = world::TrackFlag::kYellow, .round_target_speed_mph = 60.0},
      {.at = seconds(14), .track = world::TrackFlag::kRed}};
  return scenario;
}

std::vector<std::string> lines_of(const scenario::Scenario& scenario) {
  std::vector<std::string> lines;
  Progress progress{scenario, "lockstep", [&](const std::string& line) { lines.push_back(line); }};
  auto run = run_lockstep(scenario, lap().setup,
                          {.follow = [&](const RunView& at) { progress.observe(at); }});
  if (!run) {
    ADD_FAILURE() << to_string(run.error());
    return {};
  }
  progress.ended(*run);
  return lines;
}

const std::vector<std::string>& reported() {
  static const std::vector<std::string> lines = lines_of(short_drive());
  return lines;
}

std::vector<JsonValue> of_type(const std::string& type) {
  std::vector<JsonValue> found;
  for (const std::string& line : reported()) {
    JsonValue value = parsed(line);
    if (value.text("type") == type) found.push_back(std::move(value));
  }
  return found;
}

TEST(Progress, EachLineIsOneObjectOfAKindThatIsDocumented) {
  std::map<std::string, int> kinds;
  for (const std::string& line : reported()) {
    EXPECT_EQ(line.find('\n'), std::string::npos);
    ++kinds[parsed(line).text("type")];
  }
  EXPECT_EQ(kinds["plan"], 1);
  EXPECT_EQ(kinds["result"], 1);
  EXPECT_EQ(kinds["at"], 41);  // each half second of twenty, and the first
  EXPECT_EQ(static_cast<int>(reported().size()), 43 + kinds["event"]);
}

TEST(Progress, ThePlanSaysWhatWillHappen) {
  const JsonValue plan = parsed(reported().front());
  EXPECT_EQ(plan.text("type"), "plan");
  EXPECT_EQ(plan.number("duration_s"), 20.0);
  ASSERT_EQ(plan.items("faults").size(), 1U);
  EXPECT_EQ(plan.items("faults")[0].text("what"), "gnss_unit_outage");
  EXPECT_EQ(plan.items("faults")[0].number("lasts_s"), 3.0);
  EXPECT_EQ(plan.items("flags").size(), 4U);
  EXPECT_EQ(plan.items("expect").size(), lap().scenario.expect.size());
}

TEST(Progress, EventsComeWhenTheyHappen) {
  std::map<std::string, double> when;
  for (const JsonValue& event : of_type("event"))
    when.emplace(event.text("kind") + " " + event.text("text"), event.number("t_s"));
  EXPECT_EQ(when["fault_begins gnss_unit_outage"], 2.0);
  EXPECT_EQ(when["fault_ends gnss_unit_outage"], 5.0);
  EXPECT_NEAR(when["flag orange"], 4.0, 0.02);
}

TEST(Progress, TheReactionToRedIsMeasured) {
  const JsonValue last = of_type("at").back();
  ASSERT_FALSE(last.items("reactions").empty());
  const JsonValue& red = last.items("reactions").back();
  EXPECT_EQ(red.text("to"), "red");
  // Race control speaks each 100 ms and the car steps each 10.
  EXPECT_GT(red.number("reaction_ms"), 0.0);
  EXPECT_LT(red.number("reaction_ms"), 1'500.0);
  EXPECT_EQ(last.items("expect").size(), lap().scenario.expect.size());
}

TEST(Progress, TheSameSeedTellsTheSameButForTheWallTime) {
  const std::vector<std::string> again = lines_of(short_drive());
  ASSERT_EQ(again.size(), reported().size());
  for (std::size_t i = 0; i + 1 < again.size(); ++i) EXPECT_EQ(again[i], reported()[i]);
}

TEST(Progress, AFailureIsALine) {
  std::vector<std::string> lines;
  Progress progress{short_drive(), "live", [&](const std::string& line) { lines.push_back(line); }};
  progress.failed({"vcan0", "no frame of the car"});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(parsed(lines[1]).text("type"), "failure");
  EXPECT_EQ(parsed(lines[1]).text("what"), "vcan0: error: no frame of the car");
}

TEST(Progress, AContactIsAnEventBeforeTheResult) {
  std::vector<std::string> lines;
  Progress progress{short_drive(), "live", [&](const std::string& line) { lines.push_back(line); }};
  RunResult result;
  result.other_cars = 1;
  result.car_contact = CarContact{.at = Instant{} + seconds(7), .with = "slow"};
  progress.ended(result);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(parsed(lines[1]).text("type"), "event");
  EXPECT_EQ(parsed(lines[1]).text("kind"), "contact");
  EXPECT_EQ(parsed(lines[1]).number("t_s"), 7.0);
  EXPECT_EQ(parsed(lines[1]).text("text"), to_text(*result.car_contact));
  const JsonValue last = parsed(lines[2]);
  ASSERT_NE(last.find("result"), nullptr);
  ASSERT_NE(last.find("result")->find("car_contact"), nullptr);
  EXPECT_EQ(last.find("result")->find("car_contact")->text("with"), "slow");
  result.car_contact.reset();
  follow(result.outcome, {.at = Instant{} + seconds(6), .speed_mps = 20.0, .contact = true});
  progress.ended(result);
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(parsed(lines[3]).text("kind"), "contact") << "with a wall";
  EXPECT_EQ(parsed(lines[3]).text("text"), to_text(result.outcome));
}

// What nobody can read any more is counted instead of told.
TEST(Progress, EventsHaveABound) {
  scenario::Scenario scenario = short_drive();
  scenario.faults.clear();
  for (std::size_t i = 0; i < Progress::kEventsMax + 10; ++i)
    scenario.operator_texts.push_back({seconds(1), "limit 30"});
  std::size_t events = 0, left_out = 0;
  Progress progress{scenario, "lockstep", [&](const std::string& line) {
                      const JsonValue value = parsed(line);
                      if (value.text("type") == "event") ++events;
                      if (value.text("type") == "at")
                        left_out = static_cast<std::size_t>(value.number("events_left_out"));
                    }};
  scenario.operator_texts.clear();
  scenario.duration = seconds(2);
  ASSERT_TRUE(run_lockstep(scenario, lap().setup,
                           {.follow = [&](const RunView& at) { progress.observe(at); }}));
  EXPECT_EQ(events, Progress::kEventsMax);
  EXPECT_GE(left_out, 10U);
}

}  // namespace
}  // namespace pitwall::bench
