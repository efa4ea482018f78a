// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/result.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <utility>

#include "protocol/yaml/strict_map.hpp"

namespace pitwall::bench {
namespace {

grading::Verdict verdict(std::string text, bool pass, double margin) {
  grading::Verdict v;
  v.name = "f.yaml:3:5";
  v.text = std::move(text);
  v.pass = pass;
  v.margin = margin;
  v.reason = pass ? "" : "violated at 3.000 s";
  return v;
}

RunResult some_result() {
  RunResult r;
  r.scenario = "lap";
  r.mode = "lockstep";
  r.simulated_s = 90.0;
  r.laps = {.finished = 3, .flying = 2, .best_flying_mean_mps = 65.2, .best_flying_s = 37.6};
  r.traffic = {.to_car = 10, .from_car = 20, .car_received = 9, .bench_received = 19, .lost = 2};
  r.gate_refusals = 4;
  r.bus_refusals = 5;
  grading::add(r.cross_track, 62.0, -0.25);
  r.verdicts = {verdict("always a > 1", true, 0.5)};
  r.digest = "abc";
  return r;
}

// JSON is YAML: the strict reader refuses what is malformed, doubled or not asked for.
struct Read {
  std::string scenario, sha256, text, reason;
  bool simulation = false, passed = true;
  double lost = kUnset, flying_s = kUnset, brackets = kUnset, fastest_mean_m = kUnset;
};

Result<Read, Problem> read_back(const RunResult& r) {
  const auto document = yaml::load_text(to_json(r), "result.json");
  if (!document) return Unexpected{document.error()};
  try {
    yaml::StrictMap map = document->root();
    Read out;
    out.scenario = map.text("scenario");
    out.sha256 = map.text("sha256");
    out.simulation = map.flag("simulation");
    out.passed = map.flag("passed");
    out.lost = map.map("can").number("lost", 0, 1e9);
    yaml::StrictMap laps = map.map("laps");
    if (r.laps.flying > 0) out.flying_s = laps.number("best_flying_s", 0, 1e9);
    auto brackets = map.maps("cross_track");
    out.brackets = static_cast<double>(brackets.size());
    if (brackets[0].integer("samples", 0, 1'000'000) > 0)
      out.fastest_mean_m = brackets[0].number("mean_m", 0, 1e9);
    auto verdicts = map.maps("verdicts");
    if (!verdicts.empty()) out.text = verdicts[0].text("text");
    if (!verdicts.empty()) out.reason = verdicts[0].text("reason");
    return out;
  } catch (const yaml::InputError& error) {
    return Unexpected{error.problem};
  }
}

TEST(Result, JsonSaysWhatTheRunFound) {
  const auto read = read_back(some_result());
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->scenario, "lap");
  EXPECT_EQ(read->sha256, "abc");
  EXPECT_TRUE(read->simulation);
  EXPECT_TRUE(read->passed);
  EXPECT_EQ(read->lost, 2.0);
  EXPECT_EQ(read->flying_s, 37.6);
  EXPECT_EQ(read->brackets, static_cast<double>(grading::kBrackets.size()));
  EXPECT_EQ(read->fastest_mean_m, 0.25);
  EXPECT_EQ(read->text, "always a > 1");
}

TEST(Result, JsonHasNoNanAndNoInfinity) {
  RunResult r;
  r.verdicts = {verdict("never reached", false, std::numeric_limits<double>::infinity())};
  r.speed_max_mps = std::numeric_limits<double>::quiet_NaN();
  const std::string json = to_json(r);
  EXPECT_EQ(json.find("nan"), std::string::npos) << json;
  EXPECT_EQ(json.find("inf"), std::string::npos) << json;
  EXPECT_NE(json.find("\"margin\": null"), std::string::npos);
  EXPECT_NE(json.find("\"wall_s\": null"), std::string::npos);
  EXPECT_TRUE(read_back(r));
}

TEST(Result, WordsCannotBreakOutOfTheJson) {
  RunResult r = some_result();
  r.scenario = "a\"b\\c\nd\te";
  r.verdicts[0].text.assign(3000, 'x');
  r.verdicts[0].text.append("\", \"passed\": true, \"");
  r.verdicts[0].pass = false;
  const auto read = read_back(r);
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->scenario, r.scenario) << "as it is, control characters too";
  EXPECT_EQ(read->text, r.verdicts[0].text);
  EXPECT_FALSE(read->passed);
}

TEST(Result, OneFailureFailsTheRun) {
  RunResult r = some_result();
  EXPECT_TRUE(r.passed());
  EXPECT_NE(to_text(r).find("verdict: PASS"), std::string::npos);
  r.verdicts.push_back(verdict("always b < 2", false, -3.5));
  EXPECT_FALSE(r.passed());
  const std::string text = to_text(r);
  EXPECT_NE(text.find("PASS  always a > 1"), std::string::npos);
  EXPECT_NE(text.find("FAIL  always b < 2  (margin -3.5)  violated at 3.000 s"), std::string::npos);
  EXPECT_NE(text.find("verdict: FAIL"), std::string::npos);
  EXPECT_EQ(text.find("verdict: PASS"), std::string::npos);
}

// ---- Several cars

RunResult with_one_other(RunResult own, RunResult other) {
  const std::array<std::string, 1> names{"rival"};
  return with_others({std::move(own), std::move(other)}, names);
}

