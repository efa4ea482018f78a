// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/camera/look.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::sensors {
namespace {

TEST(Look, DrawnOnesAreOfThisWorld) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Noise noise{seed, 1};
    const Look look = draw_look(5, noise);
    ASSERT_EQ(look.paints.size(), 5U);
    EXPECT_NEAR(dot(look.light.towards_sun, look.light.towards_sun), 1.0, 1e-9);
    EXPECT_GT(look.light.towards_sun[2], 0.0) << "by day";
    std::vector<Colour> colours{look.road,  look.wall, look.poster, look.fence,
                                look.grass, look.tyre, look.line,   look.skyline.colour};
    for (const Paint& paint : look.paints) {
      colours.push_back(paint.first), colours.push_back(paint.second);
      EXPECT_NEAR(dot(paint.across, paint.across), 1.0, 1e-9);
    }
    for (const Colour& colour : colours)
      for (const float part : colour) {
        EXPECT_GE(part, 0.0F) << seed;
        EXPECT_LE(part, 1.0F) << seed;
      }
  }
}

TEST(Look, TheSameNoiseGivesTheSameLook) {
  Noise first{3, 1}, again{3, 1}, other{4, 1};
  const Look a = draw_look(2, first), b = draw_look(2, again), c = draw_look(2, other);
  EXPECT_EQ(a.road, b.road);
  EXPECT_EQ(a.texture, b.texture);
  EXPECT_NE(a.texture, c.texture);
}

TEST(Look, DaylightHasCarsOfDifferentPaint) {
  const Look look = daylight();
  for (std::size_t i = 0; i < look.paints.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(look.paints[i].first, look.paints[k].first);
  EXPECT_GE(look.paints.size(), 4U);
}

}  // namespace
}  // namespace pitwall::sensors
