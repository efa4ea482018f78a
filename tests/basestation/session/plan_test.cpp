// SPDX-License-Identifier: Apache-2.0
#include "basestation/session/plan.hpp"

#include "tests/basestation/session/keys.hpp"

namespace pitwall::session {
namespace {

class Plans : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(folder_); }

  settings::Arguments car(int number) {
    settings::Arguments car;
    car.car = number;
    car.keys = made_keys(*folder_, std::to_string(number));
    car.listen = {"127.0.0.1:0"};
    car.web_port = 0;
    return car;
  }
  Result<std::vector<Plan>, Problem> planned(const std::vector<settings::Arguments>& cars) {
    return plans_of(cars, [this](const std::string& line) { remarks_.push_back(line); });
  }

  Result<transport::TemporaryFolder, Problem> folder_ = transport::TemporaryFolder::create("plans");
  std::vector<std::string> remarks_;
};

TEST_F(Plans, EachCarHasItsOwnPlaceKeysAndDocuments) {
  settings::Arguments first = car(7), second = car(8);
  second.track = "lvms";
  auto plans = planned({first, second});
  ASSERT_TRUE(plans) << to_string(plans.error());
  ASSERT_EQ(plans->size(), 2u);
  EXPECT_EQ((*plans)[0].console.place, 0u);
  EXPECT_EQ((*plans)[1].console.place, 1u);
  EXPECT_EQ((*plans)[1].service.car, 8);
  EXPECT_FALSE((*plans)[0].config.association.keys.own.public_key ==
               (*plans)[1].config.association.keys.own.public_key);
  const publishers::web::HttpConfig http = served(*plans);
  ASSERT_EQ(http.cars.size(), 2u);
  EXPECT_EQ(http.cars[0].number, 7);
  EXPECT_TRUE(http.cars[0].documents.at("/api/track").empty());
  EXPECT_FALSE(http.cars[1].documents.at("/api/track").empty());
  EXPECT_FALSE(http.cars[0].documents.at("/api/catalogue").empty());
  EXPECT_NE(http.documents.at("/api/cars").find("\"number\": 8"), std::string::npos)
      << http.documents.at("/api/cars");
}

TEST_F(Plans, CarsWithTheSameKeysAreRefused) {
  settings::Arguments first = car(7), second = car(8);
  second.keys = folder_->path() + "/copy.keys";
  std::filesystem::copy_file(first.keys, second.keys);
  const auto plans = planned({first, second});
  ASSERT_FALSE(plans);
  EXPECT_EQ(plans.error().place.find("car 8"), 0u) << to_string(plans.error());
  EXPECT_NE(plans.error().what.find("car 7"), std::string::npos);
}

TEST_F(Plans, EachCarHasItsStampFileBesideItsKeysOrWhereItIsAskedFor) {
  settings::Arguments first = car(7), second = car(8), third = car(9);
  second.stamp_file = folder_->path() + "/eight";
  third.stamp_file = "none";
  ASSERT_TRUE(transport::write_file(folder_->path() + "/7/base.stamp", "stamp: 71\n", 0600));
  ASSERT_TRUE(transport::write_file(folder_->path() + "/eight", "stamp: 81\n", 0600));
  ASSERT_TRUE(transport::write_file(folder_->path() + "/9/base.stamp", "stamp: 91\n", 0600));
  const auto plans = planned({first, second, third});
  ASSERT_TRUE(plans) << to_string(plans.error());
  EXPECT_EQ((*plans)[0].stamp_file, folder_->path() + "/7/base.stamp");
  EXPECT_EQ((*plans)[0].config.association.newest_stamp, 71U);
  EXPECT_EQ((*plans)[1].stamp_file, second.stamp_file);
  EXPECT_EQ((*plans)[1].config.association.newest_stamp, 81U);
  EXPECT_EQ((*plans)[2].stamp_file, "");
  EXPECT_EQ((*plans)[2].config.association.newest_stamp, 0U);
  EXPECT_TRUE(remarks_.empty());
}

TEST_F(Plans, AStampFileThatCannotBeReadIsToldAndStopsNothing) {
  ASSERT_TRUE(planned({car(7)})) << "one that is not there is none yet";
  EXPECT_TRUE(remarks_.empty());
  settings::Arguments arguments = car(8);
  const std::string path = folder_->path() + "/8/base.stamp";
  ASSERT_TRUE(transport::write_file(path, "stamp: 8", 0600));
  const auto plans = planned({arguments});
  ASSERT_TRUE(plans) << to_string(plans.error());
  EXPECT_EQ(plans->front().config.association.newest_stamp, 0U);
  EXPECT_EQ(plans->front().stamp_file, path) << "it is written anew";
  ASSERT_EQ(remarks_.size(), 1U);
  EXPECT_EQ(remarks_[0].find("stamp file unreadable: " + path + ":1: error: is cut short"), 0U)
      << remarks_[0];
}

TEST_F(Plans, TwoCarsWithOneStampFileAreRefused) {
  settings::Arguments first = car(7), second = car(8);
  first.stamp_file = second.stamp_file = folder_->path() + "/shared";
  const auto plans = planned({first, second});
  ASSERT_FALSE(plans);
  EXPECT_EQ(to_string(plans.error()),
            "car 8: " + second.stamp_file +
                ": error: car 7 has the same stamp file; each car needs its own");
  first.stamp_file = second.stamp_file = "none";
  EXPECT_TRUE(planned({first, second}));
}

