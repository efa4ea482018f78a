// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/dbc/dbc_findings.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "protocol/can/dbc_parser.hpp"
#include "protocol/json/json_value.hpp"

namespace pitwall::cli {
namespace {

// A signal per letter, in message M.
std::string signals(const std::string& letters, const std::string& range,
                    const std::string& receiver) {
  std::string out;
  for (const char c : letters) {
    out += std::string(" SG_ ") + c + " : " + std::to_string(2 * (c - 'a')) + "|2@1+ (1,0) " +
           range + " \"\" " + receiver + "\n";
  }
  return out;
}

can::Database read(const std::string& text) {
  auto d = can::parse_dbc_leniently("BU_: A\nBO_ 1 M: 8 A\n" + text, "t.dbc");
  EXPECT_TRUE(d);
  return d ? *d : can::Database{};
}

TEST(DbcFindings, AFewAreLinesAndManyAreOne) {
  const can::Database d = read(signals("abcdefghijkl", "[0|3]", "Vector__XXX"));
  EXPECT_EQ(findings_text(d, false),
            "t.dbc: warning: 12 signals that nobody receives: M.a, M.b, M.c, M.d, M.e and 7 more "
            "(--all lists them)\n");
  const std::string all = findings_text(d, true);
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 12);
  EXPECT_TRUE(all.starts_with("t.dbc:3:6: warning: signal a: nobody receives it\n")) << all;
  EXPECT_EQ(findings_text(read(signals("ab", "[0|3]", "Vector__XXX")), false),
            "t.dbc:3:6: warning: signal a: nobody receives it\n"
            "t.dbc:4:6: warning: signal b: nobody receives it\n");
}

// Errors, then ranges, then the rest, whatever the order of the file; no error in a group.
TEST(DbcFindings, TheWorstComesFirst) {
  const can::Database d =
      read(signals("abcdefghijkl", "[0|3]", "Vector__XXX") +
           " SG_ z : 30|2@1+ (1,0) [0|9] \"\" A\n" + signals("mmmmmmmmmmmmm", "[0|3]", "A"));
  const std::string text = findings_text(d, false);
  const std::size_t error = text.find(
                        "t.dbc:17:6: error: signal m is already defined at t.dbc:16:6; "
                        "the signal is left out\n"),
                    range = text.find("t.dbc:15:6: warning: signal z: the range"),
                    unreceived = text.find("t.dbc: warning: 12 signals that nobody receives");
  EXPECT_EQ(error, 0U) << text;
  EXPECT_LT(error, range);
  EXPECT_LT(range, unreceived);
  EXPECT_NE(unreceived, std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 12 + 1 + 1);
  const std::string errors = errors_text(d);
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 12);
  EXPECT_EQ(errors.find("warning"), std::string::npos);
}

TEST(DbcFindings, WhatIsNotListedIsCounted) {
  can::Database d = read("");
  d.findings_left_off = {3, 2, 0};
  EXPECT_EQ(
      findings_text(d, false),
      "t.dbc: error: 3 more that are not listed\nt.dbc: warning: 2 more that are not listed\n");
  EXPECT_EQ(errors_text(d), "t.dbc: error: 3 more that are not listed\n");
}

TEST(DbcFindings, TheJsonHasAllOfThem) {
  const can::Database d =
      read(signals("abcdefghijkl", "[0|3]", "Vector__XXX") + signals("a", "[0|3]", "A"));
  const auto json = json::JsonValue::parse("{\"findings\": " + findings_json(d) + "}", "j");
  ASSERT_TRUE(json);
  const auto& items = json->items("findings");
  ASSERT_EQ(items.size(), 13U);
  EXPECT_EQ(items[0].text("severity"), "error");
  EXPECT_EQ(items[0].text("place"), "t.dbc:15:6");
  EXPECT_EQ(items[0].text("what"), "signal a is already defined at t.dbc:3:6");
  EXPECT_EQ(items[0].text("outcome"), "the signal is left out");
  EXPECT_EQ(items[12].text("severity"), "warning");
  EXPECT_EQ(items[12].text("subject"), "M.l");
}

}  // namespace
}  // namespace pitwall::cli