TEST(Result, ARunPassesIfEveryCarDoes) {
  RunResult crashed = some_result();
  crashed.verdicts[0] = verdict("no contact", false, -3.0);
  crashed.verdicts[0].name = "contact";
  RunResult wanting = some_result();
  wanting.verdicts.push_back(verdict("always b < 2", false, -3.5));
  EXPECT_TRUE(with_one_other(some_result(), some_result()).passed());
  for (const auto& run :
       {with_one_other(crashed, some_result()), with_one_other(some_result(), crashed)}) {
    EXPECT_FALSE(run.passed());
    EXPECT_TRUE(run.failed_by_contact());
    EXPECT_NE(to_text(run).find("verdict: CONTACT"), std::string::npos);
  }
  const RunResult run = with_one_other(some_result(), wanting);
  EXPECT_FALSE(run.passed());
  EXPECT_FALSE(run.failed_by_contact());
  EXPECT_NE(to_text(run).find("\ncar rival\nlaps 3,"), std::string::npos) << to_text(run);
  EXPECT_NE(to_text(run).find("verdict: FAIL"), std::string::npos);
}

TEST(Result, JsonHasTheWholeResultOfEachOtherCar) {
  RunResult other = some_result();
  other.digest = "def";
  const RunResult run = with_one_other(some_result(), other);
  const auto document = yaml::load_text(to_json(run), "result.json");
  ASSERT_TRUE(document) << to_string(document.error());
  yaml::StrictMap map = document->root();
  EXPECT_FALSE(map.has("car")) << "ours";
  auto others = map.maps("others");
  ASSERT_EQ(others.size(), 1u);
  EXPECT_EQ(others[0].text("car"), "rival");
  EXPECT_EQ(others[0].text("sha256"), "def");
  EXPECT_EQ(others[0].maps("verdicts").size(), 1u);
  EXPECT_EQ(to_json(some_result()).find("others"), std::string::npos) << "of one car alone";
}

// ---- Not judged

RunResult with_ticks(std::uint64_t ticks, std::uint64_t missed) {
  RunResult run = some_result();
  run.real_time.emplace();
  run.real_time->ticks = ticks;
  run.real_time->missed_deadlines = missed;
  return run;
}

TEST(Result, ACarThatMissesMoreThanOneTickInAHundredMakesTheRunNotJudged) {
  EXPECT_TRUE(some_result().not_judged().empty()) << "lockstep misses nothing";
  EXPECT_TRUE(with_ticks(0, 0).not_judged().empty()) << "a car that told nothing";
  EXPECT_TRUE(with_ticks(99, 1).not_judged().empty());
  EXPECT_EQ(with_ticks(9'899, 101).not_judged(),
            (std::vector<std::string>{
                "the car missed 1.01 % of its ticks (101 of 10000), more than 1 %"}));
  const std::string text = to_text(with_ticks(9'899, 101));
  EXPECT_NE(text.find("not judged: the car missed 1.01 %"), std::string::npos) << text;
  EXPECT_NE(text.find("verdict: NOT JUDGED"), std::string::npos) << "although nothing failed";
  EXPECT_EQ(text.find("verdict: PASS"), std::string::npos);
  const std::string json = to_json(with_ticks(9'899, 101));
  EXPECT_NE(json.find("\"not_judged\": [\"the car missed"), std::string::npos) << json;
  EXPECT_NE(to_json(with_ticks(99, 1)).find("\"not_judged\": []"), std::string::npos);
}

TEST(Result, SoDoesAnyOtherCarOfTheRun) {
  const RunResult run = with_one_other(with_ticks(100, 0), with_ticks(90, 10));
  EXPECT_EQ(run.not_judged(),
            (std::vector<std::string>{
                "car rival missed 10.00 % of its ticks (10 of 100), more than 1 %"}));
  EXPECT_EQ(with_one_other(with_ticks(90, 10), with_ticks(90, 10)).not_judged().size(), 2u);
}

TEST(Result, TicksThatAFaultOfTheScenarioTakesAreJudged) {
  RunResult run = with_ticks(50, 50);
  run.real_time->is_slowed = true;
  EXPECT_TRUE(run.not_judged().empty());
}

TEST(Result, OfABenchThatWasLateOnlyWhatFailedIsNotJudged) {
  RunResult run = with_ticks(100, 0);
  run.real_time->behind_max = milliseconds(56);
  run.real_time->behind_at = Instant{} + milliseconds(7'890);
  EXPECT_FALSE(run.timely());
  EXPECT_TRUE(run.not_judged().empty());
  run.verdicts.push_back(verdict("always b < 2", false, -3.5));
  ASSERT_EQ(run.not_judged().size(), 1u);
  EXPECT_NE(run.not_judged()[0].find("at 7.89 s the bench was 56 ms behind"), std::string::npos);
  EXPECT_NE(to_text(run).find("verdict: NOT JUDGED"), std::string::npos);
}

TEST(Result, TextSaysSimulationFirst) {
  EXPECT_TRUE(to_text(some_result()).starts_with("SIMULATION lap, lockstep: 90.0 s simulated"));
  RunResult r = some_result();
  r.wall_s = 1.5;
  EXPECT_NE(to_text(r).find("in 1.50 s (60.0 x real time)"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::bench
