// SPDX-License-Identifier: Apache-2.0
#include "protocol/vocabulary/text.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>

namespace pitwall {
namespace {

TEST(Formatted, IsWhatPrintfWrites) {
  EXPECT_EQ(formatted("%s: %.2f %s, %u of %llu", "gap", 1.005, "m", 3U, 7ULL),
            "gap: 1.00 m, 3 of 7");
  EXPECT_EQ(formatted("%08x", 0xBEEFU), "0000beef");
  EXPECT_EQ(formatted("%s", ""), "");
}

TEST(Formatted, HasNoLongestText) {
  for (const int length : {1, 255, 256, 257, 511, 512, 513, 100'000}) {
    const std::string text = formatted("%*d", length, 7);
    ASSERT_EQ(text.size(), static_cast<std::size_t>(length));
    EXPECT_EQ(text.back(), '7');
  }
}

TEST(Shortest, ReadsBackAsTheSameNumberAndSaysNoMore) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(-0.0), "-0");
  EXPECT_EQ(shortest(std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(shortest(std::numeric_limits<double>::infinity()), "inf");
  std::mt19937_64 random{17};
  for (int i = 0; i < 20'000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (value != value) continue;
    const std::string text = shortest(value);
    ASSERT_EQ(std::strtod(text.c_str(), nullptr), value) << text;
    ASSERT_LE(text.size(), formatted("%.17g", value).size());
  }
}

TEST(Hex, IsReadBackByTheCLibrary) {
  for (const std::uint64_t value : {0ULL, 9ULL, 0xABCULL, ~0ULL}) {
    EXPECT_EQ(std::strtoull(hex(value).c_str(), nullptr, 16), value);
    EXPECT_EQ(hex(value).substr(0, 2), "0x");
  }
}

TEST(Trimmed, LosesBlanksAtEitherEndAndNothingElse) {
  EXPECT_EQ(trimmed(" \t a b\r\n"), "a b");
  EXPECT_EQ(trimmed(" \n\t"), "");
  EXPECT_EQ(trimmed(""), "");
  EXPECT_EQ(trimmed("x"), "x");
}

}  // namespace
}  // namespace pitwall
