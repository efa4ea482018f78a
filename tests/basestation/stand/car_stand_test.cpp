// SPDX-License-Identifier: Apache-2.0
#include "basestation/stand/car_stand.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <span>

#include "basestation/intake/stamp_file.hpp"
#include "protocol/json/json_value.hpp"
#include "protocol/telemetry/endpoint/car_endpoint.hpp"
#include "protocol/transport/clock.hpp"
#include "tests/basestation/stand/keys.hpp"

namespace pitwall::stand {
namespace {

void nobody_hears(const std::string&) {}

constexpr Duration kPatience = seconds(10);  // of a loaded machine; nothing is measured with it
constexpr auto kMinute = static_cast<telemetry::Stamp>(seconds(60).ns);

// The car's radio on a socket of this machine, at a fixed time of day.
class Car {
 public:
  static constexpr telemetry::Stamp kStamp = 1'795'000'000'000'000'000;

  Car(const std::string& key_file, transport::UdpAddress base) : base_(base) {
    telemetry::ConduitConfig config;
    config.association.keys = *intake::read_keys(key_file, telemetry::Role::kCar);
    config.association.peer[0] = {.ip = base.ip, .port = base.port};
    config.association.to_utc = Instant{kStamp} - transport::monotonic_now();
    end_.emplace(config, randomness_);
  }
  void turn() {
    std::vector<transport::UdpDatagram> inbox(transport::UdpSocket::kBatch);
    for (const auto& d : std::span(inbox).first(socket_->receive(inbox))) {
      end_->feed(d.payload(), 0, {.ip = d.from.ip, .port = d.from.port}, d.at);
    }
    while (const auto out = end_->poll({}, transport::monotonic_now())) {
      socket_->send_to(base_, out->bytes);
    }
  }

 private:
  transport::UdpAddress base_;
  telemetry::SystemRandomness randomness_;
  std::optional<telemetry::CarEndpoint> end_;
  Result<transport::UdpSocket, Problem> socket_ = transport::UdpSocket::bind({});
};

class Stand : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(folder_);
    arguments_.car = 7;
    arguments_.car_name = "Blue";
    arguments_.keys = made_keys(*folder_, "keys");
    arguments_.listen = {"127.0.0.1:0", "127.0.0.1:0"};
  }
  std::unique_ptr<CarStand> opened() {
    auto plan = plan_of(arguments_, nobody_hears);
    EXPECT_TRUE(plan) << to_string(plan.error());
    auto stand = CarStand::open(*std::move(plan));
    EXPECT_TRUE(stand) << to_string(stand.error());
    return stand ? *std::move(stand) : nullptr;
  }
  // What is said by a stand that had a session with its car; its stamp file is written.
  std::string stamp_after_a_session() {
    std::string said;
    const auto stand = opened();
    EXPECT_TRUE(stand->begin(nullptr, [&](const std::string& line) { said += line + "\n"; }));
    const outlets::Lines lines = stand->lines();
    Car car(folder_->path() + "/keys/car.keys", lines.radio[0].local());
    std::vector<transport::UdpDatagram> inbox(transport::UdpSocket::kBatch);
    const Instant limit = transport::monotonic_now() + kPatience;
    const auto waits = [&] {
      return transport::monotonic_now() < limit &&
             (stand->station().endpoint().report(limit).sessions == 0 ||
              (arguments_.stamp_file.find("nowhere") != std::string::npos && said.empty()));
    };
    while (waits()) {
      car.turn();
      for (const auto& d : std::span(inbox).first(lines.radio[0].receive(inbox))) {
        stand->station().take(d.payload(), 0, {.ip = d.from.ip, .port = d.from.port}, d.at);
        while (const auto out = stand->station().poll(transport::monotonic_now())) {
          lines.radio[0].send_to({.ip = out->to.ip, .port = out->to.port}, out->bytes);
        }
      }
      for (outlets::Outlet* const outlet : lines.outlets) {
        outlet->serve(stand->station(), transport::monotonic_now());
      }
      transport::sleep_until(transport::monotonic_now() + milliseconds(2));
    }
    EXPECT_EQ(stand->station().endpoint().report(limit).sessions, 1U);
    return said;
  }

  Result<transport::TemporaryFolder, Problem> folder_ = transport::TemporaryFolder::create("stand");
  settings::Arguments arguments_;
};

