// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/fault_coverage/text.hpp"

#include <gtest/gtest.h>

#include "protocol/json/json_value.hpp"

namespace pitwall::fault_coverage {
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

}  // namespace
}  // namespace pitwall::fault_coverage
