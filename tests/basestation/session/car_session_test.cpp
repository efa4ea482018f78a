// SPDX-License-Identifier: Apache-2.0
#include "basestation/session/car_session.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <span>

#include "basestation/link/stamp_file.hpp"
#include "protocol/json/json_value.hpp"
#include "protocol/telemetry/endpoint/car_endpoint.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/stream/line_socket.hpp"
#include "tests/basestation/session/keys.hpp"

namespace pitwall::session {
namespace {

void nobody_hears(const std::string&) {}

constexpr Duration kTimeout = seconds(10);  // of a loaded machine; nothing is measured with it
constexpr auto kMinute = static_cast<telemetry::Stamp>(seconds(60).ns);

// The car's radio on a socket of this machine, at a fixed time of day.
class Car {
 public:
  static constexpr telemetry::Stamp kStamp = 1'795'000'000'000'000'000;

  Car(const std::string& key_file, UdpAddress base) : base_(base) {
    telemetry::LinkEndpointConfig config;
    config.association.keys = *link::read_keys(key_file, telemetry::Role::kCar);
    config.association.peer[0] = base;
    config.association.to_utc = Instant{kStamp} - transport::monotonic_now();
    end_.emplace(config, randomness_);
  }
  void turn() {
    std::vector<transport::UdpDatagram> inbox(transport::UdpSocket::kBatch);
    for (const auto& d : std::span(inbox).first(socket_->receive(inbox))) {
      end_->feed(d.payload(), 0, d.from, d.at);
    }
    while (const auto out = end_->poll({}, transport::monotonic_now())) {
      socket_->send_to(base_, out->bytes);
    }
  }

 private:
  UdpAddress base_;
  telemetry::SystemRandomness randomness_;
  std::optional<telemetry::CarEndpoint> end_;
  Result<transport::UdpSocket, Problem> socket_ = transport::UdpSocket::bind({});
};

class Session : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(folder_);
    arguments_.car = 7;
    arguments_.car_name = "Blue";
    arguments_.keys = made_keys(*folder_, "keys");
    arguments_.listen = {"127.0.0.1:0", "127.0.0.1:0"};
  }
  std::unique_ptr<CarSession> opened() {
    auto plan = plan_of(arguments_, nobody_hears);
    EXPECT_TRUE(plan) << to_string(plan.error());
    auto session = CarSession::open(*std::move(plan));
    EXPECT_TRUE(session) << to_string(session.error());
    return session ? *std::move(session) : nullptr;
  }
  // What is said by a session that had a session with its car; its stamp file is written.
  std::string stamp_after_a_session() {
    std::string output;
    const auto session = opened();
    EXPECT_TRUE(session->begin(nullptr, [&](const std::string& line) { output += line + "\n"; }));
    const service::CarLoop loop = session->loop();
    Car car(folder_->path() + "/keys/car.keys", loop.radio[0].local());
    std::vector<transport::UdpDatagram> inbox(transport::UdpSocket::kBatch);
    const Instant limit = transport::monotonic_now() + kTimeout;
    const auto waits = [&] {
      return transport::monotonic_now() < limit &&
             (session->service().link().endpoint().report(limit).sessions == 0 ||
              (arguments_.stamp_file.find("nowhere") != std::string::npos && output.empty()));
    };
    while (waits()) {
      car.turn();
      for (const auto& d : std::span(inbox).first(loop.radio[0].receive(inbox))) {
        session->service().receive(d.payload(), 0, d.from, d.at);
        while (const auto out = session->service().link().poll(transport::monotonic_now())) {
          loop.radio[0].send_to(out->to, out->bytes);
        }
      }
      for (service::Publisher* const publisher : loop.publishers) {
        publisher->publish(session->service(), transport::monotonic_now());
      }
      transport::sleep_until(transport::monotonic_now() + milliseconds(2));
    }
    EXPECT_EQ(session->service().link().endpoint().report(limit).sessions, 1U);
    return output;
  }

  Result<transport::TemporaryFolder, Problem> folder_ =
      transport::TemporaryFolder::create("session");
  settings::Arguments arguments_;
};

TEST_F(Session, HasItsSocketsAndAStationAtOnce) {
  const auto session = opened();
  ASSERT_TRUE(session);
  EXPECT_EQ(session->title(), "CAR 7 Blue");
  EXPECT_EQ(session->listening().find("listening at 127.0.0.1:"), 0u) << session->listening();
  EXPECT_NE(session->listening().find(" and 127.0.0.1:"), std::string::npos);
  ASSERT_TRUE(session->begin(nullptr, nobody_hears));
  const service::CarLoop loop = session->loop();
  EXPECT_EQ(loop.radio.size(), 2u);
  EXPECT_EQ(loop.service, &session->service());
  EXPECT_EQ(loop.stop_port, nullptr);
  EXPECT_EQ(loop.commands, nullptr);
  EXPECT_EQ(loop.publishers.size(), 1u) << "the stamp's keeper";
  EXPECT_EQ(session->status().mode, "NONE");
  EXPECT_TRUE(session->status().link.empty());
}

