// SPDX-License-Identifier: Apache-2.0
#include "hil/report/sweep/parameter_axis.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::report {
namespace {

TEST(ParameterAxis, ARangeHasEqualPartsWithBothEnds) {
  const ParameterAxis axis{{.path = "a", .from = -4.0, .to = 4.0}};
  ASSERT_EQ(axis.bins().size(), kBins);
  EXPECT_EQ(axis.bins().front(), "-4 to -3");
  EXPECT_EQ(axis.bins().back(), "3 to 4");
  EXPECT_EQ(axis.bin_of("-4"), 0U);
  EXPECT_EQ(axis.bin_of("-3.0001"), 0U);
  EXPECT_EQ(axis.bin_of("-3"), 1U);
  EXPECT_EQ(axis.bin_of("3.9999"), 7U);
  EXPECT_EQ(axis.bin_of("4"), 7U) << "a drawn value may be rounded up to the end";
  EXPECT_TRUE(axis.is_numeric() && axis.varies());
}

TEST(ParameterAxis, AListHasItsValues) {
  const ParameterAxis axis{{.path = "a", .values = {"0", "8", "2"}}};
  EXPECT_EQ(axis.bins(), (std::vector<std::string>{"0", "8", "2"}));
  EXPECT_EQ(axis.bin_of("8"), 1U);
  EXPECT_EQ(axis.from(), 0.0);
  EXPECT_EQ(axis.to(), 8.0);
}

TEST(ParameterAxis, OfALongListNeighboursAreTogetherAndNoneIsLost) {
  std::vector<std::string> values;
  for (int i = 0; i < 19; ++i) values.push_back("v" + std::to_string(i));
  const ParameterAxis axis{{.path = "a", .values = values}};
  ASSERT_EQ(axis.bins().size(), kBins);
  std::size_t last = 0;
  for (const std::string& value : values) {
    const std::size_t bin = axis.bin_of(value);
    EXPECT_TRUE(bin == last || bin == last + 1) << value;
    last = bin;
  }
  EXPECT_EQ(last, kBins - 1);
  EXPECT_EQ(axis.bins().front(), "v0 to v1");
}

TEST(ParameterAxis, WhatHasNoDifferentNumbersIsNotNumeric) {
  EXPECT_FALSE((ParameterAxis{{.path = "a", .values = {"1", "x"}}}.is_numeric()));
  EXPECT_FALSE((ParameterAxis{{.path = "a", .values = {"1", "1.0"}}}.is_numeric()));
  EXPECT_FALSE((ParameterAxis{{.path = "a", .values = {"1"}}}.varies()));
}

TEST(ParameterAxis, ATextIsANumberAsAWholeOrNot) {
  EXPECT_EQ(number_of("-1.5e3"), -1500.0);
  for (const char* text : {"", "1x", "x1", "nan", "inf", "1e999"})
    EXPECT_TRUE(std::isnan(number_of(text))) << text;
}

TEST(ParameterAxis, AValueOfAnotherParameterIsInTheLastBin) {
  const ParameterAxis axis{{.path = "a", .from = 0.0, .to = 1.0}};
  EXPECT_EQ(axis.bin_of("none"), kBins - 1);
}

}  // namespace
}  // namespace pitwall::report