TEST_F(Plans, AMistakeNamesTheCarWhereThereAreSeveral) {
  settings::Arguments first = car(7), second = car(8);
  second.listen = {"0.0.0.0:23431"};
  const auto plans = planned({first, second});
  ASSERT_FALSE(plans);
  EXPECT_EQ(plans.error().place.find("car 8: --listen"), 0u) << to_string(plans.error());
  const auto alone = planned({second});
  ASSERT_FALSE(alone);
  EXPECT_EQ(alone.error().place.find("--listen"), 0u) << to_string(alone.error());
}

// The radio's address says nothing about who may come to the console.
TEST_F(Plans, OpeningTheRadioOpensNoConsole) {
  settings::Arguments arguments = car(7);
  arguments.web_port = 8080;
  arguments.network = true;
  arguments.listen = {"0.0.0.0:23431"};
  auto plans = planned({arguments});
  ASSERT_TRUE(plans) << to_string(plans.error());
  EXPECT_EQ((*plans)[0].http.access.default_role, publishers::web::Role::kOperator);
  arguments.web_address = "0.0.0.0";
  plans = planned({arguments});
  ASSERT_FALSE(plans);
  EXPECT_EQ(plans.error().place, "--web-address 0.0.0.0");
  arguments.tokens_file = folder_->path() + "/tokens";
  ASSERT_TRUE(
      transport::write_file(arguments.tokens_file, "operator 8f2c41d09b7a4d51 Anna\n", 0600));
  plans = planned({arguments});
  ASSERT_TRUE(plans) << to_string(plans.error());
  EXPECT_FALSE((*plans)[0].http.access.default_role);
  arguments.default_role = "viewer";
  plans = planned({arguments});
  ASSERT_FALSE(plans);
  EXPECT_EQ(plans.error().place, "--default-role viewer");
}

TEST_F(Plans, AFileOfTokensBindsOnLoopbackTooUnlessARoleIsNamed) {
  settings::Arguments arguments = car(7);
  arguments.web_port = 8080;
  arguments.tokens_file = folder_->path() + "/tokens";
  ASSERT_TRUE(
      transport::write_file(arguments.tokens_file, "operator 8f2c41d09b7a4d51 Anna\n", 0600));
  EXPECT_FALSE((*planned({arguments}))[0].http.access.default_role);
  arguments.default_role = "viewer";
  EXPECT_EQ((*planned({arguments}))[0].http.access.default_role, publishers::web::Role::kViewer);
}

TEST_F(Plans, WhatIsMissingIsTold) {
  for (const auto& [change, place] :
       std::vector<std::pair<void (*)(settings::Arguments&), std::string>>{
           {[](settings::Arguments& a) { a.keys.clear(); }, "--keys"},
           {[](settings::Arguments& a) { a.listen = {"here"}; }, "--listen"},
           {[](settings::Arguments& a) {
              a.listen = {"127.0.0.1:1", "127.0.0.1:2", "127.0.0.1:3"};
            },
            "--listen"},
           {[](settings::Arguments& a) { a.web_port = 1, a.tokens_file = "/nowhere"; }, "/nowhere"},
           {[](settings::Arguments& a) { a.command_file = "/nowhere"; }, "/nowhere"},
           {[](settings::Arguments& a) { a.track = "/nowhere.yaml"; }, "/nowhere.yaml"}}) {
    settings::Arguments arguments = car(static_cast<int>(remarks_.size()) + 1);
    change(arguments);
    const auto plan = planned({arguments});
    ASSERT_FALSE(plan) << place;
    EXPECT_NE(to_string(plan.error()).find(place), std::string::npos) << to_string(plan.error());
    remarks_.emplace_back();
  }
}

TEST_F(Plans, KeysOfABenchAreSaidAndOnlyTheirSessionsAreLogged) {
  settings::Arguments arguments = car(7);
  EXPECT_TRUE(planned({arguments}));
  EXPECT_EQ(remarks_.size(), 0u);
  arguments.key_log = folder_->path() + "/keys.log";
  const auto refused = planned({arguments});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().place, "--key-log");
  arguments.keys = made_keys(*folder_, "bench", true);
  const auto plans = planned({arguments});
  ASSERT_TRUE(plans) << to_string(plans.error());
  EXPECT_TRUE(plans->front().config.association.key_log);
  ASSERT_EQ(remarks_.size(), 1u);
  EXPECT_NE(remarks_[0].find("KEYS OF A BENCH"), std::string::npos) << remarks_[0];
  EXPECT_NE(remarks_[0].find(arguments.key_log), std::string::npos) << remarks_[0];
}

TEST_F(Plans, AReplayNeedsNoRadioAndSaysThatItIsOne) {
  settings::Arguments arguments;
  arguments.replay_folder = "race";
  arguments.car = 7;
  auto plan = plan_of_replay(arguments, [](const std::string&) {});
  ASSERT_TRUE(plan) << to_string(plan.error());
  EXPECT_TRUE(plan->listen.empty());
  EXPECT_NE(served({&*plan, 1}).documents.at("/api/cars").find("REPLAY"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::session
