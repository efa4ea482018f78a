// SPDX-License-Identifier: Apache-2.0
#include "protocol/vocabulary/result.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace pitwall {
namespace {

Result<int, Problem> parse_digit(char c) {
  if (c < '0' || c > '9') return Unexpected{Problem{"line 1", "not a digit"}};
  return c - '0';
}

TEST(Result, HoldsEitherTheValueOrTheReason) {
  EXPECT_EQ(*parse_digit('7'), 7);
  const auto refused = parse_digit('x');
  ASSERT_FALSE(refused);
  EXPECT_EQ(to_string(refused.error()), "line 1: error: not a digit");
  EXPECT_EQ(refused.value_or(-1), -1);
}

TEST(Result, MovesAValueThatCannotBeCopied) {
  Result<std::unique_ptr<int>, Problem> made{std::make_unique<int>(3)};
  const std::unique_ptr<int> taken = *std::move(made);
  EXPECT_EQ(*taken, 3);
}

// A large value is made where it stays.
TEST(Result, MakesAValueInItsPlace) {
  struct Pinned {
    Pinned() = default;
    Pinned(const Pinned&) = delete;
    int value = 7;
  };
  const Result<Pinned, Problem> made{std::in_place};
  EXPECT_EQ(made->value, 7);
}

TEST(ResultDeathTest, TheWrongSideIsOurOwnMistake) {
  EXPECT_DEATH(static_cast<void>(parse_digit('x').value()), "CHECK failed");
  EXPECT_DEATH(static_cast<void>(parse_digit('1').error()), "CHECK failed");
}

}  // namespace
}  // namespace pitwall
