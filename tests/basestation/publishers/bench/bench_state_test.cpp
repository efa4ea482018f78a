// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/bench/bench_state.hpp"

#include <gtest/gtest.h>

namespace pitwall::publishers::bench {
namespace {

using json::JsonValue;

std::string hello(int scenarios, const std::string& server = "d1") {
  return R"({"type": "hello", "protocol": 1, "server": ")" + server +
         R"(", "simulation": true, "unreadable": 0, "scenarios": )" + std::to_string(scenarios) +
         "}";
}
std::string scenario(const std::string& id) {
  return R"({"type": "scenario", "id": ")" + id + R"(", "name": "n", "faults": [], "expect": []})";
}
std::string run(int number, const std::string& state = "running") {
  return R"({"type": "run", "run": )" + std::to_string(number) + R"(, "state": ")" + state +
         R"(", "scenario": "a", "name": "a", "mode": "lockstep", "seed": 3})";
}
std::string event(int number, double t_s) {
  return R"({"run": )" + std::to_string(number) + R"(, "type": "event", "kind": "flag", "t_s": )" +
         std::to_string(t_s) + R"(, "text": "red"})";
}
std::string at(int number) {
  return R"({"run": )" + std::to_string(number) +
         R"(, "type": "at", "t_s": 1, "cross_track": [], "expect": [], "reactions": []})";
}

struct Reading {
  BenchState bench;

  void says(const std::string& line) {
    const auto taken = bench.take(line);
    EXPECT_TRUE(taken) << line << ": " << to_string(taken.error());
  }
  std::string place_of(const std::string& line) {
    const auto taken = bench.take(line);
    return taken ? "taken" : taken.error().place;
  }
  // Types of what is new, in order.
  std::string news() {
    std::string types;
    for (const Reported& reported : bench.news()) {
      types += (types.empty() ? "" : " ") + reported.type;
      EXPECT_TRUE(JsonValue::parse(reported.text, "told")) << reported.text;
    }
    return types;
  }
};

TEST(BenchState, TheListIsToldWhenItIsWhole) {
  Reading reading;
  reading.says(hello(2));
  reading.says(scenario("a"));
  EXPECT_EQ(reading.news(), "");
  reading.says(scenario("b"));
  const auto news = reading.bench.news();
  ASSERT_EQ(news.size(), 1U);
  const auto list = JsonValue::parse(news[0].text, "list");
  ASSERT_TRUE(list);
  EXPECT_EQ(list->text("server"), "d1");
  ASSERT_EQ(list->items("of").size(), 2U);
  EXPECT_EQ(list->items("of")[1].text("id"), "b");
  EXPECT_EQ(reading.place_of(scenario("c")), "scenario");
}

TEST(BenchState, APartOfAPageIsForWhoAskedAndForNoConsole) {
  Reading reading;
  reading.says(R"({"type": "page", "page": "runs/1/report.html", "from": 0, "text": "x"})");
  EXPECT_EQ(reading.news(), "");
  const auto part = reading.bench.page_part();
  ASSERT_TRUE(part);
  EXPECT_EQ(part->text("text"), "x");
  EXPECT_FALSE(reading.bench.page_part()) << "once";
  EXPECT_EQ(reading.place_of(R"({"type": "page", "from": 0})"), "page");
  EXPECT_EQ(reading.place_of(R"({"type": "page", "page": "a"})"), "from");
}

TEST(BenchState, ANewRunTakesAwayWhatWasOfTheOneBefore) {
  Reading reading;
  reading.says(hello(0));
  reading.says(run(1));
  reading.says(at(1));
  reading.news();
  reading.says(run(2));
  EXPECT_EQ(reading.news(), "bench_plan bench_at bench_result bench_run");
  EXPECT_EQ(reading.place_of(at(1)), "run");
  reading.says(at(2));
  reading.says(at(2));
  EXPECT_EQ(reading.news(), "bench_at");  // the newest replaces the one before it
}

