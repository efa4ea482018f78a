// SPDX-License-Identifier: Apache-2.0
#include "basestation/stand/tools.hpp"

#include "protocol/transport/clock.hpp"
#include "tests/basestation/stand/keys.hpp"

namespace pitwall::stand {
namespace {

class StandTools : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(folder_);
    arguments_.car = 7;
    arguments_.car_name = "Blue";
    arguments_.keys = made_keys(*folder_, "keys");
    arguments_.listen = {"127.0.0.1:0"};
    arguments_.web_port = 0;
  }
  void begin() {
    auto plan = plan_of(arguments_, say());
    ASSERT_TRUE(plan) << to_string(plan.error());
    auto started = outlets::web::WebServer::start({}, served({&*plan, 1}));
    ASSERT_TRUE(started);
    server_ = *std::move(started);
    stand_ = *CarStand::open(*std::move(plan));
    ASSERT_TRUE(stand_->begin(server_.get(), say()));
  }
  Say say() {
    return [this](const std::string& line) { said_ += line + "\n"; };
  }
  void serve_all() {
    for (outlets::Outlet* const outlet : stand_->lines().outlets) {
      outlet->serve(stand_->station(), transport::monotonic_now());
    }
  }

  Result<transport::TemporaryFolder, Problem> folder_ = transport::TemporaryFolder::create("stand");
  settings::Arguments arguments_;
  std::string said_;
  outlets::metrics::Board board_;
  std::unique_ptr<outlets::web::WebServer> server_;
  std::unique_ptr<CarStand> stand_;
};

TEST_F(StandTools, NothingThatIsNotAskedForIsStarted) {
  begin();
  const std::size_t before = stand_->lines().outlets.size();
  ASSERT_TRUE(attach_tools(*stand_, {}, say()));
  EXPECT_EQ(stand_->lines().outlets.size(), before);
  EXPECT_EQ(said_.find("Foxglove"), std::string::npos);
}

TEST_F(StandTools, FoxgloveIsSaidAndIsInTheMetricsOfItsCar) {
  arguments_.foxglove_port = 0;
  begin();
  ASSERT_TRUE(attach_tools(*stand_, {.board = &board_, .server = server_.get()}, say()));
  EXPECT_NE(said_.find("Foxglove at ws://127.0.0.1:"), std::string::npos) << said_;
  serve_all();
  const std::string text = board_.text();
  EXPECT_NE(text.find(R"(pitwall_car_info{car="7",name="Blue",mode="NONE"} 1)"), std::string::npos);
  EXPECT_NE(text.find(R"(pitwall_outlet_clients{car="7",outlet="foxglove"} 0)"), std::string::npos);
  EXPECT_NE(text.find("pitwall_web_consoles 0"), std::string::npos);
}

TEST_F(StandTools, OfSeveralCarsEachHasItsSpace) {
  EXPECT_EQ(view_of(arguments_, 1)->space, "");
  EXPECT_EQ(view_of(arguments_, 2)->space, "/car7");
  arguments_.track = "lvms";
  const auto view = view_of(arguments_, 1);
  ASSERT_TRUE(view);
  EXPECT_TRUE(view->course);
  EXPECT_TRUE(view->datum);
  arguments_.track = "nowhere";
  EXPECT_FALSE(view_of(arguments_, 1));
}

TEST_F(StandTools, AWrongUrlOrOneThatLeavesTheMachineIsRefused) {
  const auto refused = [&](const char* url) {
    arguments_.lcm_url = url;
    begin();
    const auto attached = attach_tools(*stand_, {}, say());
    return attached ? std::string{} : to_string(attached.error());
  };
  EXPECT_NE(refused("tcpq://localhost").find("udpm://"), std::string::npos);
  EXPECT_NE(refused("udpm://239.255.76.67:7667?ttl=1").find("--network"), std::string::npos);
}

TEST_F(StandTools, WhatTheBaseFindsIsLookedAt) {
  begin();
  serve_all();
  outlets::ros_view::BaseSight sight;
  look_of (*stand_->wall())(sight, transport::monotonic_now());
  EXPECT_EQ(sight.values[picture::index_of(picture::BaseField::kLinkState)], 0.0) << "none yet";
}

}  // namespace
}  // namespace pitwall::stand
