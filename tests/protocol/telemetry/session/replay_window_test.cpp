// SPDX-License-Identifier: Apache-2.0
// Against a set of all numbers that were ever had.
#include "protocol/telemetry/session/replay_window.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

namespace pitwall::telemetry {
namespace {

struct Reference {
  std::set<std::uint64_t> all;
  std::uint64_t newest = 0;

  bool had(std::uint64_t n) const {
    return n == 0 || (newest >= kReplayWindow && n <= newest - kReplayWindow) || all.contains(n);
  }
  void set(std::uint64_t n) {
    all.insert(n);
    newest = std::max(newest, n);
  }
};

TEST(ReplayWindow, AgreesWithASetOfAllNumbers) {
  std::mt19937_64 random(7);
  for (const std::uint64_t start : {std::uint64_t{1}, (std::uint64_t{1} << 32) - 1'000}) {
    ReplayWindow window;
    Reference reference;
    std::uint64_t head = start;
    for (int i = 0; i < 200'000; ++i) {
      const bool jump = random() % 500 == 0;
      head += jump ? random() % 5'000 : random() % 3;
      const std::uint64_t back = random() % 1'400;
      const std::uint64_t number = head > back ? head - back : head;
      ASSERT_EQ(window.had(number), reference.had(number)) << number << " of " << window.newest();
      if (!window.had(number)) {
        window.set(number);
        reference.set(number);
      }
      ASSERT_EQ(window.newest(), reference.newest);
    }
  }
}

TEST(ReplayWindow, HoldsExactlyTheNewestAndThoseBeforeIt) {
  ReplayWindow window;
  window.set(5'000);
  EXPECT_FALSE(window.too_old(5'000 - kReplayWindow + 1));
  EXPECT_TRUE(window.too_old(5'000 - kReplayWindow));
  for (std::uint64_t n = 5'000 - kReplayWindow + 1; n < 5'000; ++n)
    EXPECT_FALSE(window.had(n)) << n;
}

TEST(ReplayWindow, TheLargestNumberIsANumberLikeAnyOther) {
  constexpr std::uint64_t kLast = std::numeric_limits<std::uint64_t>::max();
  ReplayWindow window;
  window.set(1);
  window.set(kLast);
  EXPECT_TRUE(window.had(kLast));
  EXPECT_TRUE(window.had(1));
  EXPECT_FALSE(window.had(kLast - 1));
}

}  // namespace
}  // namespace pitwall::telemetry
