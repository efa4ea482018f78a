// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/messages/checklist_text.hpp"

#include <gtest/gtest.h>

#include "protocol/json/json_value.hpp"

namespace pitwall::service {
namespace {

using command::Check;
using command::CheckKind;

TEST(ChecklistText, HasEveryItemAndGoesWhenAllDo) {
  std::vector<Check> checks{{.kind = CheckKind::kLink,
                             .go = true,
                             .known = true,
                             .age = milliseconds(20),
                             .text = "good, 1.2 % lost"},
                            {.kind = CheckKind::kFuel,
                             .go = false,
                             .known = false,
                             .age = milliseconds(8'400),
                             .text = "too old"}};
  const auto text = json::JsonValue::parse(checklist_text(checks, {2'500'000'000}), "text");
  ASSERT_TRUE(text);
  EXPECT_EQ(text->text("type"), "checklist");
  EXPECT_EQ(text->number("time_ms"), 2'500.0);
  EXPECT_FALSE(text->flag("go"));
  const auto& items = text->items("checks");
  ASSERT_EQ(items.size(), 2U);
  EXPECT_EQ(items[0].text("name"), "link");
  EXPECT_TRUE(items[0].flag("go") && items[0].flag("known"));
  EXPECT_EQ(items[0].text("text"), "good, 1.2 % lost");
  EXPECT_EQ(items[1].number("age_ms"), 8'400.0);
  EXPECT_FALSE(items[1].flag("go") || items[1].flag("known"));
  checks.pop_back();
  EXPECT_TRUE(json::JsonValue::parse(checklist_text(checks, {}), "text")->flag("go"));
  EXPECT_FALSE(json::JsonValue::parse(checklist_text({}, {}), "text")->flag("go"));
}

}  // namespace
}  // namespace pitwall::service
