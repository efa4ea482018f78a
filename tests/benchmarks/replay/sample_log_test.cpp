// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/replay/sample_log.hpp"

#include <gtest/gtest.h>

#include <map>

#include "hil/replay/formats/candump.hpp"
#include "hil/replay/writers/candump_writer.hpp"
#include "protocol/can/av21.hpp"

namespace pitwall::replay {
namespace {

TEST(SampleLog, IsTheSameEveryTimeAndAFileGivesItBack) {
  const CanLog log = sample_log(seconds(2));
  EXPECT_EQ(log.frames, sample_log(seconds(2)).frames);
  const auto read = read_candump(to_candump(log), "f");
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->frames, log.frames);
  EXPECT_EQ(read->counters.backward_stamps, 0U);
}

TEST(SampleLog, HasTheTrafficOfTheDatabase) {
  const CanLog log = sample_log(seconds(4));
  std::map<std::uint32_t, std::int64_t> count;
  for (const LoggedFrame& logged : log.frames) ++count[logged.frame.id];
  for (const can::MessageRow& row : can::av21::kMessages)
    EXPECT_NEAR(static_cast<double>(count[row.id]), 4.0 / row.period.seconds(), 1.0) << row.name;
  const double rate_hz = static_cast<double>(log.frames.size()) / 4.0;
  EXPECT_GT(rate_hz, 2'400.0);
  EXPECT_LT(rate_hz, 2'700.0);
}

TEST(SampleLog, ComesFromOneWire) {
  const CanLog log = sample_log(seconds(2));
  std::size_t back_to_back = 0;
  for (std::size_t i = 1; i < log.frames.size(); ++i) {
    const std::int64_t gap_us = (log.frames[i].at.ns - log.frames[i - 1].at.ns) / 1'000;
    // The shortest frame of 1 Mbit/s takes 47 us; a stamp is up to 12 us later than its frame.
    ASSERT_GE(gap_us, 47 - 12) << i;
    back_to_back += gap_us < 160;
  }
  EXPECT_GT(back_to_back, log.frames.size() / 3);
}

}  // namespace
}  // namespace pitwall::replay
