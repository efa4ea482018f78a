// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/parser/dbc_draft.hpp"

#include <gtest/gtest.h>

#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

const std::string kPlain = " : 0|8@1+ (1,0) [0|0] \"\" A\n";

TEST(DbcDraft, MultiplexersMayComeAfterTheirSignals) {
  const Database d = parsed(dbc_with(" SG_ a m2 : 8|8@1+ (1,0) [0|0] \"\" A\n SG_ s M" + kPlain));
  const Message& m = d.messages.at(0);
  EXPECT_EQ(m.signals[0].selector, std::optional<std::size_t>{1});
  EXPECT_EQ(m.signals[0].when, (std::vector<SelectorRange>{{2, 2}}));
  EXPECT_TRUE(m.signals[1].is_selector);
  EXPECT_EQ(m.deepest, 1);
}

TEST(DbcDraft, MultiplexersMayHangOnEachOther) {
  const Database d = parsed(dbc_with(" SG_ s M" + kPlain +
                                     " SG_ t m1M : 8|8@1+ (1,0) [0|0] \"\" A\n"
                                     " SG_ u m7M : 16|8@1+ (1,0) [0|0] \"\" A\n"
                                     " SG_ v m9 : 24|8@1+ (1,0) [0|0] \"\" A\n"
                                     "SG_MUL_VAL_ 100 u t 7-7;\nSG_MUL_VAL_ 100 v u 9-12;\n"));
  const Message& m = d.messages.at(0);
  for (std::uint8_t depth = 0; depth < 4; ++depth) EXPECT_EQ(m.signals[depth].depth, depth);
  EXPECT_EQ(m.deepest, 3);
  EXPECT_EQ(m.signals[3].selector, std::optional<std::size_t>{2});
}

TEST(DbcDraft, TooManyMultiplexersAreRefusedLikeACircle) {
  std::string signals = " SG_ s0 M : 0|1@1+ (1,0) [0|0] \"\" A\n", links;
  for (int i = 1; i <= 70; ++i) {
    const std::string n = std::to_string(i);
    signals += " SG_ s" + n + " m1M : " + n + "|1@1+ (1,0) [0|0] \"\" A\n";
    links += "SG_MUL_VAL_ 100 s" + n + " s" + std::to_string(i - 1) + " 1-1;\n";
  }
  EXPECT_NE(complaint(dbc_with(signals + links, 64)).find("form a circle, or are more than 64"),
            std::string::npos);
}

// Everything else refers to the short name.
TEST(DbcDraft, LongNamesReplaceShortOnesAtTheEnd) {
  const std::string text = dbc_with(" SG_ s" + kPlain) +
                           "BO_ 101 N: 8 A\n"
                           "BA_ \"SystemSignalLongSymbol\" SG_ 100 s \"long_s\";\n"
                           "BA_ \"SystemMessageLongSymbol\" BO_ 100 \"Long_M\";\n"
                           "CM_ SG_ 100 s \"said of the short name\";\n";
  const Database d = parsed(text);
  ASSERT_NE(d.find("Long_M"), nullptr);
  EXPECT_EQ(d.find("M"), nullptr);
  EXPECT_EQ(d.find("Long_M")->signals.at(0).name, "long_s");
  EXPECT_EQ(d.find("Long_M")->signals.at(0).comment, "said of the short name");
  EXPECT_EQ(complaint(text + "BA_ \"SystemMessageLongSymbol\" BO_ 101 \"Long_M\";\n"),
            "t.dbc:10:1: error: message Long_M is already defined at t.dbc:7:1");
}

TEST(DbcDraft, PeriodsAndFormatsComeFromAttributesAndTheirDefaults) {
  const std::string text = dbc_with(" SG_ s" + kPlain) +
                           "BO_ 101 N: 8 A\nBO_ 102 O: 8 A\n"
                           "BA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 65535;\n"
                           "BA_DEF_ BO_ \"VFrameFormat\" ENUM \"StandardCAN\",\"StandardCAN_FD\";\n"
                           "BA_DEF_DEF_ \"GenMsgCycleTime\" 50;\n"
                           "BA_DEF_DEF_ \"VFrameFormat\" \"StandardCAN\";\n"
                           "BA_ \"GenMsgCycleTime\" BO_ 101 20;\n"
                           "BA_ \"GenMsgCycleTime\" BO_ 102 -3;\n"
                           "BA_ \"VFrameFormat\" BO_ 101 1;\n";
  const Database d = parsed(text);
  EXPECT_EQ(d.find("M")->period, milliseconds(50));
  EXPECT_EQ(d.find("N")->period, milliseconds(20));
  EXPECT_EQ(d.find("O")->period, Duration{});
  EXPECT_FALSE(d.find("M")->fd);
  EXPECT_TRUE(d.find("N")->fd);
  ASSERT_EQ(d.findings.size(), 1U);
  EXPECT_EQ(d.findings[0].what, "message O: the GenMsgCycleTime \"-3\" is no time in milliseconds");
}

TEST(DbcDraft, RemarksAreInTheOrderOfTheFileAndTheirNumberIsBounded) {
  std::string text = dbc_with(" SG_ s : 0|8@1+ (1,0) [0|999] \"\" A\n");
  for (std::size_t i = 0; i < kMaxFindings + 5; ++i) text += "CM_ BO_ 7 \"x\";\n";
  const Database d = parsed(text);
  EXPECT_EQ(d.findings.size(), kMaxFindings + 1);
  EXPECT_EQ(d.count(FindingSeverity::kWarning), kMaxFindings + 6);
  EXPECT_EQ(d.findings_left_off[1], 5U);
  const Database few =
      parsed(dbc_with(" SG_ s : 0|8@1+ (1,0) [0|999] \"\" A\n SG_ t : 8|8@1+ (1,0) [0|999] \"\" A\n"
                      "CM_ BO_ 7 \"x\";\n"));
  ASSERT_EQ(few.findings.size(), 3U);
  EXPECT_EQ(few.findings[0].place, "t.dbc:8:6");
  EXPECT_EQ(few.findings[1].place, "t.dbc:9:6");
  EXPECT_EQ(few.findings[2].place, "t.dbc:10:1");
}

}  // namespace
}  // namespace pitwall::can
