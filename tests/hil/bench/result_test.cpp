// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/result.hpp"

#include <gtest/gtest.h>

#include <limits>

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

TEST(Result, TextSaysSimulationFirst) {
  EXPECT_TRUE(to_text(some_result()).starts_with("SIMULATION lap, lockstep: 90.0 s simulated"));
  RunResult r = some_result();
  r.wall_s = 1.5;
  EXPECT_NE(to_text(r).find("in 1.50 s (60.0 x real time)"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::bench
