// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/foxglove/thresholds.hpp"

#include <gtest/gtest.h>

namespace pitwall::publishers::foxglove {
namespace {

TEST(FoxgloveThresholds, AreNumbersOfEachAlarm) {
  const auto thresholds = thresholds_of(
      R"({"type": "settings", "alarms": [{"key": "slip", "limit": 8, "deadband": null,)"
      R"( "on_s": 0.5, "off_s": 2}, {"limit": 3}]})");
  EXPECT_EQ(thresholds,
            (std::vector<Parameter>{
                {"/alarms/slip/limit", 8}, {"/alarms/slip/on_s", 0.5}, {"/alarms/slip/off_s", 2}}));
}

TEST(FoxgloveThresholds, OfNoSettingsThereAreNone) {
  for (const char* const text : {"", "{", "[]", R"({"alarms": 7})", R"({"alarms": [7, null]})"})
    EXPECT_TRUE(thresholds_of(text).empty()) << text;
}

}  // namespace
}  // namespace pitwall::publishers::foxglove
