// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/gate_table.hpp"

#include <gtest/gtest.h>

namespace pitwall::radio {
namespace {

TEST(GateTable, AFigureAtItsLimitHoldsAndOneAboveDoesNot) {
  const Gate held{"age", "ms", 60.0, 60.0}, missed{"age", "ms", 60.1, 60.0};
  EXPECT_TRUE(held.held());
  EXPECT_FALSE(missed.held());
  EXPECT_NE(line_of(held).find("held"), std::string::npos);
  EXPECT_NE(line_of(missed).find("MISSED"), std::string::npos);
  EXPECT_TRUE(all_held({held, held}));
  EXPECT_FALSE(all_held({held, missed}));
}

TEST(GateTable, WhatIsNoNumberHoldsNothing) {
  EXPECT_FALSE((Gate{"age", "ms", std::stod("nan"), 60.0}.held()));
}

TEST(GateTable, JsonHasARowForEach) {
  const std::string json = json_of({{"a", "ms", 1.0, 2.0}, {"b", "", 3.0, 0.0}});
  EXPECT_NE(json.find("\"what\": \"a\", \"figure\": 1, \"limit\": 2"), std::string::npos) << json;
  EXPECT_NE(json.find("\"held\": false"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::radio
