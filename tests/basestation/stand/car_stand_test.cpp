// SPDX-License-Identifier: Apache-2.0
#include "basestation/stand/car_stand.hpp"

#include <filesystem>

#include "protocol/json/json_value.hpp"
#include "protocol/transport/clock.hpp"
#include "tests/basestation/stand/keys.hpp"

namespace pitwall::stand {
namespace {

void nobody_hears(const std::string&) {}

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
  EXPECT_TRUE(lines.outlets.empty());
  EXPECT_EQ(stand->sight().mode, "NONE");
  EXPECT_TRUE(stand->sight().link.empty());
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
  EXPECT_EQ(stand->lines().outlets.size(), 1u) << "the journal";
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
  ASSERT_EQ(lines.outlets.size(), 2u);
  EXPECT_EQ(lines.outlets[0], stand->wall());
  const Instant now = transport::monotonic_now();
  for (outlets::Outlet* const outlet : lines.outlets) outlet->serve(stand->station(), now);
  EXPECT_EQ(looks, 1);
}

}  // namespace
}  // namespace pitwall::stand
