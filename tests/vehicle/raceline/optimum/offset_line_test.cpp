// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/optimum/offset_line.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/raceline/courses.hpp"

namespace pitwall::raceline {
namespace {

// Of the ring of 200 m, left-hand: an offset makes another circle.
TEST(OffsetLine, OfARingIsACircle) {
  const world::TrackMap track = valid(world::TrackMap::build(ring()));
  OffsetLine line{track, stations_of(track, 4.0, 3)};
  EXPECT_EQ(line.size() % 3, 0U);
  for (double& n_m : line.offset_m) n_m = 5.0;
  const double turn = 2.0 * std::numbers::pi / static_cast<double>(line.size());
  for (std::size_t i = 0; i < line.size(); i += 17) {
    EXPECT_NEAR(line.bend(i).curvature_per_m, 1.0 / 195.0, 1e-6);
    EXPECT_NEAR(line.step(i).length_m, 2.0 * 195.0 * std::sin(0.5 * turn), 1e-4);
    EXPECT_NEAR(line.bend(i).length_m, line.step(i).length_m, 1e-4);
  }
}

TEST(OffsetLine, DerivativesAreThoseOfDifferences) {
  const world::TrackMap track = valid(world::TrackMap::build(circuit()));
  OffsetLine line{track, stations_of(track, 4.0, 3)};
  Random random{5};
  for (double& n_m : line.offset_m) n_m = random.between(-0.5, 0.5);
  constexpr double kMove_m = 1e-6;
  for (std::size_t i = 0; i < line.size(); i += 5) {
    const Bend bend = line.bend(i);
    const Step step = line.step(i);
    for (std::size_t k = 0; k < 3; ++k) {
      double& moved_m = line.offset_m[(i + line.size() + k - 1) % line.size()];
      const double at_m = moved_m;
      moved_m = at_m + kMove_m;
      const Bend high = line.bend(i);
      const double long_m = line.step(i).length_m;
      moved_m = at_m - kMove_m;
      const Bend low = line.bend(i);
      const double short_m = line.step(i).length_m;
      moved_m = at_m;
      EXPECT_NEAR((high.curvature_per_m - low.curvature_per_m) / (2.0 * kMove_m),
                  bend.curvature_by_offset[k], 1e-7);
      EXPECT_NEAR((high.length_m - low.length_m) / (2.0 * kMove_m), bend.length_by_offset[k], 1e-7);
      if (k > 0) {
        EXPECT_NEAR((long_m - short_m) / (2.0 * kMove_m), step.by_offset[k - 1], 1e-7);
      }
    }
  }
}

TEST(OffsetLine, BoundsKeepTheMargin) {
  const world::TrackMap track = valid(world::TrackMap::build(stadium()));
  const Lanes lanes{track};
  const OffsetLine line{track, stations_of(track, 4.0, 3)};
  const OffsetBounds bounds = valid(bounds_of(line, lanes, kMargin_m));
  for (std::size_t i = 0; i < line.size(); ++i) {
    EXPECT_EQ(bounds.low_m[i], -(10.0 - kMargin_m));
    EXPECT_EQ(bounds.high_m[i], 8.0 - kMargin_m);
  }
  const auto none = bounds_of(line, lanes, 9.5);
  ASSERT_FALSE(none);
  EXPECT_NE(to_string(none.error()).find("the track is 18.00 m wide, more than 19.00 m expected"),
            std::string::npos);
}

}  // namespace
}  // namespace pitwall::raceline
