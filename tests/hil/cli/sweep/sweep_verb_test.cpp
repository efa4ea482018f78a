// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/sweep/sweep_verb.hpp"

#include <gtest/gtest.h>

#include "tests/hil/cli/program_run.hpp"

namespace pitwall::cli {
namespace {

class SweepVerb : public ProgramRun {
 protected:
  // Four cases of two seconds; in two of them the car may not move from its place.
  void SetUp() override {
    ProgramRun::SetUp();
    std::string text = text_in_tree("hil/scenarios/launch.yaml");
    const std::size_t from = text.find("expect:");
    ASSERT_NE(from, std::string::npos);
    text = text.substr(0, from) +
           "expect:\n  - {kind: always, signal: speed_mps, is: \"<\", value: 1}\n";
    ASSERT_TRUE(transport::write_file(path("s.yaml"), text));
    write_plan("[1, -1]");
  }

  static std::string text_in_tree(const std::string& file) {
    return transport::read_file(std::string(PITWALL_SOURCE_DIR) + "/" + file).value_or("");
  }

  void write_plan(const std::string& limits) {
    const std::string text = "schema: 1\nname: small\nscenario: " + path("s.yaml") +
                             "\nseed: 1\ncombine: all\nparameters:\n"
                             "  - {path: duration_s, values: [2]}\n"
                             "  - {path: perturb.mass_kg, values: [0, 50]}\n"
                             "  - {path: \"expect[0].value\", values: " +
                             limits + "}\n";
    ASSERT_TRUE(transport::write_file(path("plan.yaml"), text));
  }

  ProgramOutput sweep(const std::string& folder, const std::string& processes) {
    return run({"sweep", path("plan.yaml"), "--out", path(folder), "--processes", processes});
  }
};

TEST_F(SweepVerb, WrongUsageIsToldBeforeAnythingIsMade) {
  expect_refusal({"sweep"}, "PLAN");
  expect_refusal({"sweep", path("none.yaml")}, "none.yaml");
  expect_refusal({"sweep", path("plan.yaml"), "--processes", "0"}, "--processes");
  expect_refusal({"sweep", path("plan.yaml"), "--report", path("r")}, "--case");
  expect_refusal({"sweep", path("plan.yaml"), "--case", "4"}, "4 cases");
  write_plan("[1, nan]");
  expect_refusal({"sweep", path("plan.yaml"), "--out", path("o")}, "expect[0].value");
  EXPECT_FALSE(exists("o"));
  write_plan("[1]");
  expect_refusal({"sweep", path("plan.yaml"), "--out", "/proc/none"}, "/proc/none");
}

TEST_F(SweepVerb, TheResultFileIsTheSameOnAnyNumberOfProcesses) {
  const ProgramOutput one = sweep("one", "1"), three = sweep("three", "3");
  EXPECT_EQ(one.code, 1) << one.err;
  EXPECT_NE(one.out.find("2 passed, 2 failed"), std::string::npos) << one.out;
  EXPECT_NE(one.out.find("4 of 4 cases, about 0 s left\n"), std::string::npos) << one.out;
  EXPECT_FALSE(text_of("one/results.sqlite").empty());
  EXPECT_TRUE(text_of("one/results.sqlite") == text_of("three/results.sqlite"));
  EXPECT_FALSE(text_of("one/report.html").empty());
  EXPECT_TRUE(text_of("one/report.html") == text_of("three/report.html"));
}

TEST_F(SweepVerb, TheWorstCasesHavePagesOfTheSameRun) {
  ASSERT_EQ(sweep("o", "1").code, 1);
  for (const char* number : {"2", "3"}) {
    const std::string page = std::string("pages/") + number + "/report.html";
    EXPECT_NE(text_of("o/report.html").find("<a href=\"" + page + "\">"), std::string::npos)
        << number;
    EXPECT_NE(text_of("o/" + page).find("VIOLATED"), std::string::npos) << number;
  }
  EXPECT_FALSE(exists("o/pages/0")) << "it passed";
}

TEST_F(SweepVerb, AFinishedSweepMakesItsPageAgainAndRunsNothing) {
  ASSERT_EQ(sweep("o", "1").code, 1);
  const std::string page = text_of("o/report.html");
  const auto made = std::filesystem::last_write_time(path("o/pages/2/events.mcap"));
  std::filesystem::remove(path("o/report.html"));
  const ProgramOutput again = sweep("o", "1");
  EXPECT_NE(again.out.find("4 of 4 cases were done before"), std::string::npos) << again.out;
  EXPECT_TRUE(text_of("o/report.html") == page);
  EXPECT_NE(text_of("o/summary.json").find("\"cases\": 4, \"passed\": 2, \"failed\": 2"),
            std::string::npos);
  EXPECT_EQ(std::filesystem::last_write_time(path("o/pages/2/events.mcap")), made);
}

TEST_F(SweepVerb, ThereAreAsManyPagesAsAreAskedFor) {
  const std::vector<std::string> words{"sweep", path("plan.yaml"), "--out", path("o"), "--pages"};
  const auto with = [&words](const char* count) {
    std::vector<std::string> all = words;
    all.emplace_back(count);
    return all;
  };
  EXPECT_EQ(run(with("0")).code, 1);
  EXPECT_FALSE(exists("o/pages"));
  EXPECT_EQ(text_of("o/report.html").find("<a href"), std::string::npos);
  const ProgramOutput one = run(with("1"));
  EXPECT_LT(one.out.find("case 3 failed"), one.out.find("case 2 failed")) << one.out;
  EXPECT_TRUE(exists("o/pages/3/report.html"));
  EXPECT_FALSE(exists("o/pages/2"));
  expect_refusal(with("1001"), "--pages");
}

TEST_F(SweepVerb, ACaseOfAnotherBuildHasNoPage) {
  ASSERT_EQ(run({"sweep", path("plan.yaml"), "--out", path("o"), "--pages", "0"}).code, 1);
  for (const auto& entry : std::filesystem::directory_iterator(path("o/cases"))) {
    std::string text = transport::read_file(entry.path()).value_or("");
    const std::size_t at = text.find("\"digest\": \"");
    ASSERT_NE(at, std::string::npos) << text;
    text[at + 11] = text[at + 11] == '0' ? '1' : '0';
    ASSERT_TRUE(transport::write_file(entry.path(), text));
  }
  const ProgramOutput other = sweep("o", "1");
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("another run of case 2"), std::string::npos) << other.err;
}

TEST_F(SweepVerb, WhatIsDoneIsNotRunAgain) {
  ASSERT_EQ(sweep("o", "1").code, 1);
  const std::string whole = text_of("o/results.sqlite");
  std::string first;
  for (const auto& entry : std::filesystem::directory_iterator(path("o/cases"))) {
    const std::string file = entry.path().filename();
    if (first.empty()) first = file;
  }
  std::filesystem::remove(path("o/cases/" + first));  // as if this one had been interrupted
  const ProgramOutput again = sweep("o", "2");
  EXPECT_NE(again.out.find("3 of 4 cases were done before"), std::string::npos) << again.out;
  EXPECT_TRUE(text_of("o/results.sqlite") == whole);
}

TEST_F(SweepVerb, AnotherPlanInTheFolderIsRefused) {
  ASSERT_EQ(sweep("o", "1").code, 1);
  write_plan("[1, 2]");
  const ProgramOutput other = sweep("o", "1");
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("another one"), std::string::npos) << other.err;
}

