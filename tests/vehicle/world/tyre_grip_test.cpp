// SPDX-License-Identifier: Apache-2.0
#include "vehicle/world/tyre_grip.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::world {
namespace {

TEST(TyreGrip, RisesWithTheTemperatureBetweenItsRowsAndUnknownIsCold) {
  const TyreGrip grip;
  EXPECT_TRUE(is_legal(grip));
  double last = 0.0;
  for (double tyre_c = -30.0; tyre_c < 130.0; tyre_c += 0.5) {
    const double share = share_at(grip, tyre_c);
    EXPECT_GE(share, last);
    EXPECT_LE(share - last, last > 0.0 ? 0.02 : 1.0);  // no steps
    last = share;
  }
  for (std::size_t i = 0; i < kTyreRows; ++i)
    EXPECT_DOUBLE_EQ(share_at(grip, grip.temperature_c[i]), grip.share[i]);
  EXPECT_EQ(share_at(grip, kUnset), grip.cold());
  EXPECT_EQ(last, 1.0);
}

TEST(TyreGrip, TheColdestTyreCountsAndAnyThatIsNotKnownMakesAllUnknown) {
  const Instant now = Instant{} + seconds(100);
  Received<PerWheel> tyres{{{80.0, 41.0, 79.0, 90.0}}, now, true};
  EXPECT_EQ(coldest_c(tyres, now), 41.0);
  EXPECT_EQ(coldest_c(tyres, now + kTyreAgeMax), 41.0);
  EXPECT_TRUE(std::isnan(coldest_c(tyres, now + kTyreAgeMax + milliseconds(1))));
  tyres.value.at[3] = kUnset;
  EXPECT_TRUE(std::isnan(coldest_c(tyres, now)));
  EXPECT_TRUE(std::isnan(coldest_c({}, now)));
}

TEST(TyreGrip, ATableThatFallsIsRefused) {
  TyreGrip grip;
  grip.share[2] = 0.1;
  EXPECT_FALSE(is_legal(grip));
  grip = {};
  grip.temperature_c[1] = 20.0;
  EXPECT_FALSE(is_legal(grip));
}

}  // namespace
}  // namespace pitwall::world
