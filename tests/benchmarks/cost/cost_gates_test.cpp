// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/cost/cost_gates.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "protocol/json/json_value.hpp"

namespace pitwall::cost {
namespace {

CostGate gate(double cost_us, double unit_us, double limit_us) {
  return {.what = "a step", .cost_us = cost_us, .unit_us = unit_us, .limit_us = limit_us};
}

TEST(CostGate, IsTheRequirementItselfOnItsOwnMachine) {
  EXPECT_TRUE(gate(100.0, kReferenceUnit_us, 100.0).held());
  EXPECT_FALSE(gate(100.1, kReferenceUnit_us, 100.0).held());
}

TEST(CostGate, AsksTheSameWorkOfEveryMachine) {
  for (const double slower : {0.1, 0.5, 1.0, 1.7, 20.0}) {
    const double unit_us = slower * kReferenceUnit_us;
    EXPECT_TRUE(gate(slower * 99.0, unit_us, 100.0).held()) << slower;
    EXPECT_FALSE(gate(slower * 101.0, unit_us, 100.0).held()) << slower;
    EXPECT_NEAR(gate(slower * 99.0, unit_us, 100.0).units(), limit_units(99.0), 1e-9);
  }
}

TEST(CostGate, WhatWasNotMeasuredIsNotHeld) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(gate(0.0, 50.0, 100.0).held());
  EXPECT_FALSE(gate(10.0, 0.0, 100.0).held());
  EXPECT_FALSE(gate(kNan, 50.0, 100.0).held());
  EXPECT_FALSE(gate(10.0, kNan, 100.0).held());
  EXPECT_FALSE(gate(std::numeric_limits<double>::infinity(), 50.0, 100.0).held());
}

TEST(CostGates, HoldExactlyWhereEachDoes) {
  CostGates gates;
  EXPECT_FALSE(gates.held()) << "nothing was judged";
  gates.at_most(gate(10.0, 50.0, 100.0));
  gates.count("no allocation", true);
  EXPECT_TRUE(gates.held());
  CostGates slow = gates, heavy = gates;
  slow.at_most(gate(1000.0, 50.0, 100.0));
  heavy.count("no allocation", false);
  EXPECT_FALSE(slow.held());
  EXPECT_FALSE(heavy.held());
  slow.count("one more", true);
  EXPECT_FALSE(slow.held());
}

TEST(CostGates, SayWhatWasMeasuredAndWhatWasAsked) {
  CostGates gates;
  gates.at_most(gate(25.0, 50.0, 48.9));
  gates.at_most(gate(75.0, 50.0, 48.9));
  gates.count("no allocation", true);
  EXPECT_EQ(gates.text(),
            "gate: a step: 0.500 reference units, at most 1.000 (48.9 us on the reference machine)"
            ": held\n"
            "gate: a step: 1.500 reference units, at most 1.000 (48.9 us on the reference machine)"
            ": MISSED\n"
            "gate: no allocation: held\n");
  const auto rows = json::JsonValue::parse(gates.json(), "gates");
  ASSERT_TRUE(rows) << to_string(rows.error());
  ASSERT_EQ(rows->items().size(), 3u);
  EXPECT_EQ(rows->items()[0].number("units"), 0.5);
  EXPECT_EQ(rows->items()[1].number("limit_units"), 1.0);
  EXPECT_FALSE(rows->items()[1].flag("held"));
  EXPECT_EQ(rows->items()[2].text("gate"), "no allocation");
}

}  // namespace
}  // namespace pitwall::cost
