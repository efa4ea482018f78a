// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/sweep_folder.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/file.hpp"

namespace pitwall::sweep {
namespace {

class SweepFolderTest : public ::testing::Test {
 protected:
  SweepFolder folder() const {
    auto opened = SweepFolder::open(path(), "plan", "scenario");
    EXPECT_TRUE(opened) << (opened ? "" : to_string(opened.error()));
    return *opened;
  }
  std::string path() const { return temporary_->path() + "/a/b"; }

 private:
  Result<transport::TemporaryFolder, Problem> temporary_ =
      transport::TemporaryFolder::create("pitwall-sweep");
};

CaseResult result_of(std::size_t number, CaseVerdict verdict = CaseVerdict::kPassed) {
  return {.number = number, .verdict = verdict};
}

TEST_F(SweepFolderTest, KeepsTheResultsOfEveryProcess) {
  ASSERT_TRUE(folder().append("one", result_of(4)));
  ASSERT_TRUE(folder().append("two", result_of(1)));
  ASSERT_TRUE(folder().append("one", result_of(2)));
  const auto results = folder().read(10);
  ASSERT_TRUE(results);
  ASSERT_EQ(results->size(), 3U);
  EXPECT_EQ((*results)[0].number, 1U);
  EXPECT_EQ((*results)[2].number, 4U);
  EXPECT_EQ(missing_cases(*results, 6), (std::vector<std::size_t>{0, 3, 5}));
  EXPECT_EQ(folder().read_of("one", 10)->size(), 2U);
  EXPECT_TRUE(folder().read_of("three", 10)->empty());
  EXPECT_EQ(folder().read(3)->size(), 2U) << "those beyond the sweep are left out";
}

TEST_F(SweepFolderTest, AnotherSweepIsRefused) {
  ASSERT_TRUE(folder().append("one", result_of(4)));
  for (const auto& [plan, scenario] :
       {std::pair{"other", "scenario"}, std::pair{"plan", "other"}}) {
    const auto opened = SweepFolder::open(path(), plan, scenario);
    ASSERT_FALSE(opened);
    EXPECT_NE(to_string(opened.error()).find("another one"), std::string::npos);
  }
  EXPECT_FALSE(SweepFolder::open("/proc/none", "plan", "scenario"));
}

TEST_F(SweepFolderTest, ResultsOfAnotherSchemaAreRefused) {
  const std::string file = folder().results_file();
  ASSERT_TRUE(transport::write_file(file, std::string(5000, 'x')));
  const auto opened = SweepFolder::open(path(), "plan", "scenario");
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().place, file);
}

TEST_F(SweepFolderTest, ALineThatAProcessDidNotFinishIsLeftOut) {
  ASSERT_TRUE(folder().append("one", result_of(4)));
  auto writer = transport::AppendWriter::open(path() + "/cases/one.jsonl");
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->write(std::string_view{"{\"case\": 5, \"verdict\": \"pas"}));
  EXPECT_EQ(folder().read(10)->size(), 1U);
}

TEST_F(SweepFolderTest, ACaseThatCrashedAndThenEndedHasEnded) {
  ASSERT_TRUE(folder().append("crashed", result_of(4, CaseVerdict::kCrashed)));
  ASSERT_TRUE(folder().append("one", result_of(4, CaseVerdict::kFailed)));
  const auto results = folder().read(10);
  ASSERT_EQ(results->size(), 1U);
  EXPECT_EQ(results->front().verdict, CaseVerdict::kFailed);
}

}  // namespace
}  // namespace pitwall::sweep
