// SPDX-License-Identifier: Apache-2.0
#include "protocol/json/json_text.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "protocol/json/json_value.hpp"

namespace pitwall::json {
namespace {

std::string read_back(std::string_view text) {
  const auto value = JsonValue::parse(quoted(text), "test");
  return value ? value->text() : "NO JSON";
}

TEST(JsonText, WhatIsWrittenIsReadAsTheSame) {
  for (const std::string_view text :
       {std::string_view{""}, std::string_view{"a\"b\\c/"}, std::string_view{"\0\x1f\x7f\n", 4},
        std::string_view{"\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x8F\x81"}}) {
    EXPECT_EQ(read_back(text), text);
  }
}

TEST(JsonText, WhatIsNoUtf8IsReplacedByteByByte) {
  EXPECT_EQ(quoted("a\xFFz"), "\"a\xEF\xBF\xBDz\"");
  EXPECT_EQ(quoted("\xC0\x80"), "\"\xEF\xBF\xBD\xEF\xBF\xBD\"");                  // overlong
  EXPECT_EQ(quoted("\xED\xA0\x80"), "\"\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\"");  // a surrogate
  EXPECT_EQ(quoted("\xE2\x82"), "\"\xEF\xBF\xBD\xEF\xBF\xBD\"");                  // cut
}

TEST(JsonText, RandomBytesBecomeATextThatStaysAsItIs) {
  std::mt19937 random(5);
  for (int round = 0; round < 2'000; ++round) {
    std::string bytes(random() % 12, ' ');
    for (char& c : bytes) c = static_cast<char>(random() % 256);
    const std::string once = read_back(bytes);
    EXPECT_EQ(read_back(once), once);
  }
}

TEST(JsonText, NumbersThatAreNoneAreNull) {
  EXPECT_EQ(number(std::numeric_limits<double>::quiet_NaN()), "null");
  EXPECT_EQ(number(std::numeric_limits<double>::infinity()), "null");
  EXPECT_EQ(number(-0.25), "-0.25");
  EXPECT_EQ(number(1e300), "1e+300");
  EXPECT_EQ(integer(-7), "-7");
}

TEST(JsonText, ObjectsAndLists) {
  const std::string text = Object{}
                               .text("a", "x")
                               .number("b", 1.5)
                               .number("c", 7U)
                               .flag("d", true)
                               .json("e", Array{}.json("1").json("null").str())
                               .str();
  EXPECT_EQ(text, R"({"a": "x", "b": 1.5, "c": 7, "d": true, "e": [1, null]})");
  EXPECT_EQ(Object{}.str(), "{}");
  EXPECT_EQ(Array{}.str(), "[]");
}

}  // namespace
}  // namespace pitwall::json
