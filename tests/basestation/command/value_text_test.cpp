// SPDX-License-Identifier: Apache-2.0
#include "basestation/command/value_text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace pitwall::command {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

TEST(ValueText, SaysANumberWithItsUnitOrThatThereIsNone) {
  EXPECT_EQ(number(12.34, "m/s"), "12.3 m/s");
  EXPECT_EQ(number(-0.06, "V"), "-0.1 V");
  EXPECT_EQ(number(6.0, ""), "6.0");
  EXPECT_EQ(number(kUnknown, "m/s"), "no data");
}

TEST(ValueText, SaysALabelWhereTheValueHasOne) {
  EXPECT_EQ(label("red|orange", 1.0), "orange");
  EXPECT_EQ(label("red|orange", 2.0), "no. 2");
  EXPECT_EQ(label("red|orange", -1.0), "no data");
  EXPECT_EQ(label("red|orange", kUnknown), "no data");
}

}  // namespace
}  // namespace pitwall::command
