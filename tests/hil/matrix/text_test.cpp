// SPDX-License-Identifier: Apache-2.0
#include "hil/matrix/text.hpp"

#include <gtest/gtest.h>

#include "protocol/json/json_value.hpp"

namespace pitwall::matrix {
namespace {

TEST(MatrixText, ListsForPeopleAndForJson) {
  EXPECT_EQ(list_of({}), "");
  EXPECT_EQ(list_of({"F01", "F02"}), "F01, F02");
  EXPECT_EQ(json_list({}), "[]");
  EXPECT_EQ(json_list({"F01", "F02"}), R"(["F01", "F02"])");
}

TEST(MatrixText, AListLosesNothingThatJsonEscapes) {
  const std::string odd = "a \"b\" \\ c\n\x01";
  const auto list = json::JsonValue::parse("{\"words\": " + json_list({odd}) + "}", "list");
  ASSERT_TRUE(list) << to_string(list.error());
  EXPECT_EQ(list->items("words").at(0).text(), odd);
}

TEST(MatrixText, FormatIsPrintf) {
  EXPECT_EQ(format("%-4s|%6.2f", "ab", 1.5), "ab  |  1.50");
  EXPECT_EQ(format("%s", std::string(2000, 'x').c_str()).size(), 639u) << "cut, not overrun";
}

}  // namespace
}  // namespace pitwall::matrix
