// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/registry/schema_listing.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/telemetry/registry/schema.hpp"

namespace pitwall::telemetry {
namespace {

TEST(SchemaListing, ReadsBackWhatTheRegistrySays) {
  const Listing listing = read_listing(schema_text());
  EXPECT_EQ(listing.bad_lines, 0U);
  ASSERT_EQ(listing.groups.size(), kGroups + 1);
  FieldIndex i = 0;
  for (const GroupRow& row : kGroupTable) {
    const ListedGroup& group = listing.groups[index_of(row.group)];
    EXPECT_EQ(group.name, row.name);
    EXPECT_EQ(group.direction, text_of(row.direction));
    EXPECT_EQ(group.priority, text_of(row.priority));
    for (const ListedField& field : group.fields) {
      EXPECT_EQ(field.name, kFields[i].name);
      EXPECT_EQ(field.unit, kFields[i].unit.empty() ? "-" : kFields[i].unit);
      EXPECT_EQ(std::stod(field.min), kFields[i].min) << field.name;
      EXPECT_EQ(std::stod(field.max), kFields[i].max) << field.name;
      EXPECT_EQ(std::stod(field.resolution), kFields[i].resolution) << field.name;
      for (std::size_t k = 0; k < field.labels.size(); ++k)
        EXPECT_EQ(field.labels[k], label_at(kFields[i].labels, k));
      EXPECT_TRUE(label_at(kFields[i].labels, field.labels.size()).empty());
      ++i;
    }
  }
  EXPECT_EQ(i, kFieldCount);
  ASSERT_EQ(listing.groups.back().name, "commands");
  EXPECT_EQ(listing.groups.back().fields.size(), kCommandTypes);
}

TEST(SchemaListing, CountsLinesThatAreNone) {
  const Listing listing =
      read_listing("x m 0 1 1\ngroup a down\ngroup b up safety\ny m 0 1\nz m 0 1 1");
  EXPECT_EQ(listing.bad_lines, 3U);
  EXPECT_EQ(listing.first_bad_line, 1U);
  ASSERT_EQ(listing.groups.size(), 1U);
  ASSERT_EQ(listing.groups[0].fields.size(), 1U);
  EXPECT_EQ(listing.groups[0].fields[0].name, "z");
}

}  // namespace
}  // namespace pitwall::telemetry
