// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/bench_server/sweep_list.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "protocol/json/json_value.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::bench_server {
namespace {

const std::string kSummary =
    R"({"name": "grip", "scenario": "s.yaml", "cases": 9, "passed": 5, "failed": 1,)"
    R"( "contact": 2, "refused": 1, "crashed": 0})";

class SweepList : public ::testing::Test {
 protected:
  void add(const std::string& name, const std::string& summary) const {
    std::filesystem::create_directories(folder_.path() + "/" + name);
    ASSERT_TRUE(transport::write_file(folder_.path() + "/" + name + "/summary.json", summary));
  }
  std::vector<json::JsonValue> rows() const {
    const auto line =
        json::JsonValue::parse(sweeps_line({.runs = {}, .sweeps = folder_.path()}), "line");
    EXPECT_TRUE(line && line->text("type") == "sweeps");
    std::vector<json::JsonValue> rows;
    if (line)
      for (const json::JsonValue& row : line->items("sweeps")) rows.push_back(row);
    return rows;
  }

  transport::TemporaryFolder folder_ = *transport::TemporaryFolder::create("sweeps");
};

TEST_F(SweepList, ARowHasTheCountsAndThePage) {
  add("b", kSummary);
  add("a", R"({"name": "wind", "scenario": "", "cases": 1, "passed": 1, "failed": 0,)"
           R"( "contact": 0, "refused": 0, "crashed": 0})");
  const auto found = rows();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].text("name"), "wind") << "by the name of the folder";
  EXPECT_EQ(found[1].number("cases"), 9.0);
  EXPECT_EQ(found[1].number("contact"), 2.0);
  EXPECT_EQ(found[1].text("report"), folder_.path() + "/b/report.html");
}

TEST_F(SweepList, APageIsNamedWhereAClientCanAskForIt) {
  add("grip", kSummary);
  add("grip and wind", kSummary);
  EXPECT_TRUE(rows()[0].find("page")->is_null()) << "there is none";
  for (const std::string name : {"grip", "grip and wind"})
    ASSERT_TRUE(transport::write_file(folder_.path() + "/" + name + "/report.html", "<p>"));
  EXPECT_EQ(rows()[0].text("page"), "sweeps/grip/report.html");
  EXPECT_TRUE(rows()[1].find("page")->is_null()) << "its name has other characters";
}

TEST_F(SweepList, WhatIsNoSummaryIsLeftOut) {
  add("cut", kSummary.substr(0, 40));
  add("nameless", R"({"cases": 1})");
  add("countless", R"({"name": "x", "cases": 1, "passed": "one"})");
  add("long", kSummary + std::string(kMaxSummaryBytes, ' '));
  std::filesystem::create_directories(folder_.path() + "/still_running");
  EXPECT_TRUE(rows().empty());
  add("good", kSummary);
  EXPECT_EQ(rows().size(), 1U);
}

TEST_F(SweepList, ThereAreNoMoreThanFitIntoALine) {
  for (std::size_t i = 0; i < kMaxSweeps + 5; ++i) add("s" + std::to_string(i), kSummary);
  EXPECT_EQ(rows().size(), kMaxSweeps);
}

TEST_F(SweepList, AFolderThatIsNotThereHasNone) {
  EXPECT_EQ(sweeps_line({.runs = {}, .sweeps = folder_.path() + "/none"}),
            R"({"type": "sweeps", "sweeps": []})");
}

}  // namespace
}  // namespace pitwall::bench_server
