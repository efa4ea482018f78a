// The whole way without the radio's sockets: a car in virtual time, the wall, a real WebSocket.
// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/console/console_service.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <map>
#include <thread>

#include "protocol/json/json_value.hpp"
#include "protocol/transport/file.hpp"
#include "tests/basestation/radio_rig.hpp"
#include "tests/support/web_client.hpp"

namespace pitwall::publishers::console {
namespace {

using telemetry::field;
using web::WebClient;

class Consoles : public ::testing::Test {
 protected:
  void SetUp() override {
    web::HttpConfig http{.access = {.default_role = web::Role::kOperator}};
    http.cars.push_back({.number = 7});
    auto started = web::WebServer::start({}, std::move(http));
    ASSERT_TRUE(started);
    server_ = *std::move(started);
    consoles_ = std::make_unique<ConsoleService>(ConsoleConfig{}, *rig_.base, *server_);
    rig_.set(field("mode.mode"), 2.0);
    rig_.set(field("ego.x"), 12.5);
  }
  void run(Duration length) {
    for (const Instant end = rig_.now + length; rig_.now < end; rig_.now += RadioRig::kTick) {
      const std::uint64_t before = rig_.station->rate().packets();
      rig_.step();
      if (rig_.station->rate().packets() != before) {
        consoles_->packet(*rig_.base, *rig_.station->arrival());
      }
      consoles_->submit(*rig_.base, rig_.now);
      rig_.base->advance(rig_.now);
      consoles_->publish(*rig_.base, rig_.now);
      if (bench_ != nullptr) bench_->publish(*rig_.base, rig_.now);
      if (bench_server_ != nullptr) serve_pages();
    }
  }
  // The bench server's end: each page is the same, or there is a problem.
  void serve_pages() {
    const std::string line = R"({"type": "page", "page": "runs/1/report.html", "from": 0, )";
    for (std::size_t asked = bench_server_->receive().size(); asked > 0; --asked)
      bench_server_->send(line + (bench_problem_.empty()
                                      ? R"("next": 3, "bytes": 3, "text": "<p>"})"
                                      : R"("problem": ")" + bench_problem_ + "\"}"));
  }
  // Virtual time stands while the server's thread, which works in real time, has this to do: an
  // authority would expire in it.
  template <class Holds>
  void stand_until(const Holds& holds) {
    while (!holds()) std::this_thread::yield();
  }
  void join(WebClient& web_client) {
    ASSERT_EQ(web_client.open(server_->local().port), 101u);
    stand_until([&] { return server_->counters().joined == 1; });
    run(milliseconds(1));
    ASSERT_EQ(consoles_->clients().clients(), 1u);
  }
  // What the console does not read yet waits in its socket.
  json::JsonValue receive(WebClient& web_client, const std::string& type) {
    while (const auto received = web_client.receive()) {
      if (!received->text) {
        take(received->bytes);
        continue;
      }
      const auto value = json::JsonValue::parse(received->bytes, "text");
      if (value && value->text("type") == type) return *value;
    }
    ADD_FAILURE() << "closed before " << type;
    return {};
  }
  void take(const std::string& frame) {
    for (std::size_t at = web::kFrameHeader; at + 8 <= frame.size(); at += 8) {
      std::uint16_t id = 0;
      float value = 0.0F;
      std::memcpy(&id, frame.data() + at, sizeof id);
      std::memcpy(&value, frame.data() + at + 4, sizeof value);
      values_[id] = value;
      status_[id] = static_cast<std::uint8_t>(frame[at + 2]);
    }
  }
  // Says it, lets the base act, and gives the next text of this type.
  json::JsonValue ask(WebClient& web_client, const std::string& text, const std::string& type) {
    const std::uint64_t before = server_->counters().texts_received;
    web_client.send_text(text);
    stand_until([&] { return server_->counters().texts_received != before; });
    run(milliseconds(200));
    return receive(web_client, type);
  }

  // What the base answers to who opens a page of the bench.
  std::string page_answer() {
    std::string answer;
    std::atomic<bool> answered = false;
    std::thread browser([&] {
      answer = web::bare(server_->local().port,
                         "GET /bench/7/runs/1/report.html HTTP/1.1\r\nHost: 127.0.0.1\r\n"
                         "Connection: close\r\n\r\n",
                         false);
      answered = true;
    });
    while (!answered) run(milliseconds(20));
    browser.join();
    return answer;
  }

