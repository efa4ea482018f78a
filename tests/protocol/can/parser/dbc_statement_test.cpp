// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/parser/dbc_statement.hpp"

#include <gtest/gtest.h>

namespace pitwall::can {
namespace {

TEST(DbcStatement, BeginsWithAWordOfTheFormatAndWhatFollowsIt) {
  for (const char* text :
       {"BO_ 100 M: 8 A", "BO_ 100 M : 8 A", "SG_ a : 0|8@1+", "SG_ a m3M : 0|8@1+", "BU_: A",
        "BS_:", "NS_ :", "VERSION \"\"", "CM_ \"x\";", "CM_ SG_ 100 a \"x\";", "BA_ \"X\" 1;",
        "BA_DEF_ BO_ \"X\" INT 0 1;", "BA_DEF_DEF_ \"X\" 0;", "VAL_ 100 a 1 \"x\";",
        "VAL_TABLE_ T 1 \"x\";", "EV_ v: 0 [0|1] \"\"", "SIG_GROUP_ 100 G 1 : a;"}) {
    EXPECT_TRUE(begins_statement(text)) << text;
  }
}

// The second line of a statement, a line of a comment, a list of symbols.
TEST(DbcStatement, IsNotWhatOnlyLooksLikeOne) {
  for (const char* text :
       {"", "BO_", "BO_ 100 \"comment\";", "BO_ x M: 8 A", "BO_ 100 M 8 A", "SG_ 100 a 5;",
        "SG_ is a signal of the car", "BU_ A \"x\";", "CM_", "CM_\nBA_DEF_", "BA_ 1", "VERSION 2",
        "EV_ is", "VAL_", "Message M: 8", "bo_ 100 M: 8 A", "BO_X 100 M: 8 A"}) {
    EXPECT_FALSE(begins_statement(text)) << text;
  }
}

TEST(DbcStatement, IsFoundInTheLinesOfATextButNotInItsFirst) {
  const auto holds = [](std::string_view text) { return holds_statement(text, text.size()); };
  EXPECT_FALSE(holds("BO_ 100 M: 8 A"));
  EXPECT_FALSE(holds("one\ntwo\nSG_ three"));
  EXPECT_TRUE(holds("one\n\n  BO_ 100 M: 8 A"));
  EXPECT_TRUE(holds("one\r\nVAL_ 1 a 1 \"x\";"));
  EXPECT_TRUE(holds("one\rVAL_ 1 a 1 \"x\";"));
  EXPECT_FALSE(holds("one\n"));
  EXPECT_FALSE(holds(""));
  // The line begins within the size, whatever its end.
  EXPECT_TRUE(holds_statement("one\nBA_ \"X\" 1;", 8));
  EXPECT_FALSE(holds_statement("one\nBA_ \"X\" 1;", 4));
}

TEST(DbcStatement, AMisspeltMessageIsSeen) {
  EXPECT_TRUE(reads_like_message("BO 100 M: 8 A") && reads_like_message("B_ 100 M : 8 A"));
  EXPECT_FALSE(reads_like_message("SG b : 8|8@1+") || reads_like_message("BO 100 M 8 A"));
}

TEST(DbcStatement, KnowsTheWordsOfTheFormat) {
  EXPECT_TRUE(is_section("BO_") && is_section("CAT_") && !is_section("SG"));
  EXPECT_TRUE(is_unused_section("SIG_GROUP_") && !is_unused_section("BO_"));
  EXPECT_EQ(first_word("a_1:x"), "a_1");
  EXPECT_EQ(first_word(":x"), "");
}

}  // namespace
}  // namespace pitwall::can
