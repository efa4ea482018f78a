// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/parser/dbc_remarks.hpp"

#include <gtest/gtest.h>

#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

// The remarks on one signal "s" with this definition.
std::string output(const std::string& definition, const std::string& more = "", int length = 8) {
  const Database d = parsed(dbc_with(" SG_ s " + definition + "\n" + more, length));
  std::string out;
  for (const Finding& f : d.findings) out += f.what + "\n";
  return out;
}

TEST(DbcRemarks, ARangeWiderThanTheFieldIsTold) {
  EXPECT_EQ(output(": 0|11@1- (0.5,0) [-1024|1023] \"deg\" A"),
            "signal s: the range [-1024|1023] is wider than its 11 bits can hold, [-512|511.5]\n");
  EXPECT_EQ(output(": 0|8@1+ (-1,0) [-256|0] \"\" A"),
            "signal s: the range [-256|0] is wider than its 8 bits can hold, [-255|0]\n");
  EXPECT_NE(
      output(": 0|32@1- (1,0) [-1e39|1e39] \"\" A", "SIG_VALTYPE_ 100 s : 1;\n").find("wider"),
      std::string::npos);
}

TEST(DbcRemarks, ARangeThatFitsIsNot) {
  for (const char* fits :
       {"11@1- (0.5,0) [-512|511.5]", "16@1+ (0.1,0) [0|6553.5]", "16@1- (0.01,0) [-327.68|327.67]",
        "8@1+ (1,0) [0|0]", "8@1+ (1,-40) [-40|215]", "64@1+ (1,0) [0|18446744073709551615]",
        "64@1- (1,0) [-9223372036854775808|9223372036854775807]", "1@1+ (1,0) [0|1]",
        "32@1- (1e-07,0) [-90|90]", "8@1+ (-0.5,10) [-117.5|10]"}) {
    EXPECT_EQ(output(std::string(": 0|") + fits + " \"\" A"), "") << fits;
  }
  EXPECT_EQ(output(": 0|32@1- (1,0) [-3.4E+38|3.4E+38] \"\" A", "SIG_VALTYPE_ 100 s : 1;\n"), "");
  EXPECT_EQ(output(": 0|64@1- (1,0) [-1.7E+308|1.7E+308] \"\" A", "SIG_VALTYPE_ 100 s : 2;\n"), "");
}

TEST(DbcRemarks, ARangeWithoutARepresentableValueIsTold) {
  EXPECT_EQ(output(": 0|8@1+ (1,0) [300|400] \"\" A"),
            "signal s: no value that its 8 bits can hold is in the range [300|400]\n");
  EXPECT_EQ(output(": 0|8@1+ (10,0) [12|18] \"\" A"),
            "signal s: no value that its 8 bits can hold is in the range [12|18]\n");
  EXPECT_EQ(output(": 0|8@1+ (-10,0) [12|18] \"\" A"),
            "signal s: no value that its 8 bits can hold is in the range [12|18]\n");
  EXPECT_EQ(output(": 0|8@1+ (1,0) [9|3] \"\" A"), "signal s: the range [9|3] is upside down\n");
}

TEST(DbcRemarks, NamesOfValuesOutsideTheFieldAreTold) {
  EXPECT_EQ(output(": 0|2@1+ (1,0) [0|0] \"\" A", "VAL_ 100 s 3 \"in\" 4 \"out\" -1 \"out\" ;\n"),
            "signal s: VAL_ names values that its 2 bits cannot hold: 4, -1\n");
  EXPECT_EQ(output(": 0|2@1- (1,0) [0|0] \"\" A", "VAL_ 100 s -2 \"in\" 1 \"in\" 2 \"out\" ;\n"),
            "signal s: VAL_ names values that its 2 bits with sign cannot hold: 2\n");
  EXPECT_EQ(output(": 0|64@1- (1,0) [0|0] \"\" A", "VAL_ 100 s -1 \"in\" ;\n"), "");
}

TEST(DbcRemarks, WhatCanNeverHappenIsTold) {
  EXPECT_EQ(
      output("M : 0|2@1+ (1,0) [0|0] \"\" A",
             " SG_ a m4 : 8|8@1+ (1,0) [0|0] \"\" A\n SG_ b m3 : 8|8@1+ (1,0) [0|0] \"\" A\n"),
      "signal a is never present: its multiplexer s has only 2 bits\n");
  EXPECT_EQ(output(": 0|2@1+ (1,0) [0|0] \"\" A", "", 9),
            "message M: no CAN FD frame has 9 bytes\n");
  EXPECT_EQ(output(": 0|2@1+ (1,0) [0|0] \"\" A", "", 12), "");
}

TEST(DbcRemarks, SignalsWithoutReceiversAreTold) {
  for (const char* nobody : {"Vector__XXX", ""}) {
    EXPECT_EQ(output(": 0|2@1+ (1,0) [0|0] \"\" " + std::string(nobody)),
              "signal s: nobody receives it\n");
  }
  EXPECT_EQ(output(": 0|2@1+ (1,0) [0|0] \"\" A", "BO_ 7 Empty: 8 A\n"), "");
  const Database d = parsed(dbc_with(" SG_ s : 0|2@1+ (1,0) [0|0] \"\" Vector__XXX\n"));
  ASSERT_EQ(d.findings.size(), 1U);
  EXPECT_EQ(d.findings[0].kind, FindingKind::kUnreceived);
  EXPECT_EQ(d.findings[0].subject, "M.s");
  EXPECT_EQ(d.findings[0].place, "t.dbc:8:6");
}

TEST(DbcRemarks, NodesThatAreNotListedAreToldOnce) {
  EXPECT_EQ(
      output(": 0|2@1+ (1,0) [0|0] \"\" B,A", "BO_ 7 N: 8 C\nBO_ 8 O: 8 C\nBO_TX_BU_ 8 : D;\n"),
      "receiver B is not listed in BU_\nsender C is not listed in BU_\n"
      "sender D is not listed in BU_\n");
}

}  // namespace
}  // namespace pitwall::can
