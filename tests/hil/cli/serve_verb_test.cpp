// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/serve_verb.hpp"

#include <gtest/gtest.h>

#include <csignal>

#include "protocol/json/json_value.hpp"
#include "protocol/transport/stream/line_socket.hpp"
#include "tests/hil/cli/program_run.hpp"

namespace pitwall::cli {
namespace {

using json::JsonValue;

class ServeVerb : public ProgramRun {};

TEST_F(ServeVerb, WrongUsageIsTold) {
  expect_refusal({"serve"}, "--socket");
  expect_refusal({"serve", "--socket", path("s"), "--radio-port", "70000"}, "--radio-port");
  expect_refusal({"serve", "--socket", path("s"), "--scenarios", path("none")}, path("none"));
  expect_refusal({"serve", "--socket", path("no/such/folder/s"), "--runs", path("runs")},
                 "no/such/folder");
}

// As a client sees it: the real program runs a real scenario in lockstep, twice with one seed.
TEST_F(ServeVerb, ARunIsStartedFollowedAndJudged) {
  auto server = transport::Process::spawn(
      {.argv = {PITWALL_TESTED_PROGRAM, "serve", "--socket", path("s"), "--runs", path("runs")},
       .folder = PITWALL_SOURCE_DIR});
  ASSERT_TRUE(server);
  const Instant limit = transport::monotonic_now() + seconds(120);
  auto client = transport::LineSocket::connect(path("s"));
  while (!client && transport::monotonic_now() < limit) {
    transport::sleep_until(transport::monotonic_now() + milliseconds(20));
    client = transport::LineSocket::connect(path("s"));
  }
  ASSERT_TRUE(client) << to_string(client.error());
  client->send(R"({"do": "start", "scenario": "launch_and_stop", "mode": "lockstep",)"
               R"("seed": 5, "by": "test"})");
  std::string state;
  std::size_t scenarios = 0, states = 0, plans = 0;
  while (transport::monotonic_now() < limit && (state.empty() || state == "running")) {
    for (const std::string& line : client->receive()) {
      const auto value = JsonValue::parse(line, "line");
      ASSERT_TRUE(value) << line;
      const std::string type = value->text("type");
      EXPECT_NE(type, "error") << line;
      if (type == "scenario") ++scenarios;
      if (type == "plan") ++plans;
      if (type == "at") ++states;
      if (type == "run") state = value->text("state");
    }
    transport::sleep_until(transport::monotonic_now() + milliseconds(10));
  }
  EXPECT_EQ(state, "passed");
  EXPECT_GT(scenarios, 50U);
  EXPECT_EQ(plans, 1U);
  EXPECT_GT(states, 10U);
  for (const char* const file : {"junit.xml", "report.html", "events.mcap", "progress.jsonl"})
    EXPECT_TRUE(exists(std::string{"runs/1/"} + file)) << file;
  server->kill(SIGTERM);
  const auto status = server->wait_until(transport::monotonic_now() + seconds(60));
  ASSERT_TRUE(status);
  EXPECT_EQ(status->shell_code(), 0);
  EXPECT_FALSE(exists("s"));
}

}  // namespace
}  // namespace pitwall::cli
