// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/value_text.hpp"

#include <gtest/gtest.h>

#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::state {
namespace {

using telemetry::field;
using telemetry::kFields;

TEST(ValueText, NumbersHaveTheDecimalsOfTheirResolution) {
  EXPECT_EQ(value_text(kFields[field("ego.x")], -12.345), "-12.35");
  EXPECT_EQ(value_text(kFields[field("engine.speed")], 6'005.0), "6005");
  EXPECT_EQ(value_text(kFields[field("electric.battery")], 13.8), "13.8");
  EXPECT_EQ(value_text(kFields[field("ego.yaw")], 1.5), "1.5000");
}

TEST(ValueText, EnumeratedValuesHaveNamesAndStrangeOnesTheirNumber) {
  EXPECT_EQ(value_text(kFields[field("mode.mode")], 2.0), "driving");
  EXPECT_EQ(value_text(kFields[field("flags.track")], 1.0), "RED");
  EXPECT_EQ(value_text(kFields[field("mode.ct_state")], 255.0), "255");
}

TEST(ValueText, SetsOfFaultsAreNamedUpToThree) {
  const telemetry::FieldRow& faults = kFields[field("faults.now")];
  EXPECT_EQ(value_text(faults, 0.0), "none");
  EXPECT_EQ(value_text(faults, 0b1001), "operator: emergency stop, drive-by-wire: system failure");
  EXPECT_EQ(
      value_text(faults, 0b1'1111),
      "operator: emergency stop, purple flag, CAN bus dead: the drive-by-wire is silent and 2 "
      "more");
  EXPECT_EQ(value_text(kFields[field("electric.diagnostics")], 5.0), "5");
}

TEST(ValueText, UnsetIsADash) { EXPECT_EQ(value_text(kFields[field("ego.x")], kUnset), "-"); }

TEST(ValueText, PathsAreGroupAndName) { EXPECT_EQ(path_of(kFields[field("ego.vx")]), "ego.vx"); }

TEST(ValueText, SaysANumberWithItsUnitOrThatThereIsNone) {
  EXPECT_EQ(number_text(12.34, "m/s"), "12.3 m/s");
  EXPECT_EQ(number_text(-0.06, "V"), "-0.1 V");
  EXPECT_EQ(number_text(6.0, ""), "6.0");
  EXPECT_EQ(number_text(kUnset, "m/s"), "no data");
}

TEST(ValueText, SaysALabelWhereTheValueHasOne) {
  EXPECT_EQ(label_text("red|orange", 1.0), "orange");
  EXPECT_EQ(label_text("red|orange", 2.0), "no. 2");
  EXPECT_EQ(label_text("red|orange", -1.0), "no data");
  EXPECT_EQ(label_text("red|orange", kUnset), "no data");
}

}  // namespace
}  // namespace pitwall::state