TEST_F(Stand, HasItsSocketsAndAStationAtOnce) {
  const auto stand = opened();
  ASSERT_TRUE(stand);
  EXPECT_EQ(stand->title(), "CAR 7 Blue");
  EXPECT_EQ(stand->listening().find("listening at 127.0.0.1:"), 0u) << stand->listening();
  EXPECT_NE(stand->listening().find(" and 127.0.0.1:"), std::string::npos);
  ASSERT_TRUE(stand->begin(nullptr, nobody_hears));
  const outlets::Lines lines = stand->lines();
  EXPECT_EQ(lines.radio.size(), 2u);
  EXPECT_EQ(lines.station, &stand->station());
  EXPECT_EQ(lines.words, nullptr);
  EXPECT_EQ(lines.outlets.size(), 1u) << "the stamp's keeper";
  EXPECT_EQ(stand->sight().mode, "NONE");
  EXPECT_TRUE(stand->sight().link.empty());
}

TEST_F(Stand, KeepsTheNewestStampOfItsCarUnlessItIsTold) {
  const std::string path = folder_->path() + "/keys/base.stamp";
  EXPECT_EQ(stamp_after_a_session(), "");
  EXPECT_GE(intake::read_stamp(path).value_or(0), Car::kStamp);
  EXPECT_LT(intake::read_stamp(path).value_or(0), Car::kStamp + kMinute);
  arguments_.stamp_file = folder_->path() + "/elsewhere";
  EXPECT_EQ(stamp_after_a_session(), "");
  EXPECT_GE(intake::read_stamp(arguments_.stamp_file).value_or(0), Car::kStamp);
  std::filesystem::remove(path);
  arguments_.stamp_file = "none";
  EXPECT_EQ(stamp_after_a_session(), "");
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST_F(Stand, SaysOnceThatItsStampCannotBeKept) {
  arguments_.stamp_file = folder_->path() + "/nowhere/base.stamp";
  const std::string said = stamp_after_a_session();
  EXPECT_EQ(said.find("stamp file not written: " + arguments_.stamp_file), 0U) << said;
  EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
}

TEST_F(Stand, ASocketThatIsTakenIsTold) {
  const auto taken = transport::UdpSocket::bind({});
  ASSERT_TRUE(taken);
  arguments_.listen = {to_string(taken->local())};
  auto plan = plan_of(arguments_, nobody_hears);
  ASSERT_TRUE(plan);
  EXPECT_FALSE(CarStand::open(*std::move(plan)));
}

TEST_F(Stand, RecordsIntoItsOwnFolderAndWritesItsSummary) {
  arguments_.record_folder = folder_->path() + "/recording";
  arguments_.json_path = folder_->path() + "/summary.json";
  const auto stand = opened();
  ASSERT_TRUE(stand);
  ASSERT_TRUE(stand->begin(nullptr, nobody_hears));
  EXPECT_EQ(stand->lines().outlets.size(), 2u) << "the stamp's keeper and the journal";
  EXPECT_TRUE(std::filesystem::is_directory(arguments_.record_folder));
  ASSERT_TRUE(stand->write_summary());
  const auto text = transport::read_file(arguments_.json_path);
  ASSERT_TRUE(text);
  EXPECT_TRUE(json::JsonValue::parse(*text, "summary"));
}

TEST_F(Stand, WhatCannotBeRecordedOrHeldIsTold) {
  arguments_.record_folder = arguments_.keys;  // a file
  auto stand = opened();
  ASSERT_TRUE(stand);
  EXPECT_FALSE(stand->begin(nullptr, nobody_hears));
  arguments_.record_folder.clear();
  arguments_.joystick = folder_->path() + "/no_device";
  stand = opened();
  ASSERT_TRUE(stand);
  EXPECT_FALSE(stand->begin(nullptr, nobody_hears));
}

TEST_F(Stand, ShowsItselfToConsolesAndToWhatIsAttached) {
  arguments_.web_port = 0;
  auto web = outlets::web::WebServer::start({}, {});
  ASSERT_TRUE(web);
  const auto stand = opened();
  ASSERT_TRUE(stand);
  ASSERT_TRUE(stand->begin(web->get(), nobody_hears));
  int looks = 0;
  stand->attach(std::make_unique<Roster>(**web, [&] {
    ++looks;
    return std::vector<CarSight>{stand->sight()};
  }));
  const outlets::Lines lines = stand->lines();
  ASSERT_EQ(lines.outlets.size(), 3u);
  EXPECT_EQ(lines.outlets[0], stand->wall());
  const Instant now = transport::monotonic_now();
  for (outlets::Outlet* const outlet : lines.outlets) outlet->serve(stand->station(), now);
  EXPECT_EQ(looks, 1);
}

}  // namespace
}  // namespace pitwall::stand
