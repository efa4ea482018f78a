// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/station_field.hpp"

#include <gtest/gtest.h>

#include <set>

#include "protocol/telemetry/registry/titles.hpp"

namespace pitwall::state {
namespace {

TEST(BaseField, PathAndIdAreInverse) {
  std::set<std::string> paths;
  for (unsigned id = 0; id < kFirstBaseField + kBaseFields + 10; ++id) {
    const auto field = static_cast<FieldId>(id);
    if (!is_field(field)) {
      EXPECT_EQ(path_of(field), "");
      continue;
    }
    EXPECT_EQ(find_field(path_of(field)), field) << path_of(field);
    EXPECT_TRUE(paths.insert(path_of(field)).second) << "twice: " << path_of(field);
  }
  EXPECT_EQ(paths.size(), telemetry::kFieldCount + kBaseFields);
}

TEST(BaseField, WhatIsNoFieldHasNoId) {
  for (const char* const path :
       {"", ".", "ego", "ego.", ".x", "ego.x.y", "derived", "derived.sli"}) {
    EXPECT_FALSE(find_field(path)) << path;
  }
}

TEST(BaseField, RowsHaveSensibleRangesAndLabels) {
  for (const BaseRow& row : kBaseTable) {
    EXPECT_LT(row.min, row.max) << row.name;
    EXPECT_GT(row.resolution, 0.0) << row.name;
    if (row.labels.empty()) continue;
    EXPECT_FALSE(telemetry::label_at(row.labels, static_cast<std::size_t>(row.max)).empty())
        << row.name;
  }
}

TEST(BaseField, NoTwoFieldsHaveOneTitle) {
  std::set<std::string> titles;
  for (const telemetry::FieldRow& row : telemetry::kFields)
    titles.insert(telemetry::title_of(telemetry::row_of(row.group).name, row.name));
  ASSERT_EQ(titles.size(), telemetry::kFieldCount);
  for (const BaseRow& row : kBaseTable) {
    const std::string title = telemetry::title_of(row.group, row.name);
    EXPECT_FALSE(title.empty()) << row.name;
    EXPECT_EQ(title.find_first_of("_."), std::string::npos) << title;
    EXPECT_TRUE(titles.insert(title).second) << "twice: " << title;
  }
}

TEST(BaseField, EveryPathWithATitleOfItsOwnIsAField) {
  for (const telemetry::FieldTitle& row : telemetry::kTitles)
    EXPECT_TRUE(find_field(row.path)) << row.path;
}

}  // namespace
}  // namespace pitwall::state