TEST_F(SweepVerb, ABaselineHasOnlyToBeReachedAgain) {
  ASSERT_EQ(sweep("before", "1").code, 1) << "two cases fail";
  const std::vector<std::string> words{"sweep",     path("plan.yaml"), "--out",
                                       path("now"), "--baseline",      path("before")};
  const ProgramOutput now = run(words);
  EXPECT_EQ(now.code, 0) << now.err;
  EXPECT_NE(now.out.find("4 cases, 4 of them the same run"), std::string::npos) << now.out;
  // A case of the baseline that passed where it does not now.
  for (const auto& entry : std::filesystem::directory_iterator(path("before/cases"))) {
    std::string text = transport::read_file(entry.path()).value_or("");
    const std::size_t at = text.find("\"failed\"");
    if (at == std::string::npos) continue;
    ASSERT_TRUE(transport::write_file(entry.path(), text.replace(at, 8, "\"passed\"")));
  }
  const ProgramOutput worse = run(words);
  EXPECT_EQ(worse.code, 1);
  EXPECT_NE(worse.out.find("2 passed before and do not now"), std::string::npos) << worse.out;
  EXPECT_NE(text_of("now/report.html").find("Passed before and do not now: 2"), std::string::npos);
  expect_refusal({"sweep", path("plan.yaml"), "--baseline", path("none")}, "no folder of a sweep");
}

TEST_F(SweepVerb, OneCaseIsRunAsAScenarioIs) {
  const ProgramOutput output = run({"sweep", path("plan.yaml"), "--case", "3"});
  EXPECT_EQ(output.code, 1) << output.err;
  EXPECT_NE(output.out.find("perturb.mass_kg = 50"), std::string::npos) << output.out;
  EXPECT_NE(output.out.find("verdict: FAIL"), std::string::npos) << output.out;
}

}  // namespace
}  // namespace pitwall::cli
