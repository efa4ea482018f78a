// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/finding.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

TEST(Finding, KindsStandInTheOrderOfTheirSeverity) {
  std::set<std::string> plurals;
  FindingSeverity worst = FindingSeverity::kError;
  for (std::size_t i = 0; i < kFindingKinds; ++i) {
    const auto kind = static_cast<FindingKind>(i);
    EXPECT_GE(severity_of(kind), worst);
    worst = severity_of(kind);
    plurals.insert(plural_of(kind));
  }
  EXPECT_EQ(worst, FindingSeverity::kNote);
  EXPECT_EQ(plurals.size(), kFindingKinds);
  EXPECT_EQ(severity_of(FindingKind::kTooLong), FindingSeverity::kError);
  EXPECT_EQ(severity_of(FindingKind::kRange), FindingSeverity::kWarning);
  EXPECT_EQ(severity_of(FindingKind::kUnreceived), FindingSeverity::kWarning);
  EXPECT_EQ(severity_of(FindingKind::kIndependentSignals), FindingSeverity::kNote);
  EXPECT_STREQ(name_of(FindingSeverity::kError), "error");
  EXPECT_STREQ(name_of(FindingSeverity::kNote), "note");
}

TEST(Finding, TheTextHasTheOutcomeWhereThereIsOne) {
  EXPECT_EQ(text_of({FindingKind::kSyntax, "t:1:1", "expected ':'", "it is left out", ""}),
            "expected ':'; it is left out");
  EXPECT_EQ(text_of({FindingKind::kRange, "t:1:1", "too wide", "", ""}), "too wide");
}

// A strict reading names the worst error first, whatever its place in the file.
TEST(Finding, ARefusalNamesTheWorstErrorAndHowManyMoreThereAre) {
  const std::string overlap = dbc_with(kSignal + " SG_ b : 4|8@1+ (1,0) [0|0] \"\" A\n");
  EXPECT_EQ(complaint(overlap),
            "t.dbc:9:6: error: signal b overlaps signal a defined at t.dbc:8:6");
  EXPECT_EQ(complaint(overlap + " SG_ c : 60|8@1+ (1,0) [0|0] \"\" A\n"),
            "t.dbc:11:6: error: signal c lies outside the 8 bytes of message M (and 1 more)");
  EXPECT_EQ(complaint(overlap + " SG_ c : 60|8@1+ (1,0) [0|0] \"\" A\nBO_ 7 N 8 A\n"),
            "t.dbc:12:9: error: expected ':' (and 2 more)");
}

TEST(Finding, ErrorsBeyondTheLimitAreCountedAndStillRefuse) {
  std::string text = dbc_with(kSignal);
  for (std::size_t i = 0; i < kMaxFindings + 7; ++i) text += "SIG_VALTYPE_ 100 a : 1;\n";
  const Database d = leniently(text);
  EXPECT_EQ(d.findings.size(), kMaxFindings);
  EXPECT_EQ(d.findings_left_off[0], 7U);
  EXPECT_EQ(d.count(FindingSeverity::kError), kMaxFindings + 7);
  EXPECT_EQ(d.messages[0].flaws.size(), kMaxFindings);
  EXPECT_NE(complaint(text).find("(and 10006 more)"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::can
