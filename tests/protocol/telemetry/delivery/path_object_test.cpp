// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/delivery/path_object.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/draw.hpp"

namespace pitwall::telemetry {
namespace {

// A path that wanders at random from any place of the map.
std::vector<PathPoint> some_path(std::mt19937_64& random, std::size_t points) {
  const auto within = [&](double bound) { return testing::draw_uniform(random, -bound, bound); };
  const auto speed = [&] { return testing::draw_uniform(random, 0.0, 90.0); };
  std::vector<PathPoint> path{{within(9e5), within(9e5), speed()}};
  while (path.size() < points)
    path.push_back({path.back().x_m + within(290.0), path.back().y_m + within(290.0), speed()});
  return path;
}

TEST(PathObject, ComesBackToHalfACentimetreHoweverLong) {
  std::mt19937_64 random(11);
  for (std::size_t points = 1; points <= kPathPoints; ++points) {
    const auto path = some_path(random, points);
    PathBuffer buffer;
    const auto bytes = encode_path(path, buffer);
    ASSERT_TRUE(bytes);
    const auto back = decode_path(*bytes);
    ASSERT_TRUE(back);
    ASSERT_EQ(back->size(), points);
    for (std::size_t i = 0; i < points; ++i) {
      EXPECT_NEAR((*back)[i].x_m, path[i].x_m, 0.00501);
      EXPECT_NEAR((*back)[i].y_m, path[i].y_m, 0.00501);
      EXPECT_NEAR((*back)[i].speed_mps, path[i].speed_mps, 0.00501);
    }
  }
}

TEST(PathObject, WhatIsNoPathIsRefused) {
  PathBuffer buffer;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const PathPoint good{1.0, 2.0, 3.0};
  EXPECT_FALSE(encode_path({}, buffer));
  EXPECT_FALSE(encode_path(std::vector(kPathPoints + 1, good), buffer));
  for (const PathPoint& bad :
       {PathPoint{kNan, 2, 3}, PathPoint{1, kNan, 3}, PathPoint{1, 2, kNan}, PathPoint{kInf, 2, 3},
        PathPoint{1, 2, -0.1}, PathPoint{1, 2, 601}, PathPoint{1.1e6, 2, 3}, PathPoint{302, 2, 3}})
    EXPECT_FALSE(encode_path(std::vector{good, bad}, buffer));
}

// Of every length but its own, and with any byte changed: no more than other numbers.
TEST(PathObject, ForeignBytesDoNoHarm) {
  std::mt19937_64 random(12);
  PathBuffer buffer;
  const auto bytes = *encode_path(some_path(random, 20), buffer);
  std::vector<std::uint8_t> copy(bytes.begin(), bytes.end());
  for (std::size_t length = 0; length < copy.size(); ++length)
    EXPECT_FALSE(decode_path(std::span(copy).first(length)));
  copy.push_back(0);
  EXPECT_FALSE(decode_path(copy));
  copy.pop_back();
  for (std::size_t at = 0; at < copy.size(); ++at) {
    for (const int value : {0, 1, 127, 128, 255}) {
      auto changed = copy;
      changed[at] = static_cast<std::uint8_t>(value);
      const auto path = decode_path(changed);
      if (!path) continue;
      for (const PathPoint& p : *path) EXPECT_TRUE(std::isfinite(p.x_m + p.y_m + p.speed_mps));
    }
  }
}

}  // namespace
}  // namespace pitwall::telemetry
