// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/console/catalogue_text.hpp"

#include <gtest/gtest.h>

#include <set>

#include "basestation/publishers/console/snapshots.hpp"
#include "protocol/json/json_value.hpp"
#include "protocol/telemetry/command/command_table.hpp"

namespace pitwall::publishers::console {
namespace {

TEST(Catalogue, HasEveryFieldOnceWithItsLimits) {
  const alarms::Limits limits;
  const auto catalogue = json::JsonValue::parse(
      catalogue_text([&](state::FieldId id) -> const alarms::Limit& { return limits.of(id); }, 3),
      "catalogue");
  ASSERT_TRUE(catalogue);
  EXPECT_EQ(catalogue->text("type"), "catalogue");
  std::set<double> ids;
  std::set<std::string> paths, titles;
  bool limited = false;
  for (const json::JsonValue& field : catalogue->items("fields")) {
    ids.insert(field.number("id"));
    paths.insert(field.text("path"));
    titles.insert(field.text("title"));
    EXPECT_EQ(field.text("path"), field.text("group") + "." + field.text("name"));
    EXPECT_GT(field.number("period_ms"), 0.0);
    limited = limited || field.find("limits")->is_object();
  }
  EXPECT_EQ(ids.size(), reported_fields().size());
  EXPECT_EQ(paths.size(), reported_fields().size());
  EXPECT_EQ(titles.size(), reported_fields().size());
  EXPECT_TRUE(titles.contains("speed") && titles.contains("link round trip"));
  EXPECT_TRUE(limited);
  EXPECT_TRUE(paths.contains("ego.x") && paths.contains("link.state"));
  EXPECT_FALSE(paths.contains("stop.level")) << "what goes up is no field of the car";
  EXPECT_EQ(catalogue->items("commands").size(), telemetry::kCommandTypes);
  EXPECT_EQ(catalogue->find("race")->number("attempt_laps"), 3);
  EXPECT_EQ(catalogue->find("race")->number("pass_gap_m"), 30);
}

}  // namespace
}  // namespace pitwall::publishers::console
