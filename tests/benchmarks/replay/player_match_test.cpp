// What needs no CAN in the kernel; matches are tested in tests/system/vcan/bench_replay_test.cpp.
// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/replay/player_match.hpp"

#include <gtest/gtest.h>

#include "tests/benchmarks/replay/sample_log.hpp"

namespace pitwall::benchmarks {
namespace {

TEST(PlayerMatch, NobodyPlaysOnAnInterfaceThatIsNotThere) {
  const auto figures =
      play_match({.log_file = "/nowhere.log", .folder = "/nowhere", .interface = "nosuchcan0"},
                 replay::sample_log(milliseconds(100)));
  ASSERT_FALSE(figures.has_value());
  EXPECT_EQ(figures.error().place, "nosuchcan0");
}

}  // namespace
}  // namespace pitwall::benchmarks
