// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/dbc/dbc_table.hpp"

#include <gtest/gtest.h>

#include "protocol/can/dbc_parser.hpp"

namespace pitwall::cli {
namespace {

TEST(DbcTable, SaysEverythingThatDecidesAValue) {
  const auto d = can::parse_dbc(
      "BU_: A B\nBO_ 2147484160 M: 8 A\n"
      " SG_ mode M : 0|8@1+ (1,0) [0|0] \"\" B\n"
      " SG_ temperature m1 : 15|16@0- (0.1,-40) [-40|215] \"\xB0"
      "C\" B\n"
      " SG_ f m2 : 8|32@1- (1,0) [0|0] \"\" B\n"
      "BA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 1000;\nBA_ \"GenMsgCycleTime\" BO_ 2147484160 20;\n"
      "BO_TX_BU_ 2147484160 : A,B;\nVAL_ 2147484160 mode 1 \"warm\" 2 \"float\" ;\n"
      "SIG_VALTYPE_ 2147484160 f : 1;\nSG_MUL_VAL_ 2147484160 temperature mode 1-1, 4-6;\n"
      "SIG_GROUP_ 2147484160 G 1 : mode;\n",
      "t.dbc");
  ASSERT_TRUE(d) << to_string(d.error());
  const std::string text = table_of(*d);
  EXPECT_TRUE(
      text.starts_with("t.dbc: 1 messages, 3 signals, 2 nodes; 1 sections unused; "
                       "fingerprint 0x"))
      << text;
  for (const char* line :
       {"\nM  id 512 (0x200, extended)  8 bytes  20 ms  from A, B\n",
        "\n  mode         0|8 Intel       unsigned  x1        -              multiplexer\n"
        "      1 warm, 2 float\n",
        "\n  temperature  15|16 Motorola  signed    x0.1 -40  [-40|215]  \u00B0C  while mode is 1, "
        "4-6\n",
        "\n  f            8|32 Intel      float     x1        -              while mode is 2\n",
        "\nunused sections\n  t.dbc:12:1: SIG_GROUP_ 2147484160 G 1 : mode;\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
  }
}

// What an error is about is marked, what was left out is told below its message.
TEST(DbcTable, MarksWhatIsBad) {
  const auto d = can::parse_dbc_leniently(
      "BU_: A\nBO_ 1 M: 8 A\n SG_ a : 0|8@1+ (1,0) [0|0] \"\" A\n SG_ b : 4|8@1+ (1,0) [0|0] "
      "\"\" A\n SG_ c : 60|8@1+ (1,0) [0|0] \"\" A\nBO_ 2147483650 L: 300 A\nVERSION x\n",
      "t.dbc");
  ASSERT_TRUE(d) << to_string(d.error());
  const std::string text = table_of(*d);
  for (const char* line :
       {"; 4 errors\n", "\n! a  0|8 Intel", "\n! b  4|8 Intel",
        "\n! t.dbc:5:6: signal c lies outside the 8 bytes of message M; the signal is left out\n",
        "\n! t.dbc:4:6: signal b overlaps signal a defined at t.dbc:3:6; all are kept\n",
        "300 bytes, not on a CAN frame (J1939 transport)  period not given",
        "\nerrors outside of these messages\n! t.dbc:7:9: expected '\"'; the text up to the next "
        "statement is left out\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
  }
}

}  // namespace
}  // namespace pitwall::cli
