// Processes that a shell plays: they write the lines of their cases, or end before.
// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/local_engine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include "protocol/transport/file.hpp"

namespace pitwall::sweep {
namespace {

class LocalEngineTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kAll = 50;

  void SetUp() override {
    ASSERT_TRUE(temporary_);
    auto opened = SweepFolder::open(temporary_->path(), "plan", "scenario");
    ASSERT_TRUE(opened);
    folder_ = *opened;
  }

  // A process that writes its results until it meets `dies_at`; then it ends, `times` times.
  LocalEngine engine(unsigned processes, std::size_t dies_at = kAll, int times = 0) {
    LocalEngine out;
    out.processes = processes;
    out.start = [this, dies_at, times](const CaseNumbers& cases, const std::string& name) {
      ++started_;
      most_cases_ = std::max(most_cases_, cases.size());
      std::string script;
      for (const std::size_t number : cases) {
        if (number == dies_at && deaths_ < times) {
          ++deaths_;
          script += "kill -9 $$\n";
        }
        script += "echo '" + to_line({.number = number, .verdict = CaseVerdict::kPassed}) +
                  "' >> " + folder_->path() + "/cases/" + name + ".jsonl\n";
      }
      return transport::Process::spawn({.argv = {"sh", "-c", script}});
    };
    out.progress = [this](std::size_t done) { progress_.push_back(done); };
    return out;
  }

  std::vector<CaseResult> run(const CaseNumbers& cases, const LocalEngine& engine) {
    const auto ran = run_here(cases, kAll, *folder_, engine);
    EXPECT_TRUE(ran) << (ran ? "" : to_string(ran.error()));
    return *folder_->read(kAll);
  }

  const SweepFolder& folder() const { return *folder_; }

  static CaseNumbers all() {
    CaseNumbers numbers(kAll);
    std::iota(numbers.begin(), numbers.end(), 0U);
    return numbers;
  }

  std::size_t started_ = 0, most_cases_ = 0;
  std::vector<std::size_t> progress_;

 private:
  Result<transport::TemporaryFolder, Problem> temporary_ =
      transport::TemporaryFolder::create("pitwall-engine");
  std::optional<SweepFolder> folder_;
  int deaths_ = 0;
};

TEST_F(LocalEngineTest, EveryCaseRunsOnceOnAnyNumberOfProcesses) {
  for (const unsigned processes : {1U, 3U}) {
    const auto results = run(all(), engine(processes));
    EXPECT_EQ(missing_cases(results, kAll).size(), 0U);
  }
  EXPECT_LE(most_cases_, 20U);
  EXPECT_TRUE(std::ranges::is_sorted(std::vector(progress_.begin(), progress_.begin() + 4)));
  EXPECT_EQ(progress_.back(), kAll);
}

TEST_F(LocalEngineTest, OnlyWhatIsAskedForRuns) {
  const auto results = run({3, 17, 40}, engine(2));
  ASSERT_EQ(results.size(), 3U);
  EXPECT_EQ(results[1].number, 17U);
}

TEST_F(LocalEngineTest, ACaseThatEndsItsProcessTwiceHasCrashedAndTheOthersRun) {
  const auto results = run(all(), engine(2, 13, 2));
  ASSERT_EQ(results.size(), kAll);
  for (const CaseResult& result : results)
    EXPECT_EQ(result.verdict == CaseVerdict::kCrashed, result.number == 13) << result.number;
}

TEST_F(LocalEngineTest, AProcessThatIsKilledOnceCostsNothing) {
  for (const CaseResult& result : run(all(), engine(2, 13, 1)))
    EXPECT_EQ(result.verdict, CaseVerdict::kPassed) << result.number;
}

TEST_F(LocalEngineTest, AProgramThatIsNotThereIsTold) {
  LocalEngine broken = engine(1);
  broken.start = [](const CaseNumbers&, const std::string&) {
    return transport::Process::spawn({.argv = {"/no/such/program"}});
  };
  const auto ran = run_here({1}, kAll, folder(), broken);
  ASSERT_FALSE(ran);
  EXPECT_NE(to_string(ran.error()).find("/no/such/program"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::sweep
