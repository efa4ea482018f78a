// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/replay/reading_speed.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/file.hpp"
#include "tests/benchmarks/replay/sample_log.hpp"

namespace pitwall::benchmarks {
namespace {

TEST(ReadingSpeed, BothReadTheWholeLogAndOursAtLeastTenTimesAsFast) {
  const auto folder = transport::TemporaryFolder::create("pitwall-reading-");
  ASSERT_TRUE(folder);
  const auto speeds = measure_reading(replay::sample_log(seconds(2)), folder->path());
  ASSERT_TRUE(speeds) << to_string(speeds.error());
  for (const ReadingSpeed& speed : *speeds) {
    std::printf("%s: ours %.0f frames/s, python-can %.0f\n", speed.format.c_str(), speed.ours_per_s,
                speed.python_per_s);
    EXPECT_GT(speed.ours_per_s, kLeastReadingTimes * speed.python_per_s) << speed.format;
  }
}

TEST(ReadingSpeed, AFolderThatIsNotThereIsNamed) {
  const auto speeds = measure_reading(replay::sample_log(milliseconds(100)), "/nowhere");
  ASSERT_FALSE(speeds.has_value());
  EXPECT_NE(speeds.error().place.find("/nowhere"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::benchmarks
