// SPDX-License-Identifier: Apache-2.0
#include "basestation/inputs/command_script.hpp"

#include <gtest/gtest.h>

namespace pitwall::inputs {
namespace {

TEST(CommandScript, SaysEachLineOnceWhenItIsDue) {
  auto script = CommandScript::parse(
      "# a comment\n\n0 take 1\n  1.5\tcommand speed_limit 30\n1.5 stop controlled\r\n", "f");
  ASSERT_TRUE(script) << to_string(script.error());
  EXPECT_EQ(script->due(), Duration{});
  EXPECT_EQ(script->next({}), " take 1");
  EXPECT_EQ(script->next(milliseconds(1'499)), std::nullopt);
  EXPECT_EQ(script->due(), milliseconds(1'500));
  EXPECT_EQ(script->next(seconds(2)), "\tcommand speed_limit 30");
  EXPECT_EQ(script->next(seconds(2)), " stop controlled\r");
  EXPECT_EQ(script->next(seconds(9)), std::nullopt);
  EXPECT_EQ(script->due(), std::nullopt);
}

TEST(CommandScript, EveryMistakeIsFoundBeforeAnythingIsSaid) {
  const struct {
    const char *text, *place;
  } cases[] = {{"take 1", "f:1"},          {"1 take 1\n-1 take 1", "f:2"},
               {"1 fly", "f:1"},           {"2 take 1\n# later\n1 take 1", "f:3"},
               {"nan take 1", "f:1"},      {"1e9 take 1", "f:1"},
               {"1 command arm 3", "f:1"}, {"1", "f:1"}};
  for (const auto& c : cases) {
    const auto script = CommandScript::parse(c.text, "f");
    ASSERT_FALSE(script) << c.text;
    EXPECT_EQ(script.error().place, c.place) << c.text;
  }
}

}  // namespace
}  // namespace pitwall::inputs
