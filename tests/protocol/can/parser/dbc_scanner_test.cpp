// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/parser/dbc_scanner.hpp"

#include <gtest/gtest.h>

namespace pitwall::can {
namespace {

template <class Fn>
std::string stop_of(std::string_view text, Fn fn) {
  DbcScanner scan{text, "t"};
  try {
    fn(scan);
  } catch (const DbcScanner::Stop& stop) {
    return to_string(stop.problem);
  }
  return "";
}

TEST(DbcScanner, TokensAndPlaces) {
  DbcScanner scan{
      "\xEF\xBB\xBF"
      "BO_ 12\r\n  name : -1.5e-07 +2 \"a \\\"b\\\"\"; x",
      "t"};
  EXPECT_EQ(scan.word(), "BO_");
  EXPECT_EQ(scan.integer(0, 99), 12);
  EXPECT_EQ(scan.place(), "t:2:3");
  EXPECT_EQ(scan.word(), "name");
  EXPECT_TRUE(scan.take(':'));
  EXPECT_FALSE(scan.take(':'));
  EXPECT_EQ(scan.real(), -1.5e-7);
  EXPECT_EQ(scan.real(), 2.0);
  EXPECT_EQ(scan.string(), "a \"b\"");
  (void)scan.statement();
  EXPECT_EQ(scan.string_or_word(), "x");
  EXPECT_TRUE(scan.at_end());
  EXPECT_EQ(scan.peek(), '\0');
  scan.rewind(0);
  EXPECT_EQ(scan.place(), "t:1:1");
}

TEST(DbcScanner, RemarksAreSpaces) {
  DbcScanner scan{"// one\na // two \"\n//three\nb \"// text\" c // x;\n; d //", "t"};
  EXPECT_EQ(scan.word(), "a");
  EXPECT_EQ(scan.word(), "b");
  EXPECT_EQ(scan.string(), "// text");
  (void)scan.statement();
  EXPECT_EQ(scan.word(), "d");
  EXPECT_TRUE(scan.at_end());
}

TEST(DbcScanner, StopsSayWhereAndWhat) {
  EXPECT_EQ(stop_of("\n ;", [](auto& s) { (void)s.word(); }), "t:2:2: error: expected a name");
  EXPECT_EQ(stop_of("x", [](auto& s) { s.expect(':'); }), "t:1:1: error: expected ':'");
  EXPECT_EQ(stop_of("nan", [](auto& s) { (void)s.real(); }), "t:1:1: error: expected a number");
  EXPECT_EQ(stop_of("inf", [](auto& s) { (void)s.real(); }), "t:1:1: error: expected a number");
  EXPECT_NE(stop_of("1e999", [](auto& s) { (void)s.real(); }), "");
  EXPECT_EQ(stop_of("70", [](auto& s) { (void)s.integer(0, 64); }),
            "t:1:1: error: expected a whole number from 0 to 64");
  EXPECT_EQ(stop_of("99999999999999999999", [](auto& s) { (void)s.integer(0, 64); }),
            "t:1:1: error: expected a whole number from 0 to 64");
  EXPECT_EQ(stop_of(" \"abc", [](auto& s) { (void)s.string(); }),
            "t:1:2: error: this text has no closing quote");
}

TEST(DbcScanner, OldEncodingBecomesUtf8) {
  DbcScanner old{
      "\"\xB0"
      "C \x80 \x9D\"",
      "t"};
  EXPECT_EQ(old.string(), "\u00B0C \u20AC \u009D");
  DbcScanner utf8{"\"\u00B0C \u20AC \U0001F3CE\"", "t"};
  EXPECT_EQ(utf8.string(), "\u00B0C \u20AC \U0001F3CE");
  DbcScanner truncated{"\"\xE2\x82\"", "t"};  // half a euro sign is not UTF-8: two old characters
  EXPECT_EQ(truncated.string(), "\u00E2\u201A");
}

}  // namespace
}  // namespace pitwall::can
