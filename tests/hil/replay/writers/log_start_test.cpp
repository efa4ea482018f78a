// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/writers/log_start.hpp"

#include <gtest/gtest.h>

namespace pitwall::replay {
namespace {

TEST(LogStart, IsTheMillisecondOfTheEarliestFrameWhereverItStands) {
  CanLog log;
  EXPECT_EQ(start_of(log).ns, 0);
  for (const std::int64_t ns : {5'000'000'001, 4'999'999'999, 6'000'000'000}) {
    LoggedFrame f;
    f.at.ns = ns;
    log.frames.push_back(f);
  }
  EXPECT_EQ(start_of(log).ns, 4'999'000'000);
}

}  // namespace
}  // namespace pitwall::replay
