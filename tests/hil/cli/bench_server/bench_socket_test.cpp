// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/bench_server/bench_socket.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <functional>

#include "protocol/json/json_value.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::bench_server {
namespace {

using json::JsonValue;
constexpr Duration kTimeout = seconds(60);  // ends a test that hangs; nothing is judged by it

const std::string kScenario = std::string{PITWALL_SOURCE_DIR} + "/hil/scenarios/red_flag_stop.yaml";

// A server whose runs are a shell script of the test: $1 report folder, $2 progress file.
class BenchSocketTest : public ::testing::Test {
 protected:
  void open(const std::string& script) {
    ASSERT_TRUE(
        transport::write_file(folder_.path() + "/good.yaml", *transport::read_file(kScenario)));
    auto opened = BenchSocket::open(
        {.socket = folder_.path() + "/server",
         .scenarios = folder_.path(),
         .runs = folder_.path() + "/runs",
         .sweeps = folder_.path() + "/sweeps",
         .command = [script](const Start&, const std::string& report, const std::string& progress) {
           return std::vector<std::string>{"sh", "-c", script, "run", report, progress};
         }});
    ASSERT_TRUE(opened) << to_string(opened.error());
    server_.emplace(*std::move(opened));
    client_.emplace(*transport::LineSocket::connect(folder_.path() + "/server"));
    ASSERT_TRUE(until([&] { return has("scenario", "id", "good"); }));
  }
  bool until(const std::function<bool()>& done) {
    const Instant limit = transport::monotonic_now() + kTimeout;
    while (transport::monotonic_now() < limit) {
      server_->serve(transport::monotonic_now() + milliseconds(20));
      for (const std::string& line : client_->receive()) {
        auto value = JsonValue::parse(line, "line");
        EXPECT_TRUE(value) << line;
        if (value) received_.push_back(*std::move(value));
      }
      if (done()) return true;
    }
    return false;
  }
  bool has(const std::string& type, const std::string& member, const std::string& text) const {
    for (const JsonValue& value : received_)
      if (value.text("type") == type && value.text(member) == text) return true;
    return false;
  }
  void start() { client_->send(R"({"do": "start", "scenario": "good", "mode": "lockstep"})"); }