  RadioRig rig_{{.service = {.car = 7}}};
  std::unique_ptr<web::WebServer> server_;
  std::unique_ptr<ConsoleService> consoles_;
  bench::BenchLink* bench_ = nullptr;
  transport::LineSocket* bench_server_ = nullptr;
  std::string bench_problem_;
  std::map<int, float> values_;
  std::map<int, std::uint8_t> status_;
};

TEST_F(Consoles, AConsoleSeesTheCarAsSoonAsItJoins) {
  run(seconds(2));
  WebClient web_client;
  join(web_client);
  run(milliseconds(1'200));
  const auto hello = receive(web_client, "hello");
  EXPECT_EQ(hello.number("car"), 7.0);
  EXPECT_EQ(hello.text("mode"), "REAL");
  EXPECT_EQ(hello.text("role"), "operator");
  EXPECT_GT(receive(web_client, "catalogue").items("fields").size(), 200u);
  for (int i = 0; i < 3; ++i) receive(web_client, "link");  // the last one after the first picture
  EXPECT_EQ(values_[field("ego.x")], 12.5F);
  EXPECT_EQ(status_[field("ego.x")] & 3, 0) << "fresh";
  EXPECT_EQ(status_[field("ego.y")] & 3, 3) << "never";
  EXPECT_EQ(values_[state::id_of(state::BaseField::kLinkState)], 1.0F) << "good";
}

TEST_F(Consoles, AStopNeedsNoAuthorityAndIsInTheNextPacket) {
  run(seconds(1));
  WebClient web_client;
  join(web_client);
  ask(web_client, R"({"type":"stop","kind":"emergency"})", "audit");
  EXPECT_EQ(rig_.car->view(rig_.now).stop, telemetry::StopLevel::kEmergency);
}

TEST_F(Consoles, ACommandGoesThroughTheDesk) {
  run(seconds(1));
  WebClient web_client;
  join(web_client);
  const std::string stage = R"({"type":"stage","name":"sensors excluded","argument":2})";
  const auto without = ask(web_client, stage, "command");
  EXPECT_EQ(without.text("step"), "staged") << "a gate has not passed";
  EXPECT_TRUE(rig_.reported.empty());
  ask(web_client, R"({"type":"authority","do":"take"})", "authority");
  const auto staged = ask(web_client, stage, "command");
  const auto sent = ask(web_client,
                        R"({"type":"send","ticket":)" +
                            std::to_string(static_cast<int>(staged.number("ticket"))) + "}",
                        "command");
  ASSERT_EQ(rig_.reported.size(), 1u);
  EXPECT_EQ(rig_.reported[0].command.argument, 2.0);
  EXPECT_EQ(ask(web_client, R"({"type":"stage","name":"fly","argument":2})", "error").text("place"),
            "stage.name");
  EXPECT_EQ(ask(web_client, R"({"type":"playback","speed":2})", "error").text("place"), "playback");
}

// Also without a bench server: who wanted to start what is in the audit log.
TEST_F(Consoles, AWishForTheBenchLeavesALine) {
  run(seconds(1));
  WebClient web_client;
  join(web_client);
  const auto refused =
      ask(web_client,
          R"({"type":"bench","do":"start","scenario":"red","mode":"lockstep","seed":7})", "error");
  EXPECT_EQ(refused.text("place"), "bench");
  const command::AuditLine& line = rig_.base->requests().audit().lines().back();
  EXPECT_EQ(line.what, "bench: start red, lockstep, seed 7");
  EXPECT_TRUE(line.result.starts_with("refused: "));
}

TEST_F(Consoles, WhatTheHolderSetsIsToldToAll) {
  run(seconds(1));
  WebClient web_client;
  join(web_client);
  ask(web_client, R"({"type":"authority","do":"take"})", "authority");
  json::JsonValue reported = ask(web_client, R"({"type":"fuel_loaded","litres":40})", "expected");
  while (!(reported.number("fuel_loaded_l") == 40.0)) reported = receive(web_client, "expected");
  reported =
      ask(web_client,
          R"({"type":"edit_limit","field":"electric.battery","bad_low":11,"reason":"old one"})",
          "settings");
  while (!(reported.number("revision") == 1.0)) reported = receive(web_client, "settings");
  EXPECT_FALSE(reported.flag("kept")) << "there is no file";
  // That of the join came before the answers above: this one is that of the change.
  for (const json::JsonValue& row : receive(web_client, "catalogue").items("fields")) {
    if (row.text("path") == "electric.battery") {
      EXPECT_EQ(row.find("limits")->number("bad_low"), 11.0);
    }
  }
  EXPECT_EQ(rig_.base->evaluator().limits().of(state::field_id("electric.battery")).bad_low, 11.0);
  // A set of values; the other one stays as it was.
  constexpr state::FieldId kMode = state::field_id("mode.mode");
  const alarms::Limit before = rig_.base->evaluator().limits().of(kMode);
  reported =
      ask(web_client, R"({"type":"edit_limit","field":"mode.mode","bad_values":[3],"reason":"x"})",
          "settings");
  EXPECT_EQ(reported.number("revision"), 2.0);
  EXPECT_EQ(rig_.base->evaluator().limits().of(kMode).bad_values, 1U << 3);
  EXPECT_EQ(rig_.base->evaluator().limits().of(kMode).warning_values, before.warning_values);
  EXPECT_EQ(ask(web_client, R"({"type":"edit_budget","up_kbit_s":100,"reason":"x"})", "error")
                .text("place"),
            "budget")
      << "no budget was given at the start: there is none to lower";
}

// The hand on the joystick falls silent: medium, and gone when it speaks again.
TEST_F(Consoles, ASilentJoystickIsAnAlarm) {
  bool silent = false;
  rig_.base->watch_joystick([&](Instant) {
    return silent ? command::JoystickState::kLost : command::JoystickState::kReleased;
  });
  run(seconds(1));
  const auto alarm = [&] {
    return rig_.base->evaluator().alarms().state(*alarms::find_alarm("joystick_lost"));
  };
  EXPECT_EQ(alarm(), alarms::State::kNormal);
  silent = true;
  run(milliseconds(300));
  EXPECT_EQ(alarm(), alarms::State::kUnack);
  silent = false;
  run(seconds(2));
  EXPECT_EQ(alarm(), alarms::State::kReturnedUnack);
}

TEST_F(Consoles, ALinkThatIsLostIsShownWithinHalfASecondAndRaisesOneAlarm) {
  run(seconds(3));
  WebClient web_client;
  join(web_client);
  run(milliseconds(100));
  rig_.loses = [](bool to_base, telemetry::PathId) { return to_base; };
  run(milliseconds(600));
  EXPECT_EQ(rig_.base->evaluator().link_state(), state::LinkState::kLost);
  run(seconds(2));
  json::JsonValue alarms;
  do {
    alarms = receive(web_client, "alarms");
  } while (alarms.items("active").empty());
  EXPECT_EQ(alarms.items("active").size(), 1u);
  EXPECT_EQ(alarms.items("active")[0].text("priority"), "high");
}

TEST_F(Consoles, APageOfTheBenchIsAskedForThere) {
  std::string answer = page_answer();
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 404")) << answer;
  EXPECT_NE(answer.find("this base knows of no bench server (--bench)"), std::string::npos);

  const auto folder = transport::TemporaryFolder::create("bench");
  bench::BenchLink bench{folder->path() + "/server"};
  consoles_->attach(bench);
  bench_ = &bench;
  answer = page_answer();
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 503")) << answer;
  EXPECT_NE(answer.find("the bench server is not there"), std::string::npos);

  auto listener = *transport::LineListener::open(folder->path() + "/server");
  run(seconds(2));
  auto server = listener.accept();
  ASSERT_TRUE(server);
  bench_server_ = &*server;
  answer = page_answer();
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200")) << answer;
  EXPECT_TRUE(answer.ends_with("<p>"));
  bench_problem_ = "no such page";
  answer = page_answer();
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 404")) << answer;
  EXPECT_TRUE(answer.ends_with("no such page\n"));
}

TEST_F(Consoles, HistoryLooksBack) {
  run(seconds(5));
  WebClient web_client;
  join(web_client);
  web_client.send_text(R"({"type":"history","field":)" + std::to_string(field("ego.x")) +
                       R"(,"from_s":60,"to_s":0,"points":1000})");
  stand_until([&] { return server_->counters().texts_received != 0; });
  run(milliseconds(5));
  while (const auto received = web_client.receive()) {
    if (received->text || received->bytes[0] != 2) continue;
    std::uint32_t points = 0;
    std::memcpy(&points, received->bytes.data() + web::kFrameHeader + 4, sizeof points);
    EXPECT_GT(points, 200u);
    EXPECT_EQ(received->bytes.size(), web::kFrameHeader + 8 + points * web::kHistoryPoint);
    return;
  }
  ADD_FAILURE() << "no history";
}

}  // namespace
}  // namespace pitwall::publishers::console
