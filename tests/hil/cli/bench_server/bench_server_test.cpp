// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/bench_server/bench_server.hpp"

#include <gtest/gtest.h>

#include "protocol/json/json_value.hpp"

namespace pitwall::bench_server {
namespace {

using json::JsonValue;

JsonValue parsed(const std::string& line) {
  auto value = JsonValue::parse(line, "line");
  EXPECT_TRUE(value) << line;
  return value ? *std::move(value) : JsonValue{};
}

std::vector<Listed> three() {
  Listed good{.id = "good",
              .file = "f/good.yaml",
              .name = "good",
              .description = "d \"q\"",
              .problem = {},
              .duration_s = 12.0,
              .seed = 3,
              .lockstep = true};
  Listed live = good;
  live.id = "live";
  live.lockstep = false;
  live.live = true;
  Listed broken = good;
  broken.id = "broken";
  broken.problem = "f:1:2: error: no";
  return {good, live, broken};
}

const char* const kStart =
    R"({"do": "start", "scenario": "good", "mode": "lockstep", "by": "Ana"})";

struct Table {
  BenchServer server{three()};

  std::string refused(const std::string& line) {
    const Answer answer = server.receive(line);
    EXPECT_FALSE(answer.start);
    EXPECT_TRUE(answer.to_all.empty());
    if (answer.to_asker.size() != 1) return "not one answer";
    const JsonValue error = parsed(answer.to_asker[0]);
    EXPECT_EQ(error.text("type"), "error");
    return error.text("place") + ": " + error.text("what");
  }
  JsonValue run() {
    for (const std::string& line : server.greeting()) {
      JsonValue value = parsed(line);
      if (value.text("type") == "run") return value;
    }
    return {};
  }
  Start begin() {
    const Answer answer = server.receive(kStart);
    EXPECT_TRUE(answer.start);
    EXPECT_EQ(server.started("runs/1").size(), 1U);
    return answer.start.value_or(Start{});
  }
};

TEST(BenchServer, WhoJoinsIsToldTheScenarios) {
  const Table table;
  const auto lines = table.server.greeting();
  ASSERT_EQ(lines.size(), 4U);
  const JsonValue hello = parsed(lines[0]);
  EXPECT_EQ(hello.text("type"), "hello");
  EXPECT_TRUE(hello.flag("simulation"));
  EXPECT_EQ(hello.number("scenarios"), 3.0);
  EXPECT_EQ(hello.number("unreadable"), 1.0);
  const JsonValue good = parsed(lines[1]);
  EXPECT_EQ(good.text("description"), "d \"q\"");
  EXPECT_TRUE(good.find("problem")->is_null());
  EXPECT_EQ(parsed(lines[3]).text("problem"), "f:1:2: error: no");
}

TEST(BenchServer, OneRunAtATime) {
  Table table;
  const Start start = table.begin();
  EXPECT_EQ(start.run, 1U);
  EXPECT_EQ(start.seed, 3U);  // the file's
  EXPECT_EQ(start.file, "f/good.yaml");
  EXPECT_TRUE(table.server.running());
  EXPECT_EQ(table.run().text("state"), "running");
  EXPECT_EQ(table.refused(kStart), "start: run 1 (good) is still running; stop it first");
  table.server.ended({.code = 2});
  const Answer again = table.server.receive(
      R"({"do": "start", "scenario": "good", "mode": "lockstep", "seed": 99})");
  ASSERT_TRUE(again.start);
  EXPECT_EQ(again.start->run, 2U);
  EXPECT_EQ(again.start->seed, 99U);
}

TEST(BenchServer, WhatCannotBeStartedIsRefusedWithItsReason) {
  Table table;
  EXPECT_EQ(table.refused(R"({"do": "start", "scenario": "none", "mode": "live"})"),
            "scenario: no such scenario");
  EXPECT_EQ(table.refused(R"({"do": "start", "scenario": "../../etc/passwd", "mode": "live"})"),
            "scenario: no such scenario");
  EXPECT_EQ(table.refused(R"({"do": "start", "scenario": "broken", "mode": "lockstep"})"),
            "scenario: f:1:2: error: no");
  EXPECT_EQ(table.refused(R"({"do": "start", "scenario": "good", "mode": "live"})"),
            "mode: this scenario needs the lockstep bench");
  EXPECT_EQ(table.refused(R"({"do": "start", "scenario": "live", "mode": "lockstep"})"),
            "mode: this scenario needs the live bench");
  EXPECT_EQ(table.refused(R"({"do": "stop"})"), "stop: no run is in progress");
  EXPECT_NE(table.refused("nonsense").find("line"), std::string::npos);
  EXPECT_EQ(table.server.counters().refused, 7U);
  EXPECT_FALSE(table.server.running());
}

TEST(BenchServer, ExitCodesAreVerdicts) {
  const std::vector<std::pair<Ending, std::string>> cases{
      {{.code = 0}, "passed"},  {{.code = 1}, "failed"},    {{.code = 2}, "unusable"},
      {{.code = 4}, "contact"}, {{.code = 77}, "unusable"}, {{.signal = 11}, "crashed"}};
  for (const auto& [ending, state] : cases) {
    Table table;
    table.begin();
    table.server.progressed(R"({"type": "result", "passed": true})");
    table.server.ended(ending);
    EXPECT_EQ(table.run().text("state"), state);
    EXPECT_EQ(table.run().text("junit"), "runs/1/junit.xml");
  }
}

TEST(BenchServer, ARunThatEndsWithoutAResultHasCrashed) {
  Table table;
  table.begin();
  table.server.ended({.code = 0});
  EXPECT_EQ(table.run().text("state"), "crashed");
  EXPECT_EQ(table.run().text("why"), "it ended without a result");
}

TEST(BenchServer, AStopSaysByWhom) {
  Table table;
  table.begin();
  const Answer answer = table.server.receive(R"({"do": "stop", "by": "Bo"})");
  EXPECT_TRUE(answer.stop);
  ASSERT_EQ(answer.to_all.size(), 1U);
  table.server.ended({.signal = 15});
  EXPECT_EQ(table.run().text("state"), "stopped");
  EXPECT_EQ(table.run().text("stopped_by"), "Bo");
}

TEST(BenchServer, ProgressIsPassedOnWithItsRun) {
  Table table;
  table.begin();
  const auto reported = table.server.progressed(R"({"type": "at", "t_s": 1.5})");
  ASSERT_EQ(reported.size(), 1U);
  EXPECT_EQ(parsed(reported[0]).number("run"), 1.0);
  EXPECT_EQ(parsed(reported[0]).number("t_s"), 1.5);
  for (const char* bad : {"", "{", "[]", "1", R"({"type": "other"})", R"({"type": "at"} {})"})
    EXPECT_TRUE(table.server.progressed(bad).empty()) << bad;
  EXPECT_EQ(table.server.counters().malformed, 6U);
}

TEST(BenchServer, WhoJoinsLateKnowsWhatTheOthersKnow) {
  Table table;
  table.begin();
  table.server.progressed(R"({"type": "plan"})");
  for (int i = 0; i < 5; ++i) table.server.progressed(R"({"type": "event"})");
  table.server.progressed(R"({"type": "at", "t_s": 1.0})");
  table.server.progressed(R"({"type": "at", "t_s": 2.0})");
  table.server.progressed(R"({"type": "result"})");
  const auto lines = table.server.greeting();
  ASSERT_EQ(lines.size(), 4U + 1 + 1 + 5 + 2);
  EXPECT_EQ(parsed(lines[5]).text("type"), "plan");
  EXPECT_EQ(parsed(lines[11]).number("t_s"), 2.0);
  for (std::size_t i = 0; i < BenchServer::kEventsKept + 10; ++i)
    table.server.progressed(R"({"type": "event"})");
  EXPECT_EQ(table.server.greeting().size(), 4U + 2 + BenchServer::kEventsKept + 2);
}

TEST(BenchServer, AFailureOfTheBenchIsTheReason) {
  Table table;
  table.begin();
  EXPECT_TRUE(table.server.progressed(R"({"type": "failure", "what": "vcan0: no frame"})").empty());
  table.server.ended({.code = 2});
  EXPECT_EQ(table.run().text("why"), "vcan0: no frame");
  Table other;
  other.server.receive(kStart);
  other.server.not_started({"runs/1", "disk full"});
  EXPECT_EQ(other.run().text("state"), "unusable");
  EXPECT_EQ(other.run().text("why"), "runs/1: error: disk full");
  EXPECT_FALSE(other.server.running());
}

TEST(BenchServer, APageIsReadForWhoAsks) {
  Table table;
  const Answer answer =
      table.server.receive(R"({"do": "page", "page": "runs/1/report.html", "from": 8})");
  ASSERT_TRUE(answer.page);
  EXPECT_EQ(answer.page->page, "runs/1/report.html");
  EXPECT_EQ(answer.page->from, 8U);
  EXPECT_TRUE(answer.to_asker.empty());
  const JsonValue refused =
      parsed(table.server.page_refused(*answer.page, {"page x", "no such page"}));
  EXPECT_EQ(refused.text("type"), "page");
  EXPECT_EQ(refused.text("page"), "runs/1/report.html");
  EXPECT_EQ(refused.number("from"), 8.0);
  EXPECT_EQ(refused.text("problem"), "page x: error: no such page");
  EXPECT_EQ(table.server.counters().refused, 1U);
}

TEST(BenchServer, ARunHasAPageOnceItHasLeftOne) {
  Table table;
  table.begin();
  EXPECT_TRUE(table.run().find("page")->is_null());
  table.server.ended({.code = 1, .page = "runs/1/report.html"});
  EXPECT_EQ(table.run().text("page"), "runs/1/report.html");
  table.server.receive(kStart);
  EXPECT_TRUE(table.run().find("page")->is_null()) << "not that of the run before";
}

TEST(BenchServer, SweepsAreToldOnceAndToWhoComesLater) {
  Table table;
  const std::size_t before = table.server.greeting().size();
  EXPECT_EQ(table.server.swept("a"), std::vector<std::string>{"a"});
  EXPECT_TRUE(table.server.swept("a").empty()) << "nothing has changed";
  EXPECT_EQ(table.server.swept("b"), std::vector<std::string>{"b"});
  const auto greeting = table.server.greeting();
  EXPECT_EQ(greeting.size(), before + 1);
  EXPECT_EQ(greeting.back(), "b");
}

}  // namespace
}  // namespace pitwall::bench_server
