// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/sweep/case_pages.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "protocol/transport/file.hpp"

namespace pitwall::cli {
namespace {

// Instead of a sweep a shell, whose runs leave a result with the digest "d" and their number.
class CasePagesMade : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(folder_); }

  PagesPlan plan(const std::string& before = "") const {
    return {.folder = folder_->path() + "/pages",
            .command = {"sh", "-c",
                        before + "echo run >> \"$4/../runs\"; echo page > \"$4/report.html\"; "
                                 "echo \"{\\\"sha256\\\": \\\"d$2\\\"}\" > \"$4/run.json\"",
                        "sh"},
            .processes = 2};
  }

  Result<CasePages, Problem> made(const std::vector<sweep::CaseResult>& results,
                                  const PagesPlan& plan) const {
    std::vector<const sweep::CaseResult*> cases;
    for (const sweep::CaseResult& of : results) cases.push_back(&of);
    return make_case_pages(cases, plan);
  }

  std::string runs() const {
    return transport::read_file(folder_->path() + "/pages/runs").value_or("");
  }

  Result<transport::TemporaryFolder, Problem> folder_ =
      transport::TemporaryFolder::create("pitwall-pages");
};

TEST_F(CasePagesMade, EachCaseThatRanHasAPageAndIsNotRunAThirdTime) {
  const std::vector<sweep::CaseResult> results{{.number = 3, .digest = "d3"},
                                               {.number = 7, .digest = "d7"},
                                               {.number = 8, .why = "refused"}};
  for (int time = 0; time < 2; ++time) {
    const auto pages = made(results, plan());
    ASSERT_TRUE(pages) << to_string(pages.error());
    EXPECT_EQ(*pages, (CasePages{{3, "pages/3/report.html"}, {7, "pages/7/report.html"}}));
    EXPECT_EQ(runs(), "run\nrun\n");
  }
  std::filesystem::remove(folder_->path() + "/pages/7/report.html");
  ASSERT_TRUE(made(results, plan()));
  EXPECT_EQ(runs(), "run\nrun\nrun\n") << "a page that is gone is made again";
}

TEST_F(CasePagesMade, AnotherEventLogIsRefused) {
  const auto pages = made({{.number = 3, .digest = "d4"}}, plan());
  ASSERT_FALSE(pages);
  EXPECT_NE(to_string(pages.error()).find("another run of case 3"), std::string::npos)
      << to_string(pages.error());
}

TEST_F(CasePagesMade, ARunWithoutAResultIsToldWithWhereItsWordsAre) {
  const auto pages = made({{.number = 3, .digest = "d3"}}, plan("echo broken; exit 2; "));
  ASSERT_FALSE(pages);
  EXPECT_NE(to_string(pages.error()).find("/pages/3/run.txt"), std::string::npos)
      << to_string(pages.error());
  EXPECT_EQ(transport::read_file(folder_->path() + "/pages/3/run.txt").value_or(""), "broken\n");
}

TEST_F(CasePagesMade, AFolderThatCannotBeMadeIsTold) {
  PagesPlan nowhere = plan();
  nowhere.folder = "/proc/none";
  const auto pages = made({{.number = 3, .digest = "d3"}}, nowhere);
  ASSERT_FALSE(pages);
  EXPECT_NE(to_string(pages.error()).find("/proc/none"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::cli
