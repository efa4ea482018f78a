// SPDX-License-Identifier: Apache-2.0
#include "protocol/vocabulary/random.hpp"

#include <gtest/gtest.h>

#include <array>

namespace pitwall {
namespace {

TEST(Random, IsTheGeneratorThatItsAuthorsPublished) {
  // The reference sequence of SplitMix64 for the seed 1234567.
  Random random{1234567};
  for (const std::uint64_t expected :
       {6457827717110365317ULL, 3203168211198807973ULL, 9817491932198370423ULL,
        4593380528125082431ULL, 16408922859458223821ULL})
    EXPECT_EQ(random.next(), expected);
}

TEST(Random, IsUniform) {
  Random random{42};
  std::array<int, 10> tenths{};
  constexpr int kDraws = 100'000;
  for (int i = 0; i < kDraws; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++tenths[static_cast<std::size_t>(u * 10.0)];
  }
  for (const int count : tenths) EXPECT_NEAR(count, kDraws / 10, 500);  // 5 sigma
}

}  // namespace
}  // namespace pitwall
