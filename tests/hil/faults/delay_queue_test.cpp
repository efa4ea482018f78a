// SPDX-License-Identifier: Apache-2.0
#include "hil/faults/delay_queue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace pitwall::faults {
namespace {

TimedFrame frame_at(std::int64_t us, std::uint32_t id) {
  TimedFrame t;
  t.frame.id = id;
  t.at = Instant{} + microseconds(us);
  return t;
}

TEST(DelayQueue, PopsByInstantThenByOrderOfPush) {
  DelayQueue queue;
  Random random{3};
  struct Key {
    std::int64_t at_ns;
    std::uint32_t id;
  };
  std::vector<Key> expected;
  for (std::uint32_t id = 0; id < 500; ++id) {
    const TimedFrame t = frame_at(static_cast<std::int64_t>(random.below(50)), id);
    ASSERT_TRUE(queue.push(t));
    expected.push_back({t.at.ns, id});
  }
  std::stable_sort(expected.begin(), expected.end(),
                   [](const Key& a, const Key& b) { return a.at_ns < b.at_ns; });
  std::size_t i = 0;
  for (Instant now{}; now <= Instant{} + microseconds(60); now += microseconds(7))
    while (const auto due = queue.pop(now)) {
      ASSERT_LE(due->at, now);
      ASSERT_LT(i, expected.size());
      ASSERT_EQ(due->frame.id, expected[i++].id);
    }
  EXPECT_EQ(i, expected.size());
  EXPECT_EQ(queue.size(), 0U);
}

TEST(DelayQueue, NothingLeavesBeforeItsInstant) {
  DelayQueue queue;
  ASSERT_TRUE(queue.push(frame_at(100, 1)));
  EXPECT_FALSE(queue.pop(Instant{} + nanoseconds(99'999)).has_value());
  EXPECT_TRUE(queue.pop(Instant{} + microseconds(100)).has_value());
}

TEST(DelayQueue, IsFullAtItsBound) {
  DelayQueue queue;
  for (std::size_t i = 0; i < kMaxDelayed; ++i) ASSERT_TRUE(queue.push(frame_at(1, 1)));
  EXPECT_FALSE(queue.push(frame_at(1, 1)));
}

}  // namespace
}  // namespace pitwall::faults
