// SPDX-License-Identifier: Apache-2.0
#include "protocol/vocabulary/sequence.hpp"

#include <gtest/gtest.h>

#include <random>

namespace pitwall {
namespace {

TEST(Sequence, TheHalfThatFollowsANumberIsNewer) {
  for (const std::uint32_t size : {2U, 7U, 254U}) {
    for (std::uint32_t than = 0; than < size; ++than) {
      EXPECT_FALSE(is_newer(than, than, size));
      for (std::uint32_t ahead = 1; ahead < size; ++ahead) {
        EXPECT_EQ(is_newer((than + ahead) % size, than, size), ahead <= size / 2)
            << than << " and " << ahead << " of " << size;
      }
    }
  }
}

TEST(Sequence, AWholeNumberIsTheNearestWithItsLowBits) {
  constexpr std::uint64_t kTurn = std::uint64_t{1} << 32;
  EXPECT_EQ(whole_number(5, 0), 5U);
  EXPECT_EQ(whole_number(5, kTurn - 3), kTurn + 5);
  EXPECT_EQ(whole_number(0xFFFF'FFF0, kTurn + 3), kTurn - 16);
  EXPECT_EQ(whole_number(0xFFFF'FFFF, 0), kTurn - 1) << "never negative";
  std::mt19937_64 random(3);
  for (int i = 0; i < 100'000; ++i) {
    const std::uint64_t near = random() >> (random() % 40);
    const std::uint64_t back = random() % (kTurn / 2);
    const std::uint64_t number = (random() % 2) != 0 || back > near ? near + back : near - back;
    EXPECT_EQ(whole_number(static_cast<std::uint32_t>(number), near), number);
  }
}

}  // namespace
}  // namespace pitwall
