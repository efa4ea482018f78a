// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/ingress/frame_queue.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace pitwall::io {
namespace {

world::DetectionFrame frame_of(std::int64_t n) {
  world::DetectionFrame frame;
  frame.at = frame.received = Instant{n};
  for (std::size_t i = 0; i < world::kDetectionsMax; ++i)
    EXPECT_TRUE(frame.detections.push({.x_m = static_cast<double>(n)}));
  return frame;
}

// Every frame that was accepted comes out once, in order and whole.
TEST(FrameQueue, BetweenTwoThreadsNothingIsLostTwiceOrTorn) {
  constexpr std::int64_t kLast = 20'000;
  FrameQueue queue;
  std::thread writer{[&] {
    for (std::int64_t n = 1; n <= kLast;) n += queue.push(frame_of(n)) ? 1 : 0;
  }};
  for (std::int64_t n = 1; n <= kLast;) {
    const world::DetectionFrame* const frame = queue.front();
    if (frame == nullptr) continue;
    ASSERT_EQ(frame->at.ns, n);
    ASSERT_EQ(frame->detections.size(), world::kDetectionsMax);
    for (const world::Detection& d : frame->detections) ASSERT_EQ(d.x_m, static_cast<double>(n));
    queue.pop();
    ++n;
  }
  writer.join();
  EXPECT_EQ(queue.front(), nullptr);
}

}  // namespace
}  // namespace pitwall::io
