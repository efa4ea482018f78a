// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/run_filter.hpp"

#include <gtest/gtest.h>

namespace pitwall::telemetry {
namespace {

using Verdict = RunFilter::Verdict;

TEST(RunFilter, TheFirstBeginsWhateverItsNumber) {
  for (const std::uint32_t run : {0U, 1U, 0x7FFF'FFFFU, 0x8000'0000U, 0xFFFF'FFFFU}) {
    RunFilter runs;
    EXPECT_EQ(runs.judge(run, {}), Verdict::kBegun) << run;
    EXPECT_EQ(runs.judge(run, {}), Verdict::kSame) << run;
  }
}

TEST(RunFilter, NewerIsAheadOnTheCircle) {
  RunFilter runs;
  (void)runs.judge(0xFFFF'FFFEU, {});
  runs.accepted({});
  EXPECT_EQ(runs.judge(2, {}), Verdict::kBegun) << "past the wrap";
  EXPECT_EQ(runs.judge(0xFFFF'FFFEU, {}), Verdict::kOther);
}

TEST(RunNumber, TwoStartsNeverShareOne) {
  const Duration now = seconds(1'800'000'000);
  EXPECT_NE(run_number(now), run_number(now + milliseconds(20)));
  for (std::int64_t day = 1; day <= 365; ++day) {
    RunFilter runs;
    (void)runs.judge(run_number(now), {});
    runs.accepted({});
    EXPECT_EQ(runs.judge(run_number(now + seconds(86'400 * day)), {}), Verdict::kBegun) << day;
  }
}

}  // namespace
}  // namespace pitwall::telemetry
