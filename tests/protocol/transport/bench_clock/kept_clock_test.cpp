// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/bench_clock/kept_clock.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/clock.hpp"
#include "tests/protocol/transport/bench_clock/clock_file.hpp"

namespace pitwall::transport {
namespace {

TEST(KeptClock, GoesOnByItselfUntilItsEnd) {
  const ClockFile file;
  auto kept = KeptClock::keep(file.path);
  ASSERT_TRUE(kept);
  EXPECT_FALSE(KeptClock::keep(file.path)) << "one to a file";
  const auto memory = ClockMemory::open(file.path);
  const auto now = [&] { return bench_now(memory->page(), wall_now); };
  const Instant wall = wall_now(), from = now();  // a span of the wall's around one of the bench's
  EXPECT_NE(memory->page().horizon_ns.load(), INT64_MAX);
  while (now() - from < milliseconds(100)) nap(milliseconds(1));
  const Duration went = now() - from, passed = wall_now() - wall;
  EXPECT_LE(went, passed);
  kept->end();
  EXPECT_EQ(memory->page().horizon_ns.load(), INT64_MAX);
  EXPECT_EQ(kept->end().count, 0U) << "it has ended";
}

}  // namespace
}  // namespace pitwall::transport
