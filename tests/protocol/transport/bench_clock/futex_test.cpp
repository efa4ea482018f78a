// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/bench_clock/futex.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "protocol/transport/bench_clock/wall_clock.hpp"

namespace pitwall::transport {
namespace {

TEST(Futex, AThreadSleepsUntilItIsWokenOrTheSpanIsOver) {
  std::atomic<std::uint32_t> word = 1;
  const Instant from = wall_now();
  EXPECT_FALSE(sleep_while(word, 1, milliseconds(20))) << "nobody woke it";
  EXPECT_GE(wall_now() - from, milliseconds(20));
  std::thread waker{[&] {
    nap(milliseconds(20));
    word = 0;
    wake(word);
  }};
  EXPECT_TRUE(sleep_while(word, 1, seconds(1'000)));
  EXPECT_EQ(word.load(), 0U);
  waker.join();
}

TEST(Futex, AWordThatHasChangedAlreadyIsNotSleptOn) {
  std::atomic<std::uint32_t> word = 0;
  EXPECT_TRUE(sleep_while(word, 1, seconds(1'000)));
}

}  // namespace
}  // namespace pitwall::transport
