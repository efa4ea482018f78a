// Against the map itself: TrackMap::project() and road().
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/track_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/hil/traffic/oval.hpp"
#include "tests/support/draw.hpp"

namespace pitwall::perception {
namespace {

TEST(TrackGrid, IsTheMap) {
  const world::TrackMap& track = traffic::oval();
  const TrackGrid grid{track};
  std::mt19937_64 random{11};
  for (int i = 0; i < 5'000; ++i) {
    const double s_m = testing::draw_uniform(random, 0.0, track.length_m());
    const double n_m = testing::draw_uniform(random, -7.9, 7.9);
    const world::TrackPoint at = track.offset(s_m, n_m);
    const auto place = grid.at(at.x_m, at.y_m);
    ASSERT_TRUE(place) << s_m << ' ' << n_m;
    EXPECT_NEAR(place->n_m, n_m, 0.02) << s_m;
    // Along a turn the grid measures on the reference line: 8 m to its inside 1 m is 0.96 m.
    EXPECT_NEAR(std::remainder(place->s_m - s_m, track.length_m()), 0.0, 0.1) << n_m;
    EXPECT_NEAR(place->height_m, track.road(s_m, n_m).height_m, 0.02);
    EXPECT_NEAR(place->wall_m, traffic::kWall_m - std::abs(n_m), 0.02);
    EXPECT_NEAR(std::remainder(place->yaw_rad - at.yaw_rad, 6.283185307179586), 0.0, 0.01);
  }
}

TEST(TrackGrid, BeyondTheWallsIsNothing) {
  const world::TrackMap& track = traffic::oval();
  const TrackGrid grid{track};
  for (double s_m = 0.0; s_m < track.length_m(); s_m += 7.3)
    for (const double n_m : {-60.0, -12.0, -8.1, 8.1, 12.0, 100.0}) {
      const world::TrackPoint at = track.offset(s_m, n_m);
      EXPECT_FALSE(grid.at(at.x_m, at.y_m)) << s_m << ' ' << n_m;
    }
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(grid.at(kNan, 0.0));
  EXPECT_FALSE(grid.at(1e12, -1e12));
}

}  // namespace
}  // namespace pitwall::perception
