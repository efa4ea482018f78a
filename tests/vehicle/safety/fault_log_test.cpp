// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/fault_log.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace pitwall::safety {
namespace {

TEST(FaultLog, TheRingKeepsTheNewestInOrderAndCountsAll) {
  FaultLog log;
  std::vector<FaultEntry> shadow;
  EXPECT_EQ(log.size(), 0u);
  for (int i = 0; i < 300; ++i) {
    const FaultEntry entry{Instant{} + milliseconds(i),
                           static_cast<Cause>(1 + static_cast<std::size_t>(i) % (kCauses - 1)),
                           static_cast<double>(i)};
    log.record(entry, i >= 10);
    shadow.push_back(entry);
    ASSERT_EQ(log.total, shadow.size());
    ASSERT_EQ(log.size(), std::min(shadow.size(), kFaultEntries));
    for (std::size_t k = 0; k < log.size(); ++k)
      ASSERT_EQ(log.entry(k).value, shadow[shadow.size() - log.size() + k].value);
    ASSERT_EQ(log.first.value == 10.0, i >= 10) << "the first that stopped the car stays";
  }
  log.clear_first();
  EXPECT_EQ(log.first.cause, Cause::kNone);
  EXPECT_EQ(log.total, 300u);
}

}  // namespace
}  // namespace pitwall::safety
