// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/text_line.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace pitwall::replay {
namespace {

TEST(TextLine, LinesEndWithEveryKindOfEnd) {
  TextLines lines(
      "\xEF\xBB\xBF"
      "a\r\nb\rc\n\n\rd");
  std::vector<std::string> found;
  while (lines.next()) {
    found.emplace_back(lines.line());
    EXPECT_EQ(lines.number(), found.size());
    EXPECT_EQ(lines.has_end(), lines.line() != "d");
  }
  EXPECT_EQ(found, (std::vector<std::string>{"a", "b", "c", "", "", "d"}));
}

TEST(TextLine, WordsAndNumbersAreReadInOrder) {
  TextLine line{.text = "  ab\t12 1F 300"};
  EXPECT_EQ(line.next_word(), "ab");
  EXPECT_EQ(line.word(), "ab");
  std::uint64_t n = 0;
  line.skip_spaces();
  EXPECT_TRUE(read_unsigned(line, 10, 99, n));
  EXPECT_EQ(n, 12U);
  line.skip_spaces();
  EXPECT_TRUE(read_unsigned(line, 16, 99, n));
  EXPECT_EQ(n, 0x1FU);
  line.skip_spaces();
  EXPECT_FALSE(read_unsigned(line, 10, 255, n));
  EXPECT_EQ(line.at, 11U);
  EXPECT_STREQ(line.what, "number out of range");
}

TEST(TextLine, DecimalsAreExact) {
  const auto ns_of = [](const char* text, std::int64_t unit_ns) {
    TextLine line{.text = text};
    std::int64_t out = -1;
    return read_decimal(line, unit_ns, out) ? out : -1;
  };
  EXPECT_EQ(ns_of("1.000000001", kNanosecondsPerSecond), 1'000'000'001);
  EXPECT_EQ(ns_of("1,5", kNanosecondsPerSecond), 1'500'000'000);
  EXPECT_EQ(ns_of("17535.4", kNanosecondsPerMillisecond), 17'535'400'000);
  EXPECT_EQ(ns_of("0.0000019", kNanosecondsPerMillisecond), 1);
  EXPECT_EQ(ns_of("8999999999.9", kNanosecondsPerSecond), 8'999'999'999'900'000'000);
  for (const char* bad : {"", ".5", "1.", "1.0000000001", "9000000000.0", "99999999999999999999"})
    EXPECT_EQ(ns_of(bad, kNanosecondsPerSecond), -1) << bad;
}

TEST(TextLine, BytesNeedTwoDigits) {
  std::uint8_t byte = 0;
  TextLine good{.text = "aF"}, half{.text = "1"}, none{.text = "x"};
  EXPECT_TRUE(read_hex_byte(good, byte, "none"));
  EXPECT_EQ(byte, 0xAF);
  EXPECT_FALSE(read_hex_byte(half, byte, "none"));
  EXPECT_FALSE(read_hex_byte(none, byte, "none"));
  EXPECT_STREQ(none.what, "none");
}

}  // namespace
}  // namespace pitwall::replay
