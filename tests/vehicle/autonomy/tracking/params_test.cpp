// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/params.hpp"

#include <gtest/gtest.h>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::tracking {
namespace {

TEST(TrackingParams, ThoseOfTheHeaderAreLegal) { EXPECT_TRUE(checked(Params{}).has_value()); }

// Each one outside of its range is named.
TEST(TrackingParams, IllegalOneIsNamed) {
  const auto place = [](const Params& p) { return checked(p).error().place; };
  for (const auto& r : kRanges)
    for (const double v : {r.most * 1.01 + 1.0, r.least - 1.0, kUnset}) {
      Params p;
      p.*r.value = v;
      ASSERT_FALSE(checked(p).has_value()) << r.name;
      EXPECT_EQ(place(p), r.name);
    }
  for (const auto& r : kRoadRanges)
    for (const double v : {r.most * 1.01 + 1.0, r.least - 1.0, kUnset}) {
      Params p;
      p.road.*r.value = v;
      ASSERT_FALSE(checked(p).has_value()) << r.name;
      EXPECT_EQ(place(p), std::string("road.") + r.name);
    }
  for (const auto& r : kPaperRanges)
    for (const double v : {r.most * 1.01 + 1.0, r.least - 1.0, kUnset}) {
      Params p;
      p.paper.*r.value = v;
      ASSERT_FALSE(checked(p).has_value()) << r.name;
      EXPECT_EQ(place(p), std::string("paper.") + r.name);
    }
}

}  // namespace
}  // namespace pitwall::tracking
