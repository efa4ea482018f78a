// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/parser/dbc_section.hpp"

#include <gtest/gtest.h>

#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

// The section "BO_TX_BU_ 100 ..." of a file with message 100.
class DbcSectionTest : public ::testing::Test {
 protected:
  explicit DbcSectionTest() : draft_("t.dbc") {
    Message m;
    m.id = 100;
    m.name = "M";
    draft_.add(100, std::move(m), {});
    draft_.index();
  }

  DbcDraft draft_;
};

TEST_F(DbcSectionTest, EndsWithASemicolon) {
  DbcScanner scan{"CM_ ; CM_", "t.dbc"};
  DbcSection section{scan, draft_};
  EXPECT_EQ(section.word(), "CM_");
  EXPECT_EQ(section.place(), "t.dbc:1:1");
  EXPECT_TRUE(section.ends());
  EXPECT_TRUE(draft_.database.findings.empty());
  EXPECT_EQ(scan.word(), "CM_");
}

// Where it ends without one, that is told of the message that it is about.
TEST_F(DbcSectionTest, EndsWithoutOneAtTheNextStatementOrTheEnd) {
  for (const char* rest : {"\nBO_ 7 N: 8 A\n", "\n"}) {
    const std::string text = std::string{"CM_ BO_ 100"} + rest;
    DbcScanner scan{text, "t.dbc"};
    DbcSection section{scan, draft_};
    (void)scan.word();
    EXPECT_EQ(section.message_key(), 100U);
    EXPECT_TRUE(section.ends());
    EXPECT_EQ(draft_.database.findings.back().what, "expected ';'");
    EXPECT_EQ(draft_.database.findings.back().place, "t.dbc:2:1");
  }
  EXPECT_EQ(draft_.database.messages[0].flaws.size(), 2U);
}

TEST_F(DbcSectionTest, DoesNotEndInItsMiddle) {
  DbcScanner scan{"CM_ x\ny ;", "t.dbc"};
  DbcSection section{scan, draft_};
  EXPECT_FALSE(section.ends());
  EXPECT_THROW(section.close(), DbcScanner::Stop);
  EXPECT_TRUE(draft_.database.findings.empty());
}

TEST_F(DbcSectionTest, IsKeptAsItIsWritten) {
  DbcScanner scan{"CM_ EV_ v\n \"x;\" ; BO_", "t.dbc"};
  DbcSection section{scan, draft_};
  (void)scan.word();
  section.keep();
  ASSERT_EQ(draft_.database.unused.size(), 1U);
  EXPECT_EQ(draft_.database.unused[0].text, "CM_ EV_ v\n \"x;\" ;");
  EXPECT_TRUE(draft_.database.findings.empty());
}

TEST_F(DbcSectionTest, WarnsOfStrangersButNotOfWhatWasLeftOut) {
  DbcScanner scan{"CM_ ;", "t.dbc"};
  DbcSection section{scan, draft_};
  draft_.leave_out(7);
  draft_.leave_out(100, "lost");
  section.warn_unknown_reference(7, "");
  section.warn_unknown_reference(100, "lost");
  EXPECT_TRUE(draft_.database.findings.empty());
  section.warn_unknown_reference(8, "");
  section.warn_unknown_reference(100, "other");
  ASSERT_EQ(draft_.database.findings.size(), 2U);
  EXPECT_EQ(draft_.database.findings[0].what, "CM_ of message 8, which the file does not have");
  EXPECT_EQ(draft_.database.findings[1].subject, "M.other");
}

}  // namespace
}  // namespace pitwall::can
