// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/bench/bench_link.hpp"

#include <gtest/gtest.h>

#include "protocol/json/json_value.hpp"
#include "protocol/transport/file.hpp"
#include "tests/basestation/radio_rig.hpp"

namespace pitwall::publishers::bench {
namespace {

using json::JsonValue;

constexpr const char* kHello =
    R"({"type": "hello", "protocol": 1, "server": "d", "simulation": true,)"
    R"("scenarios": 0, "unreadable": 0})";

// A link, and a server that says what the test wants; time is the test's.
struct Both {
  transport::TemporaryFolder folder = *transport::TemporaryFolder::create("bench");
  std::string path = folder.path() + "/server";
  RadioRig rig;
  BenchLink link{path};
  std::optional<transport::LineListener> listener;
  std::optional<transport::LineSocket> server;
  std::vector<Reported> reported;
  std::vector<std::pair<int, std::string>> refused;
  std::vector<PageAnswer> pages;
  Instant now{seconds(50).ns};

  Both() {
    link.observe_by(
        {.publish = [this](const Reported& one, Instant) { reported.push_back(one); },
         .refused = [this](std::uint8_t client, const Problem& problem,
                           Instant) { refused.emplace_back(client, to_string(problem)); },
         .page = [this](const PageAnswer& answer) { pages.push_back(answer); }});
  }
  void pass(Duration span) {
    for (Duration done{}; done < span; done = done + BenchLink::kPollPeriod) {
      now += BenchLink::kPollPeriod;
      link.publish(*rig.base, now);
    }
  }
  void open() {
    listener.emplace(*transport::LineListener::open(path));
    pass(seconds(2));
    server = listener->accept();
    ASSERT_TRUE(server);
    server->send(kHello);
    pass(seconds(1));
  }
  JsonValue state() {
    JsonValue newest;
    for (const Reported& one : reported)
      if (one.type == "bench") newest = *JsonValue::parse(one.text, "state");
    return newest;
  }
};

TEST(BenchLink, AMissingDeskIsShownAndLookedForAgain) {
  Both both;
  both.pass(seconds(1));
  EXPECT_FALSE(both.state().flag("up"));
  EXPECT_FALSE(both.state().flag("may_start"));
  EXPECT_EQ(both.state().text("why_not"), "the bench server is not there");
  EXPECT_FALSE(both.link.ask({.start = true, .scenario = "a", .seed = {}}, 16, "Ada"));
  both.open();
  EXPECT_TRUE(both.state().flag("up"));
  EXPECT_TRUE(both.state().flag("may_start"));
  both.server.reset();
  both.listener.reset();
  both.pass(seconds(1));
  EXPECT_FALSE(both.state().flag("up"));
  both.open();  // and it is there again
  EXPECT_TRUE(both.state().flag("up"));
}

TEST(BenchLink, AWishGoesToTheDeskAndItsRefusalToWhoAsked) {
  Both both;
  both.open();
  ASSERT_TRUE(
      both.link.ask({.start = true, .scenario = "red \"x\"", .seed = 7, .live = true}, 17, "Ada"));
  const auto lines = both.server->receive();
  ASSERT_EQ(lines.size(), 1U);
  const JsonValue run_request = *JsonValue::parse(lines[0], "wish");
  EXPECT_EQ(run_request.text("do"), "start");
  EXPECT_EQ(run_request.text("scenario"), "red \"x\"");
  EXPECT_EQ(run_request.text("mode"), "live");
  EXPECT_EQ(run_request.number("seed"), 7.0);
  EXPECT_EQ(run_request.text("by"), "Ada");
  both.server->send(R"({"type": "error", "place": "scenario", "what": "no such scenario"})");
  both.pass(seconds(1));
  ASSERT_EQ(both.refused.size(), 1U);
  EXPECT_EQ(both.refused[0], std::pair(17, std::string{"bench.scenario: error: no such scenario"}));
}

// Whoever drives a real car starts no simulation beside it; one that runs can be ended.
TEST(BenchLink, WithARealCarNothingIsStarted) {
  Both both;
  both.open();
  both.rig.set(telemetry::field("mode.mode"), 2.0);
  both.rig.run(seconds(1));
  both.pass(seconds(1));
  EXPECT_FALSE(both.state().flag("may_start"));
  const auto asked = both.link.ask({.start = true, .scenario = "a", .seed = {}}, 16, "Ada");
  ASSERT_FALSE(asked);
  EXPECT_EQ(asked.error().what, "the connected car is real");
  EXPECT_TRUE(both.server->receive().empty());
  EXPECT_TRUE(both.link.ask({.scenario = {}, .seed = {}}, 16, "Ada"));
}

TEST(BenchLink, NonsenseOfADeskIsCountedAndItGoesOn) {
  Both both;
  both.open();
  both.server->send("nonsense");
  both.server->send(std::string(transport::LineSocket::kLineMax_bytes + 10, 'x'));
  for (int i = 0; i < 100; ++i) {
    both.server->flush();
    both.pass(BenchLink::kPollPeriod);
  }
  both.server->send(R"({"type": "run", "run": 1, "seed": 1, "state": "running", "scenario": "a",)"
                    R"("name": "a", "mode": "live"})");
  both.pass(seconds(1));
  EXPECT_EQ(both.state().number("malformed"), 2.0);
  EXPECT_EQ(both.link.bench().counters().taken, 2U);
}

TEST(BenchLink, APageComesFromTheServerPartByPart) {
  Both both;
  both.link.ask_page(3, "runs/1/report.html");
  both.pass(BenchLink::kPollPeriod);
  ASSERT_EQ(both.pages.size(), 1U) << "there is no server";
  EXPECT_EQ(both.pages[0].text, "the bench server is not there");
  both.open();
  EXPECT_EQ(both.link.due(), both.now + BenchLink::kPollPeriod);
  both.link.ask_page(4, "runs/1/report.html");
  EXPECT_EQ(both.link.due(), both.now + BenchLink::kPagePeriod) << "it is not kept waiting";
  for (const char* part :
       {R"({"type": "page", "page": "runs/1/report.html", "from": 0, "next": 2, "bytes": 3,)"
        R"("text": "<p"})",
        R"({"type": "page", "page": "runs/1/report.html", "from": 2, "next": 3, "bytes": 3,)"
        R"("text": ">"})"}) {
    both.pass(BenchLink::kPollPeriod);
    ASSERT_EQ(both.server->receive().size(), 1U);
    both.server->send(part);
  }
  both.pass(BenchLink::kPollPeriod);
  ASSERT_EQ(both.pages.size(), 2U);
  EXPECT_EQ(both.pages[1].request, 4U);
  EXPECT_EQ(both.pages[1].kind, PageAnswer::Kind::kPage);
  EXPECT_EQ(both.pages[1].text, "<p>");
  both.server->send(R"({"type": "page", "page": "runs/1/report.html", "from": 0})");
  both.pass(seconds(1));
  EXPECT_EQ(both.state().number("malformed"), 1.0) << "nobody asked for it";
}

TEST(BenchLink, AFastRunIsToldFiveTimesASecond) {
  Both both;
  both.open();
  both.server->send(R"({"type": "run", "run": 1, "seed": 1, "state": "running", "scenario": "a",)"
                    R"("name": "a", "mode": "lockstep"})");
  both.pass(seconds(1));
  both.reported.clear();
  for (int i = 0; i < 20; ++i) {
    for (int k = 0; k < 10; ++k)
      both.server->send(R"({"run": 1, "type": "at", "t_s": 1, "cross_track": [],)"
                        R"("expect": [], "reactions": []})");
    both.pass(BenchLink::kPollPeriod);
  }
  EXPECT_LE(both.reported.size(), 6U);
  EXPECT_GE(both.reported.size(), 4U);
}

TEST(BenchLink, AWishReadsAsALineOfTheAudit) {
  EXPECT_EQ(text_of({.start = true, .scenario = "a/b", .seed = 9, .live = true}),
            "bench: start a/b, live, seed 9");
  EXPECT_EQ(text_of({.start = true, .scenario = "a", .seed = {}}), "bench: start a, lockstep");
  EXPECT_EQ(text_of({.scenario = {}, .seed = {}}), "bench: stop the run");
}

}  // namespace
}  // namespace pitwall::publishers::bench