  transport::TemporaryFolder folder_ = *transport::TemporaryFolder::create("server");
  std::optional<BenchSocket> server_;
  std::optional<transport::LineSocket> client_;
  std::vector<JsonValue> received_;
};

TEST_F(BenchSocketTest, ARunIsFollowedToItsVerdict) {
  open(R"(echo '{"type": "at", "t_s": 1}' > "$2"; echo '{"type": "result"}' >> "$2"; exit 1)");
  start();
  ASSERT_TRUE(until([&] { return has("run", "state", "failed"); }));
  EXPECT_TRUE(has("run", "state", "running"));
  EXPECT_TRUE(has("at", "type", "at"));
  EXPECT_TRUE(has("result", "type", "result"));
  EXPECT_FALSE(server_->server().running());
}

TEST_F(BenchSocketTest, ACrashOfTheRunIsTold) {
  open("kill -SEGV $$");
  start();
  ASSERT_TRUE(until([&] { return has("run", "state", "crashed"); }));
  EXPECT_TRUE(has("run", "why", "signal 11 ended it"));
  start();  // and the server goes on
  ASSERT_TRUE(until([&] { return server_->server().running() || received_.size() > 5; }));
}

TEST_F(BenchSocketTest, AStopEndsARunThatDoesNotEndByItself) {
  open("sleep 1000");
  start();
  ASSERT_TRUE(until([&] { return has("run", "state", "running"); }));
  start();
  ASSERT_TRUE(until([&] { return has("error", "place", "start"); }));
  client_->send(R"({"do": "stop", "by": "Ana"})");
  ASSERT_TRUE(until([&] { return has("run", "state", "stopped"); }));
}

TEST_F(BenchSocketTest, ARunThatIgnoresTheStopIsKilled) {
  open("trap '' TERM; while true; do sleep 0.05; done");
  start();
  ASSERT_TRUE(until([&] { return has("run", "state", "running"); }));
  client_->send(R"({"do": "stop"})");
  ASSERT_TRUE(until([&] { return has("run", "state", "stopped"); }));
}

TEST_F(BenchSocketTest, ASweepThatEndsIsToldToWhoIsThere) {
  open("exit 0");
  ASSERT_TRUE(until([&] { return has("sweeps", "type", "sweeps"); }));
  const auto count = [&] {
    std::size_t sweeps = 0;
    for (const JsonValue& value : received_)
      if (value.text("type") == "sweeps") sweeps = value.items("sweeps").size();
    return sweeps;
  };
  EXPECT_EQ(count(), 0U);
  std::filesystem::create_directories(folder_.path() + "/sweeps/grip");
  ASSERT_TRUE(transport::write_file(
      folder_.path() + "/sweeps/grip/summary.json",
      R"({"name": "grip", "scenario": "s.yaml", "cases": 9, "passed": 9, "failed": 0,)"
      R"( "contact": 0, "refused": 0, "crashed": 0})"));
  ASSERT_TRUE(until([&] { return count() == 1; }));
}

TEST_F(BenchSocketTest, ThePageOfARunIsNamedAndRead) {
  open(R"(echo '{"type": "result"}' > "$2"; echo '<p>run</p>' > "$1/report.html"; exit 1)");
  start();
  ASSERT_TRUE(until([&] { return has("run", "page", "runs/1/report.html"); }));
  EXPECT_TRUE(has("run", "state", "failed"));
  client_->send(R"({"do": "page", "page": "runs/1/report.html", "from": 0})");
  ASSERT_TRUE(until([&] { return has("page", "text", "<p>run</p>\n"); }));
  client_->send(R"({"do": "page", "page": "runs/../good.yaml", "from": 0})");
  ASSERT_TRUE(until([&] { return has("page", "page", "runs/../good.yaml"); }));
  EXPECT_TRUE(received_.back().text("problem").starts_with("page runs/../good.yaml: error:"));
  EXPECT_EQ(server_->server().counters().refused, 1U);
}

TEST_F(BenchSocketTest, ARunWithoutAPageDoesNotShowThatOfAnEarlierServer) {
  std::filesystem::create_directories(folder_.path() + "/runs/1");
  ASSERT_TRUE(transport::write_file(folder_.path() + "/runs/1/report.html", "<p>old</p>"));
  open("exit 2");
  start();
  ASSERT_TRUE(until([&] { return has("run", "state", "unusable"); }));
  EXPECT_TRUE(received_.back().find("page")->is_null());
  EXPECT_FALSE(std::filesystem::exists(folder_.path() + "/runs/1/report.html"));
}

TEST_F(BenchSocketTest, NonsenseIsAnsweredAndTheServerGoesOn) {
  open("exit 0");
  client_->send("nonsense");
  client_->send(std::string(transport::LineSocket::kLineMax_bytes + 5, 'x'));
  client_->send(R"({"do": "start", "scenario": "none", "mode": "lockstep"})");
  ASSERT_TRUE(until([&] { return has("error", "place", "scenario"); }));
  EXPECT_EQ(server_->server().counters().refused, 2U);
}

TEST_F(BenchSocketTest, ClientsHaveABound) {
  open("exit 0");
  std::vector<transport::LineSocket> others;
  for (std::size_t i = 0; i < kMaxClients + 3; ++i) {
    auto one = transport::LineSocket::connect(folder_.path() + "/server");
    if (one) others.push_back(*std::move(one));
    server_->serve(transport::monotonic_now());
  }
  EXPECT_EQ(server_->clients(), kMaxClients);
  others.clear();
  ASSERT_TRUE(until([&] { return server_->clients() == 1; }));
}

TEST_F(BenchSocketTest, WhatCannotBeStartedIsTold) {
  open("exit 0");
  // A file where the run's folder would be.
  ASSERT_TRUE(transport::write_file(folder_.path() + "/runs/1", ""));
  start();
  ASSERT_TRUE(until([&] { return has("run", "state", "unusable"); }));
}

}  // namespace
}  // namespace pitwall::bench_server
