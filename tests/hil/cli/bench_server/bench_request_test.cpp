// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/bench_server/bench_request.hpp"

#include <gtest/gtest.h>

namespace pitwall::bench_server {
namespace {

std::string place_of(std::string_view line) {
  const auto word = parse_request(line);
  return word ? "" : word.error().place;
}

TEST(BenchRequest, AStartHasScenarioModeAndPerhapsASeed) {
  const auto word = parse_request(
      R"({"do": "start", "scenario": "faults/x", "mode": "live", "seed": 7, "by": "Ana"})");
  ASSERT_TRUE(word);
  const auto& start = std::get<StartRunRequest>(*word);
  EXPECT_EQ(start.scenario, "faults/x");
  EXPECT_TRUE(start.live);
  EXPECT_EQ(start.seed, 7U);
  EXPECT_EQ(start.by, "Ana");
  const auto without =
      parse_request(R"({"do": "start", "scenario": "x", "mode": "lockstep", "seed": null})");
  ASSERT_TRUE(without);
  EXPECT_FALSE(std::get<StartRunRequest>(*without).seed);
}

TEST(BenchRequest, AStopSaysByWhom) {
  const auto word = parse_request(R"({"do": "stop", "by": "Ana"})");
  ASSERT_TRUE(word);
  EXPECT_EQ(std::get<StopRunRequest>(*word).by, "Ana");
}

TEST(BenchRequest, APageIsAskedForFromAByteOn) {
  const auto word = parse_request(R"({"do": "page", "page": "runs/1/report.html", "from": 4000})");
  ASSERT_TRUE(word);
  EXPECT_EQ(std::get<PageRequest>(*word).page, "runs/1/report.html");
  EXPECT_EQ(std::get<PageRequest>(*word).from, 4000U);
  for (const char* from : {"-1", "1.5", "4194305", "\"0\"", "null"})
    EXPECT_EQ(place_of(std::string{R"({"do": "page", "page": "a", "from": )"} + from + "}"), "from")
        << from;
}

TEST(BenchRequest, WhatIsWrongIsNamed) {
  EXPECT_TRUE(place_of("start").starts_with("line:"));
  EXPECT_EQ(place_of(R"({"do": "dance"})"), "do");
  EXPECT_EQ(place_of("[]"), "do");
  EXPECT_EQ(place_of(R"({"do": "start", "mode": "live"})"), "scenario");
  EXPECT_EQ(place_of(R"({"do": "start", "scenario": "x"})"), "mode");
  EXPECT_EQ(place_of(R"({"do": "start", "scenario": "x", "mode": "fast"})"), "mode");
  for (const char* seed : {"-1", "1.5", "1000000001", "\"1\"", "1e300", "true"}) {
    const std::string line =
        std::string{R"({"do": "start", "scenario": "x", "mode": "live", "seed": )"} + seed + "}";
    EXPECT_EQ(place_of(line), "seed") << seed;
  }
  const std::string long_name(kNameMax + 1, 'x');
  EXPECT_EQ(place_of(R"({"do": "stop", "by": ")" + long_name + "\"}"), "by");
  EXPECT_EQ(place_of(R"({"do": "start", "mode": "live", "scenario": ")" + long_name + "\"}"),
            "scenario");
}

}  // namespace
}  // namespace pitwall::bench_server
