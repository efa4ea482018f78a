// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/tracking/clear_mot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace pitwall::tracking_bench {
namespace {

using Spots = std::vector<Spot>;

TEST(ClearMot, APerfectTrackerHasNothingToItsDebit) {
  ClearMot score(2.0);
  for (double x_m = 0.0; x_m < 10.0; x_m += 1.0)
    score.add(Spots{{1, x_m, 0.0}, {2, -x_m, 5.0}}, Spots{{7, x_m, 0.1}, {8, -x_m, 4.9}});
  EXPECT_EQ(score.objects(), 20U);
  EXPECT_EQ(score.misses() + score.false_tracks() + score.switches(), 0U);
  EXPECT_EQ(score.mota(), 1.0);
  EXPECT_TRUE(std::isnan(ClearMot(2.0).mota()));
}

// Two frames: an object without a track, a track without an object, one beyond the gate.
TEST(ClearMot, CountsWhatIsMissedAndWhatIsFalse) {
  ClearMot score(2.0);
  score.add(Spots{{1, 0.0, 0.0}, {2, 50.0, 0.0}}, Spots{{7, 0.5, 0.0}});
  score.add(Spots{{1, 0.0, 0.0}, {2, 50.0, 0.0}}, Spots{{7, 0.5, 0.0}, {8, 50.0, 2.1}});
  EXPECT_EQ(score.misses(), 2U);
  EXPECT_EQ(score.false_tracks(), 1U);
  EXPECT_EQ(score.switches(), 0U);
  EXPECT_DOUBLE_EQ(score.mota(), 1.0 - 3.0 / 4.0);
}

TEST(ClearMot, AnotherNumberIsASwitchAndASwapIsTwo) {
  ClearMot renamed(2.0);
  renamed.add(Spots{{1, 0.0, 0.0}}, Spots{{7, 0.0, 0.0}});
  renamed.add(Spots{{1, 0.0, 0.0}}, Spots{});
  renamed.add(Spots{{1, 0.0, 0.0}}, Spots{{9, 0.0, 0.0}});
  EXPECT_EQ(renamed.switches(), 1U);
  EXPECT_EQ(renamed.misses(), 1U);
  EXPECT_DOUBLE_EQ(renamed.mota(), 1.0 - 2.0 / 3.0);
  // Two cars 3 m apart whose tracks exchange their places.
  ClearMot swapped(2.0);
  swapped.add(Spots{{1, 0.0, 0.0}, {2, 0.0, 3.0}}, Spots{{7, 0.0, 0.0}, {8, 0.0, 3.0}});
  swapped.add(Spots{{1, 0.0, 0.0}, {2, 0.0, 3.0}}, Spots{{8, 0.0, 0.0}, {7, 0.0, 3.0}});
  EXPECT_EQ(swapped.switches(), 2U);
  EXPECT_EQ(swapped.switched(), (std::vector<std::uint32_t>{1, 2}));
  swapped.add(Spots{{1, 0.0, 0.0}}, Spots{{8, 0.0, 0.0}});
  EXPECT_TRUE(swapped.switched().empty());
}

// A pair of the frame before stays although another track is nearer now.
TEST(ClearMot, APairStaysWhileItIsWithinTheGate) {
  ClearMot score(2.0);
  score.add(Spots{{1, 0.0, 0.0}}, Spots{{7, 0.0, 0.0}});
  const auto pairs = score.add(Spots{{1, 0.0, 0.0}}, Spots{{8, 0.2, 0.0}, {7, 1.0, 0.0}});
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].track, 1U);
  EXPECT_EQ(score.switches(), 0U);
  EXPECT_EQ(score.false_tracks(), 1U);
}

TEST(ClearMot, AnObjectThatWasOutOfSightMayGetANewTrackButNoOthers) {
  ClearMot score(2.0);
  score.add(Spots{{1, 0.0, 0.0}, {2, 9.0, 0.0}}, Spots{{7, 0.0, 0.0}, {8, 9.0, 0.0}});
  score.let_go(1);
  score.add(Spots{{1, 0.0, 0.0, false}, {2, 9.0, 0.0}}, Spots{{8, 9.0, 0.0}});
  EXPECT_EQ(score.objects(), 3U);
  EXPECT_EQ(score.misses(), 0U);
  score.add(Spots{{1, 0.0, 0.0}, {2, 9.0, 0.0}}, Spots{{11, 0.0, 0.0}, {8, 9.0, 0.0}});
  EXPECT_EQ(score.switches(), 0U);
  score.let_go(1);
  score.add(Spots{{1, 0.0, 0.0}}, Spots{{8, 0.0, 0.0}});  // the track of the other
  EXPECT_EQ(score.switches(), 1U);
}

}  // namespace
}  // namespace pitwall::tracking_bench
