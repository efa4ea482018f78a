// SPDX-License-Identifier: Apache-2.0
#include "hil/report/text.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::report {
namespace {

const std::string kUnknown = "\xEF\xBF\xBD";

TEST(Escaped, PlainTextStaysAsItIs) {
  for (const char* text : {"", "lvms_flying_lap", "Zürich 9 m/s", "\xF0\x9F\x8F\x81"})
    EXPECT_EQ(escaped(text), text);
}

TEST(Escaped, NoMarkupGetsThrough) {
  EXPECT_EQ(escaped("<script>alert('x' + \"y\")</script>&amp;"),
            "&lt;script&gt;alert(&#39;x&#39; + &quot;y&quot;)&lt;/script&gt;&amp;amp;");
}

TEST(Escaped, EveryByteGivesTextWithoutMarkupAndControls) {
  for (int byte = 0; byte < 256; ++byte) {
    const std::string out = escaped(std::string("a") + static_cast<char>(byte) + "b");
    EXPECT_TRUE(out.starts_with('a') && out.ends_with('b')) << byte;
    EXPECT_EQ(out.find_first_of("<>\"'\t\n\r"), std::string::npos) << byte;
    for (const char c : out) EXPECT_GE(static_cast<unsigned char>(c), 0x20) << byte;
    if (byte < 0x7F) continue;
    EXPECT_EQ(out, "a" + kUnknown + "b") << byte << ": no UTF-8 by itself";
  }
}

TEST(Escaped, BrokenUtf8AndForbiddenCharactersAreReplaced) {
  EXPECT_EQ(escaped("\xC3"), kUnknown) << "cut";
  EXPECT_EQ(escaped("\xC0\xBC"), kUnknown + kUnknown) << "a < in two bytes";
  EXPECT_EQ(escaped("\xED\xA0\x80"), kUnknown + kUnknown + kUnknown) << "a surrogate";
  EXPECT_EQ(escaped("\xEF\xBF\xBE"), kUnknown) << "no character";
  EXPECT_EQ(escaped("\xE2\x80\xAE"), kUnknown) << "turns the direction of writing";
  EXPECT_EQ(escaped("\xC2\x85"), kUnknown) << "a control of Latin-1";
  EXPECT_EQ(escaped(std::string_view("\0", 1)), kUnknown);
  EXPECT_EQ(escaped("a\nb\tc"), "a b c");
}

TEST(Number, SaysWhatIsNoNumber) {
  EXPECT_EQ(number(1.005, 1), "1.0");
  EXPECT_EQ(number(-0.04, 1), "0.0") << "no minus without a digit";
  EXPECT_EQ(number(-0.06, 1), "-0.1");
  EXPECT_EQ(number(kUnset, 1), "not known");
  EXPECT_EQ(number(std::numeric_limits<double>::infinity(), 1), "unbounded");
  EXPECT_EQ(number(1e300, 3), "1e+300");
  EXPECT_EQ(significant(1e-9, 4), "1e-09");
}

}  // namespace
}  // namespace pitwall::report
