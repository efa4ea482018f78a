// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/command/command_table.hpp"

#include <gtest/gtest.h>

#include <set>

namespace pitwall::telemetry {
namespace {

TEST(CommandTable, EveryOutcomeHasItsOwnWords) {
  std::set<std::string_view> texts;
  for (std::size_t i = 0; i < kOutcomes; ++i) texts.insert(text_of(static_cast<Outcome>(i)));
  EXPECT_EQ(texts.size(), kOutcomes);
}

TEST(CommandTable, EveryCommandEndsAndNoStopNeedsOne) {
  for (const CommandRow& row : kCommandTable) {
    EXPECT_GT(row.time_to_live.ns, 0) << row.name;
    EXPECT_LE(row.time_to_live, seconds(5)) << row.name;
    EXPECT_FALSE(row.name.empty());
    // Asking for parameters changes nothing; all that changes the car needs the authority.
    EXPECT_EQ(row.needs_authority, row.type != CommandType::kSendParameters) << row.name;
  }
}

// What has a name is meant; what has none does not exist.
TEST(CommandTable, AValueIsOneThatHasAName) {
  for (const CommandRow& row : kCommandTable) {
    EXPECT_FALSE(row.has(row.min - 1.0)) << row.name;
    EXPECT_FALSE(row.has(row.max + 1.0)) << row.name;
    EXPECT_FALSE(row.has(kUnset)) << row.name;
    if (row.labels.empty()) {
      EXPECT_TRUE(row.has(row.min) && row.has(row.max)) << row.name;
      continue;
    }
    for (std::size_t i = 0; static_cast<double>(i) <= row.max; ++i) {
      const auto argument = static_cast<double>(i);
      const bool named = !label_at(row.labels, i).empty() && label_at(row.labels, i) != "-";
      const bool of_bits = i < std::size_t{1} << label_count(row.labels);
      EXPECT_EQ(row.has(argument), row.is_set() ? of_bits : named) << row.name << " " << i;
      EXPECT_FALSE(row.has(argument + 0.5)) << row.name << " " << i;
    }
  }
  EXPECT_FALSE(row_of(CommandType::kTrackFlag).has(9.0));
  EXPECT_FALSE(row_of(CommandType::kTrackFlag).has(7.0)) << "nobody shows an unknown flag";
  EXPECT_TRUE(row_of(CommandType::kSensorsExcluded).has(511.0));
  EXPECT_FALSE(row_of(CommandType::kSensorsExcluded).has(512.0));
}

}  // namespace
}  // namespace pitwall::telemetry
