// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/parser/dbc_resolution.hpp"

#include <gtest/gtest.h>

#include "protocol/can/decode.hpp"
#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

std::string signal(const std::string& name, const std::string& bits) {
  return " SG_ " + name + " : " + bits + "@1+ (1,0) [0|0] \"\" A\n";
}

// The names that are left of a message of eight bytes with these signals.
std::string left_of(const std::string& signals, const std::string& more = "") {
  const Database d = leniently(dbc_with(signals) + more);
  std::string out;
  for (const Signal& s : d.messages.at(0).signals) out += (out.empty() ? "" : " ") + s.name;
  return out;
}

std::string errors_with(const std::string& signals, const std::string& more = "") {
  return errors_of(leniently(dbc_with(signals) + more));
}

TEST(DbcResolution, LeavesOutWhatLiesOutside) {
  const std::string signals = signal("a", "0|8") + signal("b", "60|8") + signal("c", "8|8");
  EXPECT_EQ(left_of(signals), "a c");
  EXPECT_EQ(errors_with(signals),
            "t.dbc:9:6: signal b lies outside the 8 bytes of message M; the signal is left out\n");
}

TEST(DbcResolution, LeavesOutTheSecondOfAnEqualName) {
  const std::string signals =
      signal("a", "0|8") + signal("a", "8|8") + signal("b", "16|8") + signal("a", "24|8");
  const Database d = leniently(dbc_with(signals));
  EXPECT_EQ(left_of(signals), "a b");
  EXPECT_EQ(d.messages[0].signals[0].layout.start, 0);
  EXPECT_EQ(errors_of(d),
            "t.dbc:9:6: signal a is already defined at t.dbc:8:6; the signal is left out\n"
            "t.dbc:11:6: signal a is already defined at t.dbc:8:6; the signal is left out\n");
}

TEST(DbcResolution, KeepsAndMarksWhatOverlaps) {
  const Database d = leniently(dbc_with(signal("a", "0|8") + signal("b", "4|8") +
                                        signal("c", "16|8") + signal("d", "0|12")));
  const Message& m = d.messages.at(0);
  ASSERT_EQ(m.signals.size(), 4U);
  EXPECT_TRUE(m.signals[0].is_flawed && m.signals[1].is_flawed && m.signals[3].is_flawed);
  EXPECT_FALSE(m.signals[2].is_flawed);
  EXPECT_EQ(
      errors_of(d),
      "t.dbc:9:6: signal b overlaps signal a defined at t.dbc:8:6; all are kept\n"
      "t.dbc:11:6: signal d overlaps signal a defined at t.dbc:8:6 and 1 more; all are kept\n");
  std::vector<double> values(4);
  ASSERT_TRUE(decode(m, {.id = 100, .length = 8, .data = {0x21, 0x43}}, values));
  EXPECT_EQ(values, (std::vector<double>{0x21, 0x32, 0, 0x321}));
}

TEST(DbcResolution, LeavesOutWhatHasNoClearMultiplexer) {
  const std::string none = signal("a", "0|8") + signal("b m1", "8|8");
  EXPECT_EQ(left_of(none), "a");
  EXPECT_EQ(errors_with(none),
            "t.dbc:9:6: signal b: message M has 0 multiplexers that could be meant; the signal is "
            "left out\n");
  const std::string two = signal("s M", "0|8") + signal("t M", "8|8") + signal("b m1", "16|8");
  EXPECT_EQ(left_of(two), "s t");
  EXPECT_NE(errors_with(two).find("has 2 multiplexers that could be meant"), std::string::npos);
}

// What hangs on a signal that is left out is left out too; the indices of the others move.
TEST(DbcResolution, LeavesOutWhatHangsOnIt) {
  const std::string signals = signal("x", "60|8") + signal("s M", "0|4") + signal("t m1M", "60|9") +
                              signal("u m2", "8|8") + signal("v m3", "16|8");
  const std::string links = "SG_MUL_VAL_ 100 v t 3-3;\n";
  const Database d = leniently(dbc_with(signals) + links);
  EXPECT_EQ(left_of(signals, links), "s u");
  EXPECT_EQ(d.messages[0].signals[1].selector, std::optional<std::size_t>{0});
  EXPECT_EQ(d.messages[0].deepest, 1);
  EXPECT_NE(errors_of(d).find(
                "t.dbc:12:6: the multiplexer t of signal v is left out; the signal is left out\n"),
            std::string::npos)
      << errors_of(d);
}

TEST(DbcResolution, LeavesOutACircle) {
  const std::string signals = signal("s M", "0|4") + signal("a m1M", "8|8") +
                              signal("b m2M", "16|8") + signal("c m3", "24|8");
  const std::string links = "SG_MUL_VAL_ 100 a b 1-1;\nSG_MUL_VAL_ 100 b a 2-2;\n";
  EXPECT_EQ(left_of(signals, links), "s c");
  EXPECT_NE(errors_with(signals, links)
                .find("t.dbc:9:6: the multiplexers of signal a form a circle, or are more than 64; "
                      "the signal is left out\n"),
            std::string::npos);
}

}  // namespace
}  // namespace pitwall::can