TEST_F(Session, KeepsTheNewestStampOfItsCarUnlessItIsTold) {
  const std::string path = folder_->path() + "/keys/base.stamp";
  EXPECT_EQ(stamp_after_a_session(), "");
  EXPECT_GE(link::read_stamp(path).value_or(0), Car::kStamp);
  EXPECT_LT(link::read_stamp(path).value_or(0), Car::kStamp + kMinute);
  arguments_.stamp_file = folder_->path() + "/elsewhere";
  EXPECT_EQ(stamp_after_a_session(), "");
  EXPECT_GE(link::read_stamp(arguments_.stamp_file).value_or(0), Car::kStamp);
  std::filesystem::remove(path);
  arguments_.stamp_file = "none";
  EXPECT_EQ(stamp_after_a_session(), "");
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST_F(Session, SaysOnceThatItsStampCannotBeKept) {
  arguments_.stamp_file = folder_->path() + "/nowhere/base.stamp";
  const std::string output = stamp_after_a_session();
  EXPECT_EQ(output.find("stamp file not written: " + arguments_.stamp_file), 0U) << output;
  EXPECT_EQ(std::ranges::count(output, '\n'), 1) << output;
}

TEST_F(Session, ASocketThatIsTakenIsTold) {
  const auto taken = transport::UdpSocket::bind({});
  ASSERT_TRUE(taken);
  arguments_.listen = {to_string(taken->local())};
  auto plan = plan_of(arguments_, nobody_hears);
  ASSERT_TRUE(plan);
  EXPECT_FALSE(CarSession::open(*std::move(plan)));
}

TEST_F(Session, RecordsIntoItsOwnFolderAndWritesItsSummary) {
  arguments_.record_folder = folder_->path() + "/recording";
  arguments_.json_path = folder_->path() + "/summary.json";
  const auto session = opened();
  ASSERT_TRUE(session);
  ASSERT_TRUE(session->begin(nullptr, nobody_hears));
  EXPECT_EQ(session->loop().publishers.size(), 2u) << "the stamp's keeper and the journal";
  EXPECT_TRUE(std::filesystem::is_directory(arguments_.record_folder));
  ASSERT_TRUE(session->write_summary());
  const auto text = transport::read_file(arguments_.json_path);
  ASSERT_TRUE(text);
  EXPECT_TRUE(json::JsonValue::parse(*text, "summary"));
}

TEST_F(Session, WhatCannotBeRecordedOrHeldIsTold) {
  arguments_.record_folder = arguments_.keys;  // a file
  auto session = opened();
  ASSERT_TRUE(session);
  EXPECT_FALSE(session->begin(nullptr, nobody_hears));
  arguments_.record_folder.clear();
  arguments_.joystick = folder_->path() + "/no_device";
  session = opened();
  ASSERT_TRUE(session);
  EXPECT_FALSE(session->begin(nullptr, nobody_hears));
}

TEST_F(Session, ShowsItselfToConsoles) {
  arguments_.web_port = 0;
  auto web = publishers::web::WebServer::start({}, {});
  ASSERT_TRUE(web);
  const auto session = opened();
  ASSERT_TRUE(session);
  ASSERT_TRUE(session->begin(web->get(), nobody_hears));
  const service::CarLoop loop = session->loop();
  ASSERT_EQ(loop.publishers.size(), 2u) << "consoles, and the stamp's keeper";
  EXPECT_EQ(session->status().number, 7);
}

TEST_F(Session, ACommandSocketIsItsOwnersAndJudgedByTheGates) {
  arguments_.command_socket = folder_->path() + "/commands";
  const auto session = opened();
  ASSERT_TRUE(session);
  const auto mode = std::filesystem::status(arguments_.command_socket).permissions();
  EXPECT_EQ(mode & std::filesystem::perms::all,
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  auto client = transport::LineSocket::connect(arguments_.command_socket);
  ASSERT_TRUE(client);
  client->send("command speed_limit 30");
  client->flush();
  std::vector<std::string> answers;
  const Instant limit = transport::monotonic_now() + kTimeout;
  while (answers.empty() && transport::monotonic_now() < limit) {
    session->loop().commands->serve(session->service().requests(), transport::monotonic_now());
    for (std::string& line : client->receive()) answers.push_back(std::move(line));
  }
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_EQ(answers[0].find("refused: gate link"), 0u) << answers[0];
  EXPECT_EQ(session->service().requests().audit().lines().back().who, "command socket");
}

}  // namespace
}  // namespace pitwall::session
