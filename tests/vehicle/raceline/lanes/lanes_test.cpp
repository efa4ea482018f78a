// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/lanes/lanes.hpp"

#include <gtest/gtest.h>

#include "tests/vehicle/raceline/courses.hpp"

namespace pitwall::raceline {
namespace {

TEST(Lanes, AreTheHalvesOfTheRoad) {
  for (const auto& description : {stadium(), mirrored(stadium()), ring(), circuit()}) {
    const world::TrackMap track = valid(world::TrackMap::build(description));
    const Lanes lanes{track};
    for (double s_m = 0.0; s_m < track.length_m(); s_m += 50.0) {
      const world::TrackPoint p = track.at(s_m);
      const Band inner = lanes.band(Region::kInnerLane, s_m);
      const Band outer = lanes.band(Region::kOuterLane, s_m);
      const Band &left = lanes.turns_left() ? inner : outer,
                 &right = lanes.turns_left() ? outer : inner;
      EXPECT_DOUBLE_EQ(left.left_m, p.width_left_m);
      EXPECT_DOUBLE_EQ(right.right_m, -p.width_right_m);
      EXPECT_DOUBLE_EQ(left.right_m, right.left_m);
      EXPECT_NEAR(inner.width_m(), outer.width_m(), 1e-12);
      EXPECT_DOUBLE_EQ(lanes.band(Region::kTrack, s_m).left_m, left.left_m);
      EXPECT_DOUBLE_EQ(lanes.band(Region::kTrack, s_m).right_m, right.right_m);
    }
  }
}

TEST(Lanes, InnerLaneLiesWhereTheLapTurns) {
  const world::TrackMap left = valid(world::TrackMap::build(stadium()));
  const world::TrackMap right = valid(world::TrackMap::build(mirrored(stadium())));
  EXPECT_TRUE(Lanes{left}.turns_left());
  EXPECT_FALSE(Lanes{right}.turns_left());
  EXPECT_GT(Lanes{left}.band(Region::kInnerLane, 10.0).middle_m(), -1.0);
  EXPECT_LT(Lanes{right}.band(Region::kInnerLane, 10.0).middle_m(), 1.0);
  EXPECT_EQ(Lanes{left}.lane_at_pit(), Region::kInnerLane);
  EXPECT_EQ(Lanes{right}.lane_at_pit(), Region::kInnerLane);
}

TEST(Lanes, NarrowestIsWhatIsFreeAllTheWay) {
  world::TrackDescription description = stadium();
  description.knots[3].width_left_m = 5.0;  // alone, at the end of a turn
  description.knots[3].width_right_m = 7.0;
  const world::TrackMap track = valid(world::TrackMap::build(description));
  const Lanes lanes{track};
  const double narrow_m = description.knots[3].s_m;
  const Band free = lanes.narrowest(Region::kTrack, narrow_m - 30.0, narrow_m + 30.0);
  EXPECT_NEAR(free.left_m, 5.0, 0.1);
  EXPECT_NEAR(free.right_m, -7.0, 0.1);
  const Band before = lanes.narrowest(Region::kTrack, 100.0, 200.0);
  EXPECT_DOUBLE_EQ(before.left_m, 8.0);
  EXPECT_DOUBLE_EQ(before.right_m, -10.0);
}

TEST(Lanes, PitLaneReachesAcrossTheStart) {
  const world::TrackMap track = valid(world::TrackMap::build(stadium()));
  const Lanes lanes{track};
  EXPECT_FALSE(lanes.along_pit(track.length_m() - 61.0));
  EXPECT_NEAR(*lanes.along_pit(track.length_m() - 60.0), 0.0, 1e-9);
  EXPECT_NEAR(*lanes.along_pit(210.0), 0.5, 1e-9);
  EXPECT_FALSE(lanes.along_pit(480.0));
  const Band beside = lanes.band(Region::kPitLane, 210.0);
  EXPECT_DOUBLE_EQ(beside.left_m, 24.0);
  EXPECT_DOUBLE_EQ(beside.right_m, -10.0);
  const Band elsewhere = lanes.band(Region::kPitLane, 900.0);
  EXPECT_DOUBLE_EQ(elsewhere.left_m, lanes.band(Region::kInnerLane, 900.0).left_m);
  EXPECT_DOUBLE_EQ(elsewhere.right_m, lanes.band(Region::kInnerLane, 900.0).right_m);
  const world::TrackMap without = valid(world::TrackMap::build(ring()));
  EXPECT_FALSE(Lanes{without}.along_pit(210.0));
}

TEST(Lanes, TextsReadBack) {
  for (const Region region :
       {Region::kInnerLane, Region::kOuterLane, Region::kPitLane, Region::kTrack})
    EXPECT_EQ(region_of(text_of(region)), region);
  EXPECT_FALSE(region_of("apron"));
  EXPECT_STREQ(words_of(Region::kOuterLane), "outer lane");
  EXPECT_STREQ(words_of(Region::kTrack), "track");
}

}  // namespace
}  // namespace pitwall::raceline
