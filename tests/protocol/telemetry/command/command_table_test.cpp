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

}  // namespace
}  // namespace pitwall::telemetry