TEST(BenchState, AfterAReconnectionNoEventIsToldTwice) {
  Reading reading;
  reading.says(hello(0));
  reading.says(run(1));
  for (int i = 0; i < 3; ++i) reading.says(event(1, i));
  reading.news();
  // The server tells all of it again, and one more.
  reading.bench.connected();
  reading.says(hello(0));
  reading.says(run(1));
  for (int i = 0; i < 3; ++i) reading.says(event(1, i));
  EXPECT_EQ(reading.news(), "bench_list bench_run");
  reading.says(event(1, 3));
  EXPECT_EQ(reading.news(), "bench_event");
}

TEST(BenchState, ADeskThatWasStartedAnewBeginsItsRunsAnew) {
  Reading reading;
  reading.says(hello(0));
  reading.says(run(1));
  for (int i = 0; i < 3; ++i) reading.says(event(1, i));
  reading.says(hello(0, "d2"));
  reading.says(run(1));
  reading.news();
  reading.says(event(1, 0));
  EXPECT_EQ(reading.news(), "bench_event");
}

TEST(BenchState, WhatIsNoLineOfTheProtocolIsCountedAndTheNextIsTaken) {
  Reading reading;
  EXPECT_TRUE(reading.place_of("nonsense").starts_with("line:"));
  EXPECT_EQ(reading.place_of(R"({"type": "dance"})"), "type");
  EXPECT_EQ(reading.place_of(scenario("a")), "type");  // before any hello
  EXPECT_EQ(reading.place_of(R"({"type": "hello", "protocol": 2, "server": "d", "simulation": true,
    "scenarios": 0, "unreadable": 0})"),
            "protocol");
  EXPECT_EQ(reading.place_of(R"({"type": "hello", "protocol": 1, "server": "d",
    "scenarios": 0, "unreadable": 0})"),
            "simulation");
  EXPECT_EQ(reading.place_of(hello(1'001)), "scenarios");
  reading.says(hello(0));
  EXPECT_EQ(reading.place_of(R"({"type": "run", "run": "1"})"), "run");
  EXPECT_EQ(reading.place_of(R"({"type": "at", "run": 0, "t_s": 1, "cross_track": 3})"),
            "cross_track");
  EXPECT_EQ(reading.place_of(event(5, 0)), "run");
  EXPECT_EQ(reading.bench.counters().refused, 9U);
  reading.says(run(1));
  EXPECT_EQ(reading.bench.counters().taken, 2U);
}

TEST(BenchState, ListsAndEventsHaveABound) {
  Reading reading;
  reading.says(hello(1'000));
  const std::string long_one = scenario(std::string(200'000, 'x'));
  for (int i = 0; i < 5; ++i) reading.says(long_one);
  EXPECT_EQ(reading.place_of(long_one), "scenario");
  reading.says(hello(0));
  reading.says(run(1));
  for (std::size_t i = 0; i < BenchState::kEventsMax; ++i) reading.says(event(1, 0));
  EXPECT_EQ(reading.place_of(event(1, 0)), "event");
}

TEST(BenchState, ARefusalIsHandedOnOnce) {
  Reading reading;
  reading.says(R"({"type": "error", "place": "start", "what": "no"})");
  const auto refusal = reading.bench.refusal();
  ASSERT_TRUE(refusal);
  EXPECT_EQ(to_string(*refusal), "bench.start: error: no");
  EXPECT_FALSE(reading.bench.refusal());
}

TEST(BenchState, SweepsAreToldAsTheyCome) {
  Reading reading;
  EXPECT_EQ(reading.place_of(R"({"type": "sweeps", "sweeps": []})"), "type") << "before hello";
  reading.says(hello(0));
  reading.says(R"({"type": "sweeps", "sweeps": [{"name": "grip"}]})");
  EXPECT_EQ(reading.news(), "bench_list bench_sweeps");
  EXPECT_EQ(reading.place_of(R"({"type": "sweeps", "sweeps": 3})"), "sweeps");
}

}  // namespace
}  // namespace pitwall::publishers::bench
