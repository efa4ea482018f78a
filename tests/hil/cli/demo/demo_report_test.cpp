// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/demo/demo_report.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "protocol/transport/file.hpp"

namespace pitwall::cli {
namespace {

constexpr const char* kBase =
    R"({"packets": 900, "lost": 2, "refused": 0, "rate_hz": 50.1, "age_ms": {"p50": 20, "p99": 45},
        "more": [1]})";

class DemoReport : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(folder_);
    car_ = {.number = 8, .folder = folder_->path()};
    leave("run.json", "{}");
    leave("base.json", kBase);
    leave("candump.log", "a\nb\nc\n");
  }
  void leave(const std::string& name, const std::string& text) {
    ASSERT_TRUE(transport::write_file(folder_->path() + "/" + name, text));
  }

  Result<transport::TemporaryFolder, Problem> folder_ = transport::TemporaryFolder::create("demo");
  DemoCar car_;
};

TEST_F(DemoReport, IsWhatTheRunLeft) {
  const auto report = read_report(car_, 0);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_TRUE(report->held());
  EXPECT_EQ(report->base.packets, 900);
  EXPECT_EQ(report->dumped, 3u);
  EXPECT_NE(to_text(*report).find("900 packets, 50.1 Hz, 2 lost, 0 refused"), std::string::npos);
  EXPECT_EQ(to_json(*report).find("{\"run\": {}, \"base\": {\"packets\""), 0u);
}

TEST_F(DemoReport, ACarThatWasNotHeardOrFailedDidNotHold) {
  EXPECT_FALSE(read_report(car_, 1)->held());
  leave("candump.log", "");
  EXPECT_FALSE(read_report(car_, 0)->held());
  car_.bus = DemoBus::kSocket;
  EXPECT_TRUE(read_report(car_, 0)->held()) << "candump hears SocketCAN only";
  EXPECT_EQ(to_text(*read_report(car_, 0)).find("candump"), std::string::npos);
  leave("candump.log", "a\n");
  leave("base.json", R"({"packets": 0, "lost": 0, "refused": 0, "rate_hz": 0})");
  EXPECT_FALSE(read_report(car_, 0)->held());
}

TEST_F(DemoReport, WhatIsMissingOrNoneIsTold) {
  leave("base.json", R"({"packets": -1})");
  EXPECT_FALSE(read_report(car_, 0));
  car_.folder += "/nowhere";
  EXPECT_FALSE(read_report(car_, 0));
}

TEST_F(DemoReport, CarsAreApartWhereNoneHeardWhatWasNotItsOwn) {
  std::vector<CarReport> reports{*read_report(car_, 0), *read_report(car_, 0)};
  EXPECT_TRUE(are_apart(reports));
  EXPECT_EQ(apart_text(reports).find("apart: car 8 900 packets"), 0u) << apart_text(reports);
  reports[1].base.refused = 1;
  EXPECT_FALSE(are_apart(reports));
  EXPECT_EQ(apart_text(reports).find("NOT apart"), 0u);
  reports[1].base = {};
  EXPECT_FALSE(are_apart(reports));
}

}  // namespace
}  // namespace pitwall::cli
