// SPDX-License-Identifier: Apache-2.0
#include "hil/track_file/periodic_table.hpp"

#include <gtest/gtest.h>

namespace pitwall::track_file {
namespace {

// 100 m round: 2 at 10 m, 6 at 50 m, 4 at 90 m; so 3 at 0 m.
PeriodicTable table() { return {100.0, {{50.0, 6.0}, {10.0, 2.0}, {-10.0, 4.0}}}; }

TEST(PeriodicTable, IsStraightBetweenEntriesAndClosed) {
  for (const double laps_m : {-300.0, 0.0, 700.0}) {
    EXPECT_NEAR(table().at(10.0 + laps_m), 2.0, 1e-12);
    EXPECT_NEAR(table().at(30.0 + laps_m), 4.0, 1e-12);
    EXPECT_NEAR(table().at(70.0 + laps_m), 5.0, 1e-12);
    EXPECT_NEAR(table().at(0.0 + laps_m), 3.0, 1e-12);
    EXPECT_NEAR(table().at(95.0 + laps_m), 3.5, 1e-12);
  }
}

TEST(PeriodicTable, MeanOfAStraightPieceIsItsMiddle) {
  EXPECT_NEAR(table().mean(20.0, 40.0), 4.0, 1e-9);
  EXPECT_NEAR(table().mean(-5.0, 5.0), 3.0, 1e-9);
}

TEST(PeriodicTable, ANarrowPlaceNearbyIsNotLost) {
  EXPECT_NEAR(table().least_near(13.0, 5.0), 2.0, 1e-12);
  EXPECT_NEAR(table().least_near(107.0, 5.0), 2.0, 1e-12);
  EXPECT_NEAR(table().least_near(16.0, 5.0), table().at(16.0), 1e-12) << "too far away";
  EXPECT_NEAR(table().least_near(88.0, 5.0), table().at(88.0), 1e-12) << "no dip, a slope";
}

TEST(PeriodicTable, OneEntryHoldsEverywhere) {
  const PeriodicTable one{10.0, {{3.0, 7.0}}};
  for (const double s_m : {0.0, 3.0, 9.9, -4.0}) EXPECT_NEAR(one.at(s_m), 7.0, 1e-12);
}

}  // namespace
}  // namespace pitwall::track_file
