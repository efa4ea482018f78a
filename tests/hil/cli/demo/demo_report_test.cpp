// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/demo/demo_report.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "protocol/transport/file.hpp"

namespace pitwall::cli {
namespace {

std::string base_of(int packets, int refused) {
  return R"({"packets": )" + std::to_string(packets) + R"(, "lost": 2, "refused": )" +
         std::to_string(refused) +
         R"(, "rate_hz": 50.1, "silent_ms": 1234, "age_ms": {"p50": 20, "p99": 45}, "more": [1]})";
}

class DemoReportTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(folder_);
    const std::string f = folder_->path();
    cars_ = {{.number = 1, .name = "own", .folder = f},
             {.number = 2, .name = "rival", .folder = f + "/rival"}};
    std::filesystem::create_directory(f + "/rival");
    leave("run.json", "{}");
    leave("base.json", base_of(900, 0));
    leave("rival/base.json", base_of(800, 0));
    leave("candump.log", "a\nb\nc\n");
  }
  void leave(const std::string& name, const std::string& text) {
    ASSERT_TRUE(transport::write_file(folder_->path() + "/" + name, text));
  }

  Result<transport::TemporaryFolder, Problem> folder_ = transport::TemporaryFolder::create("demo");
  std::vector<DemoCar> cars_;
};

TEST_F(DemoReportTest, IsWhatTheRunLeft) {
  const auto report = read_report(cars_);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_TRUE(report->are_heard());
  EXPECT_EQ(report->stations[0].base.packets, 900);
  EXPECT_EQ(report->dumped, 3u);
  const std::string text = to_text(*report), json = to_json(*report);
  EXPECT_NE(text.find("car 1 own: 900 packets, 50.1 Hz, 2 lost, 0 refused"), std::string::npos);
  EXPECT_NE(text.find("p99 45.0 ms; silent for the last 1.2 s"), std::string::npos) << text;
  EXPECT_NE(text.find("car 2 rival: 800 packets"), std::string::npos);
  EXPECT_EQ(json.find("{\"run\": {}, \"base\": {\"packets\""), 0u) << json;
  EXPECT_NE(json.find("\"others\": [{\"name\": \"rival\""), std::string::npos) << json;
}

TEST_F(DemoReportTest, ACarIsHeardUnderItsOwnKeysAlone) {
  leave("rival/base.json", base_of(0, 0));
  EXPECT_FALSE(read_report(cars_)->are_heard());
  leave("rival/base.json", base_of(800, 1));
  EXPECT_FALSE(read_report(cars_)->are_heard()) << "what was of the other car";
}

TEST_F(DemoReportTest, WhatIsMissingOrNoneIsTold) {
  leave("rival/base.json", R"({"packets": -1})");
  EXPECT_FALSE(read_report(cars_));
  cars_[1].folder += "/nowhere";
  EXPECT_FALSE(read_report(cars_));
}

TEST_F(DemoReportTest, TheNextStepsNameWhatThisDemoLeft) {
  const std::string text = next_steps(*read_report(std::span{cars_}.first(1)), "a.yaml");
  for (const std::string& step :
       {folder_->path() + "/report.html", folder_->path() + "/recording",
        std::string("./pitwall demo --cars 2"), std::string("pitwall-hil run a.yaml")})
    EXPECT_NE(text.find(step), std::string::npos) << text;
  EXPECT_EQ(next_steps(*read_report(cars_), "a.yaml").find("--cars 2"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::cli
