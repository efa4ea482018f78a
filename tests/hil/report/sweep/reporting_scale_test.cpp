// What it takes to report the results of a sweep grows with their number and no faster.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <malloc.h>

#include <cstdio>
#include <string>
#include <vector>

#include "hil/report/sweep/sweep_page.hpp"
#include "hil/sweep/baseline.hpp"
#include "hil/sweep/results_file.hpp"
#include "hil/sweep/summary.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/random.hpp"
#include "tests/hil/sweep/plan_text.hpp"

namespace pitwall::report {
namespace {

using namespace sweep;

constexpr double kRatioMost = 12.0;  // of ten times as many
constexpr std::size_t kPageMost = 1'000'000;

std::vector<CaseResult> synthetic(std::size_t count) {
  Random random{count};
  std::vector<CaseResult> results;
  for (std::size_t i = 0; i < count; ++i) {
    CaseResult result{.number = i, .verdict = CaseVerdict::kPassed, .digest = std::string(64, 'a')};
    for (const char* text :
         {"always wall_gap_m > 0.5", "never mode >= 3", "within 5 s speed > 3"}) {
      const double margin = random.between(-0.1, 5.0);
      result.margins.push_back({text, margin, margin >= 0.0});
      if (margin < 0.0) result.verdict = CaseVerdict::kFailed;
    }
    results.push_back(std::move(result));
  }
  return results;
}

struct Cost {
  double seconds = 0.0, megabytes = 0.0;
};

// Of lines read, file written, table, comparison and page made.
Cost cost_of(std::size_t count, const std::string& file) {
  const Cases cases{
      *read_plan(spoilt(drawn_plan(), "cases: 40", "cases: " + std::to_string(count)), "p.yaml")};
  std::vector<std::string> lines;
  for (const CaseResult& result : synthetic(count)) lines.push_back(to_line(result));
  const std::size_t held_before = ::mallinfo2().uordblks;
  const Duration before = transport::thread_time();
  std::vector<CaseResult> results;
  for (const std::string& line : lines) results.push_back(*parse_case_result(line));
  EXPECT_TRUE(write_results(file, cases, "plan", results));
  EXPECT_FALSE(summary_of(cases, results, "again").empty());
  const Difference same = difference(results, results);
  EXPECT_EQ(same.compared, count);
  const SweepRun run{
      .cases = cases, .results = results, .command = "again", .baseline = Baseline{results, same}};
  const std::size_t page_size = sweep_page(run).size();
  EXPECT_GT(page_size, 20'000U);
  EXPECT_LT(page_size, kPageMost) << count;
  const Duration took = transport::thread_time() - before;
  return {took.seconds(), static_cast<double>(::mallinfo2().uordblks - held_before) / 1'048'576.0};
}

TEST(ReportingScale, TimeAndMemoryAreLinearInTheNumberOfResults) {
  const auto folder = transport::TemporaryFolder::create("pitwall-scale");
  ASSERT_TRUE(folder);
  Cost last;
  for (const std::size_t count : {1'000U, 10'000U, 100'000U}) {
    const Cost cost = cost_of(count, folder->path() + "/r.sqlite");
    std::printf("%zu results: %.3f s, %.1f MB held\n", count, cost.seconds, cost.megabytes);
    if (last.seconds > 0.0) {
      EXPECT_LT(cost.seconds, kRatioMost * last.seconds) << count;
      EXPECT_LT(cost.megabytes, kRatioMost * last.megabytes) << count;
    }
    last = cost;
  }
}

}  // namespace
}  // namespace pitwall::report
