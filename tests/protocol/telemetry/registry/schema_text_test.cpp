// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/registry/schema_text.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/telemetry/registry/schema_listing.hpp"

namespace pitwall::telemetry {
namespace {

TEST(Decimal, SaysANumberInAsFewCharactersAsCanBe) {
  EXPECT_EQ(Decimal{0}.text(), "0");
  EXPECT_EQ(Decimal{-0.0}.text(), "0");
  EXPECT_EQ(Decimal{-20}.text(), "-20");
  EXPECT_EQ(Decimal{0.0004}.text(), "0.0004");
  EXPECT_EQ(Decimal{-3.1416}.text(), "-3.1416");
  EXPECT_EQ(Decimal{4'294'967'293.0}.text(), "4294967293");
  EXPECT_EQ(Decimal{0.000001}.text(), "0.000001");
  EXPECT_EQ(Decimal{100.5}.text(), "100.5");
}

TEST(SchemaText, IsOneLineForTheGroupAndOneForEachField) {
  EXPECT_EQ(group_text(Group::kStop),
            "group stop up safety\n"
            "level - 0 2 1 none|controlled stop|EMERGENCY STOP\n"
            "epoch - 0 253 1\n"
            "reason - 0 14 1 none|operator|race control|pit crew|console lost its operator|test\n");
  EXPECT_EQ(group_text(Group::kFuel),
            "group fuel down health\n"
            "level l 0 102 0.2\n"
            "used l 0 102 0.1\n"
            "flow l/h 0 250 1\n"
            "laps_left - 0 102 0.1\n");
}

}  // namespace
}  // namespace pitwall::telemetry
