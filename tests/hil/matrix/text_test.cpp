// SPDX-License-Identifier: Apache-2.0
#include "hil/matrix/text.hpp"

#include <gtest/gtest.h>

namespace pitwall::matrix {
namespace {

TEST(MatrixText, ListsForPeopleAndForJson) {
  EXPECT_EQ(list_of({}), "");
  EXPECT_EQ(list_of({"F01", "F02"}), "F01, F02");
  EXPECT_EQ(json_list({}), "[]");
  EXPECT_EQ(json_list({"F01", "F02"}), R"(["F01","F02"])");
}

TEST(MatrixText, AQuotedTextHasNothingThatJsonWouldEscape) {
  EXPECT_EQ(in_quotes("a \"b\" \\ c\n"), "\"a  b    c \"");
}

TEST(MatrixText, FormatIsPrintf) {
  EXPECT_EQ(format("%-4s|%6.2f", "ab", 1.5), "ab  |  1.50");
  EXPECT_EQ(format("%s", std::string(2000, 'x').c_str()).size(), 639u) << "cut, not overrun";
}

}  // namespace
}  // namespace pitwall::matrix
