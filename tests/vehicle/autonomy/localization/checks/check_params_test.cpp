// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/checks/check_params.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::localization {
namespace {

TEST(CheckParams, TheDefaultsAreLegal) { EXPECT_FALSE(illegal(CheckParams{})); }

TEST(CheckParams, EveryLimitHasItsRangeOnce) {
  std::set<std::string> names;
  for (const auto& range : kCheckRanges) {
    EXPECT_TRUE(names.emplace(range.name).second) << range.name;
    EXPECT_LT(range.least, range.most) << range.name;
  }
  EXPECT_EQ(sizeof(CheckParams), kCheckRanges.size() * sizeof(double)) << "a limit has no range";
}

TEST(CheckParams, WhatIsOutsideIsNamed) {
  for (const auto& range : kCheckRanges) {
    for (const double bad :
         {range.least - 1e-6, range.most + 1e-6, kUnset, std::numeric_limits<double>::infinity()}) {
      CheckParams params;
      params.*range.value = bad;
      const auto problem = illegal(params);
      ASSERT_TRUE(problem) << range.name << " " << bad;
      EXPECT_EQ(problem->place, "checks." + std::string{range.name});
    }
    for (const double good : {range.least, range.most}) {
      CheckParams params;
      params.*range.value = good;
      EXPECT_FALSE(illegal(params)) << range.name;
    }
  }
}

}  // namespace
}  // namespace pitwall::localization
