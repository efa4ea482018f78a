// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/registry/registry.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "protocol/telemetry/state_packet.hpp"

namespace pitwall::telemetry {
namespace {

TEST(Registry, EveryPathIsUnique) {
  std::set<std::string> paths;
  for (const FieldRow& row : kFields) {
    const std::string path = std::string{row_of(row.group).name} + "." + std::string{row.name};
    EXPECT_TRUE(paths.insert(path).second) << path;
  }
}

TEST(Registry, AFieldIsFoundByItsPath) {
  EXPECT_EQ(kFields[field("ego.x")].name, "x");
  EXPECT_EQ(kFields[field("feedback.gear")].group, Group::kFeedback);
  EXPECT_EQ(kFields[field("command.gear")].group, Group::kCommand);
}

TEST(Registry, EveryGroupHasAField) {
  std::set<Group> groups;
  for (const FieldRow& row : kFields) groups.insert(row.group);
  EXPECT_EQ(groups.size(), kGroups);
}

TEST(Registry, BitsOfTheGroupsAddUp) {
  std::size_t bits = 0;
  for (const FieldRow& row : kFields) bits += row.quantized().bits();
  EXPECT_EQ(bits_of(groups_of(Direction::kDown)) + bits_of(groups_of(Direction::kUp)), bits);
  EXPECT_EQ(bits_of(GroupSet{}), 0U);
}

TEST(Registry, LabelsFitTheRangeOfTheirField) {
  for (const FieldRow& row : kFields) {
    if (row.labels.empty()) continue;
    std::size_t labels = 1;
    for (const char c : row.labels) labels += c == '|' ? 1 : 0;
    EXPECT_EQ(row.resolution, 1.0) << row.name;
    EXPECT_LE(static_cast<double>(labels - 1), row.max) << row.name;
  }
}

TEST(Registry, ValuesBeginUnset) {
  const Values values;
  for (FieldIndex i = 0; i < kFieldCount; ++i) EXPECT_TRUE(std::isnan(values[i]));
}

}  // namespace
}  // namespace pitwall::telemetry
