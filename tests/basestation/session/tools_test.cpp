// SPDX-License-Identifier: Apache-2.0
#include "basestation/session/tools.hpp"

#include "protocol/transport/clock.hpp"
#include "tests/basestation/session/keys.hpp"

namespace pitwall::session {
namespace {

class SessionTools : public testing::Test {
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
    auto plan = plan_of(arguments_, logger());
    ASSERT_TRUE(plan) << to_string(plan.error());
    auto started = publishers::web::WebServer::start({}, served({&*plan, 1}));
    ASSERT_TRUE(started);
    server_ = *std::move(started);
    session_ = *CarSession::open(*std::move(plan));
    ASSERT_TRUE(session_->begin(server_.get(), logger()));
  }
  LogLine logger() {
    return [this](const std::string& line) { remarks_ += line + "\n"; };
  }
  void serve_all() {
    session_->service().advance(transport::monotonic_now());
    for (service::Publisher* const publisher : session_->loop().publishers) {
      publisher->publish(session_->service(), transport::monotonic_now());
    }
  }

  Result<transport::TemporaryFolder, Problem> folder_ = transport::TemporaryFolder::create("stand");
  settings::Arguments arguments_;
  std::string remarks_;
  publishers::metrics::Board board_;
  std::unique_ptr<publishers::web::WebServer> server_;
  std::unique_ptr<CarSession> session_;
};

TEST_F(SessionTools, NothingThatIsNotAskedForIsStarted) {
  begin();
  const std::size_t before = session_->loop().publishers.size();
  ASSERT_TRUE(attach_tools(*session_, {}, logger()));
  EXPECT_EQ(session_->loop().publishers.size(), before);
  EXPECT_EQ(remarks_.find("Foxglove"), std::string::npos);
}

TEST_F(SessionTools, FoxgloveIsSaidAndIsInTheMetricsOfItsCar) {
  arguments_.foxglove_port = 0;
  begin();
  ASSERT_TRUE(attach_tools(*session_, {.board = &board_, .server = server_.get()}, logger()));
  EXPECT_NE(remarks_.find("Foxglove at ws://127.0.0.1:"), std::string::npos) << remarks_;
  serve_all();
  const std::string text = board_.text();
  EXPECT_NE(text.find(R"(pitwall_car_info{car="7",name="Blue",mode="NONE"} 1)"), std::string::npos);
  EXPECT_NE(text.find(R"(pitwall_publisher_clients{car="7",publisher="foxglove"} 0)"),
            std::string::npos);
  EXPECT_NE(text.find("pitwall_web_consoles 0"), std::string::npos);
}

TEST_F(SessionTools, OfSeveralCarsEachHasItsSpace) {
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

TEST_F(SessionTools, AWrongUrlOrOneThatLeavesTheMachineIsRefused) {
  const auto refused = [&](const char* url) {
    arguments_.lcm_url = url;
    begin();
    const auto attached = attach_tools(*session_, {}, logger());
    return attached ? std::string{} : to_string(attached.error());
  };
  EXPECT_NE(refused("tcpq://localhost").find("udpm://"), std::string::npos);
  EXPECT_NE(refused("udpm://239.255.76.67:7667?ttl=1").find("--network"), std::string::npos);
}

TEST_F(SessionTools, FoxgloveOnANetworkTakesTokensOfItsOwn) {
  arguments_.foxglove_port = 0;
  arguments_.foxglove_address = "0.0.0.0";
  begin();
  const auto refused = attach_tools(*session_, {}, logger());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().place, "--foxglove-address 0.0.0.0");
  arguments_.foxglove_tokens = folder_->path() + "/readers";
  ASSERT_TRUE(
      transport::write_file(arguments_.foxglove_tokens, "viewer 77aa0c1be04f43f2 Garage\n", 0600));
  begin();
  const auto attached = attach_tools(*session_, {}, logger());
  EXPECT_TRUE(attached) << to_string(attached.error());
}

TEST_F(SessionTools, WhatTheBaseFindsIsLookedAt) {
  begin();
  serve_all();
  publishers::ros_view::BaseStatus base_status;
  status_reader_of(session_->service())(base_status, transport::monotonic_now());
  EXPECT_EQ(base_status.values[state::index_of(state::BaseField::kLinkState)], 0.0) << "none yet";
}

}  // namespace
}  // namespace pitwall::session
