// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/registry/schema.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "protocol/telemetry/registry/schema_listing.hpp"
#include "tests/protocol/telemetry/registry/hash_of.hpp"

namespace pitwall::telemetry {
namespace {

// http://www.isthe.com/chongo/tech/comp/fnv/
TEST(SchemaHash, IsFnv1aOf64Bits) {
  EXPECT_EQ(hash_of(""), 0xCBF29CE484222325U);
  EXPECT_EQ(hash_of("a"), 0xAF63DC4C8601EC8CU);
  EXPECT_EQ(hash_of("foobar"), 0x85944171F73967E8U);
}

TEST(Schema, HashesAreThoseOfTheCanonicalTexts) {
  std::set<std::uint64_t> hashes;
  for (const GroupRow& row : kGroupTable) {
    EXPECT_EQ(group_hash(row.group), hash_of(group_text(row.group))) << row.name;
    hashes.insert(group_hash(row.group));
  }
  EXPECT_EQ(hashes.size(), kGroups);
  EXPECT_EQ(kSafetyHash, hash_of(safety_text()));
  EXPECT_EQ(kSchemaHash, hash_of(schema_text()));
}

// Codes of stop reasons and causes stand in the table of this program, in the order in which they
// are written, and both ends compare the table before they believe a code. Peers read them from
// their sources when they start: there two checkouts give two meanings, and nobody notices.
TEST(Schema, CodesCannotShiftBetweenTwoCheckoutsUnnoticed) {
  const std::string here = safety_text();
  for (const std::string_view labels : {kStopReasons, kStopCauses, kModes, kTrackFlags}) {
    const std::size_t at = here.find(labels);
    ASSERT_NE(at, std::string::npos) << labels;
    std::string shifted = here;
    shifted.insert(at + labels.find('|') + 1, "a new one|");
    EXPECT_NE(hash_of(shifted), kSafetyHash) << labels;
  }
}

}  // namespace
}  // namespace pitwall::telemetry
