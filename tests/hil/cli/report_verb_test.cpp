// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/report_verb.hpp"

#include <gtest/gtest.h>

#include "tests/hil/cli/program_run.hpp"

namespace pitwall::cli {
namespace {

const std::string kShortFault = "tests/system/report/short_fault.yaml";

class ReportVerb : public ProgramRun {
 protected:
  std::string folder() const { return path("report"); }
  bool whole() const {
    return exists("report/events.mcap") && exists("report/run.json") &&
           exists("report/report.html") && exists("report/junit.xml");
  }
  bool page_says(const std::string& word) const {
    return text_of("report/report.html").find("<strong>" + word) != std::string::npos;
  }
};

TEST_F(ReportVerb, WrongUsageIsTold) {
  expect_refusal({"report"}, "log");
  expect_refusal({"report", "a.mcap"}, "--out");
  expect_refusal({"report", "a.mcap", "--out", path("x.html"), "--format", "pdf"}, "--format");
  expect_refusal({"run", kShortFault, "--report", path("r"), "--log", path("l")}, "--log");
}

TEST_F(ReportVerb, ARunThatPassesLeavesItsFilesAndAgainTheSamePage) {
  EXPECT_EQ(run({"run", kShortFault, "--report", folder()}).code, 0);
  ASSERT_TRUE(whole());
  EXPECT_TRUE(page_says("PASS"));
  const ProgramOutput again =
      run({"report", folder() + "/events.mcap", "--result", folder() + "/run.json", "--out",
           path("again.html"), "--junit", path("again.xml")});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(text_of("again.html"), text_of("report/report.html"));
  EXPECT_EQ(text_of("again.xml"), text_of("report/junit.xml"));
}

TEST_F(ReportVerb, AFailedExpectationIsOne) {
  const std::string text = transport::read_file(PITWALL_SOURCE_DIR "/" + kShortFault).value_or("");
  std::string spoilt_text = text;
  spoilt_text.replace(text.find("value: 200"), 10, "value: 1  ");
  ASSERT_TRUE(transport::write_file(path("fails.yaml"), spoilt_text));
  EXPECT_EQ(run({"run", path("fails.yaml"), "--report", folder()}).code, 1);
  ASSERT_TRUE(whole());
  EXPECT_TRUE(page_says("FAIL"));
  EXPECT_NE(text_of("report/junit.xml").find("<failure "), std::string::npos);
}

TEST_F(ReportVerb, WhatTheBenchCannotDoIsTwoAndAnErrorInTheReport) {
  EXPECT_EQ(run({"run", path("no_such.yaml"), "--report", folder()}).code, 2);
  EXPECT_TRUE(page_says("INFRASTRUCTURE"));
  EXPECT_NE(text_of("report/junit.xml").find("<error "), std::string::npos);
  EXPECT_EQ(text_of("report/junit.xml").find("<failure "), std::string::npos);
}

TEST_F(ReportVerb, AMissingOrDamagedLogIsTwoAndSaidInBothFiles) {
  ASSERT_TRUE(transport::write_file(path("damaged.mcap"), "\x89MCAP0\r\nno records"));
  for (const char* log : {"missing.mcap", "damaged.mcap"}) {
    const ProgramOutput output =
        run({"report", path(log), "--out", path("x.html"), "--junit", path("x.xml")});
    EXPECT_EQ(output.code, 2) << log;
    EXPECT_NE(output.err, "") << log;
    EXPECT_NE(text_of("x.html").find("<strong>INFRASTRUCTURE"), std::string::npos) << log;
    EXPECT_NE(text_of("x.xml").find("<error "), std::string::npos) << log;
  }
}

TEST_F(ReportVerb, WhatCannotBeWrittenIsTwo) {
  ASSERT_TRUE(transport::write_file(path("file"), "no folder"));
  const std::string below = path("file") + "/report";
  expect_refusal({"run", kShortFault, "--report", below}, below);
  EXPECT_EQ(run({"report", path("none.mcap"), "--out", below + "/x.html"}).code, 2);
  EXPECT_EQ(
      run({"report", path("none.mcap"), "--out", path("x.html"), "--track", "none.yaml"}).code, 2);
}

TEST_F(ReportVerb, AReportOfAnotherRunDoesNotSurvive) {
  std::filesystem::create_directories(folder());
  ASSERT_TRUE(transport::write_file(folder() + "/events.mcap", "old"));
  ASSERT_TRUE(transport::write_file(folder() + "/run.json", "old"));
  EXPECT_EQ(run({"run", path("no_such.yaml"), "--report", folder()}).code, 2);
  EXPECT_FALSE(exists("report/events.mcap"));
  EXPECT_FALSE(exists("report/run.json"));
}

}  // namespace
}  // namespace pitwall::cli
