// SPDX-License-Identifier: Apache-2.0
#include "hil/traffic/rectangle.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <limits>
#include <random>
#include <string>

#include "protocol/vocabulary/check.hpp"
#include "tests/support/draw.hpp"

namespace pitwall::traffic {
namespace {

// Both sides round coordinates of some 10 m to 1e-15 of them; a thousand times that for the sums.
constexpr double kRounding_m = 1e-11;
// The active sets of the least squares end at a tolerance of 1e-10 of the cost.
constexpr double kOracle_m = 1e-7;
constexpr int kPairs = 2'000;

Rectangle draw(std::mt19937_64& random, double span_m) {
  using testing::draw_uniform;
  return {
      .centre_m = {draw_uniform(random, -span_m, span_m), draw_uniform(random, -span_m, span_m)},
      .yaw_rad = draw_uniform(random, -4.0, 4.0),
      .length_m = draw_uniform(random, 1.0, 6.0),
      .width_m = draw_uniform(random, 0.5, 2.5)};
}

Vector2 turned(Vector2 v, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

void expect_near(Vector2 a, Vector2 b) {
  EXPECT_NEAR(a.x, b.x, 1e3 * kRounding_m);
  EXPECT_NEAR(a.y, b.y, 1e3 * kRounding_m);
}

TEST(Rectangle, GapOfCarsBehindAndBesideEachOther) {
  const Rectangle car{.centre_m = {10.0, 3.0}, .yaw_rad = 0.0, .length_m = 4.9, .width_m = 1.9};
  Rectangle other = car;
  other.centre_m = {16.0, 3.0};
  Gap gap = gap_between(car, other);
  EXPECT_NEAR(gap.distance_m, 6.0 - 4.9, kRounding_m);
  expect_near(gap.normal, {1.0, 0.0});
  expect_near(gap.point_m, {13.0, 3.0});
  other.centre_m = {11.0, 0.5};
  gap = gap_between(car, other);
  EXPECT_NEAR(gap.distance_m, 2.5 - 1.9, kRounding_m);
  expect_near(gap.normal, {0.0, -1.0});
  expect_near(gap.point_m, {10.5, 1.75});  // half-way along the stretch where the sides face
  other.centre_m = {14.8, 3.4};
  gap = gap_between(car, other);
  EXPECT_NEAR(gap.distance_m, 4.8 - 4.9, kRounding_m);
  expect_near(gap.normal, {1.0, 0.0});
  expect_near(gap.point_m, {12.4, 3.2});  // centre of the overlap of 0.1 m by 1.5 m
}

TEST(Rectangle, ACornerInASideIsAContact) {
  const Rectangle car{.centre_m = {0.0, 0.0}, .yaw_rad = 0.0, .length_m = 4.0, .width_m = 2.0};
  const double half_m = std::sqrt(2.0);  // of the diagonal of the square
  Rectangle square{
      .centre_m = {0.0, 1.0 + half_m}, .yaw_rad = from_deg(45.0), .length_m = 2.0, .width_m = 2.0};
  square.centre_m.y += 0.01;
  EXPECT_NEAR(gap_between(car, square).distance_m, 0.01, kRounding_m);
  square.centre_m.y -= 0.02;
  const Gap gap = gap_between(car, square);
  EXPECT_NEAR(gap.distance_m, -0.01, kRounding_m);
  expect_near(gap.normal, {0.0, 1.0});
  // The overlap is a triangle: its centroid is a third of the depth from the side.
  EXPECT_NEAR(gap.point_m.y, 1.0 - 0.01 / 3.0, kRounding_m);
}

TEST(Rectangle, ExchangeTurnsTheNormalAndNothingElse) {
  std::mt19937_64 random(11);
  for (int i = 0; i < kPairs; ++i) {
    const Rectangle a = draw(random, 5.0), b = draw(random, 5.0);
    const Gap there = gap_between(a, b), back = gap_between(b, a);
    EXPECT_NEAR(there.distance_m, back.distance_m, kRounding_m);
    expect_near(there.normal, -1.0 * back.normal);
    expect_near(there.point_m, back.point_m);
  }
}

TEST(Rectangle, MovingAndTurningThePlaneMovesAndTurnsTheResult) {
  std::mt19937_64 random(12);
  for (int i = 0; i < kPairs; ++i) {
    const Rectangle a = draw(random, 5.0), b = draw(random, 5.0);
    const double angle_rad = testing::draw_uniform(random, -3.0, 3.0);
    const Vector2 way{testing::draw_uniform(random, -100.0, 100.0), 30.0};
    const auto placed = [&](Rectangle r) {
      r.centre_m = turned(r.centre_m, angle_rad) + way;
      r.yaw_rad += angle_rad;
      return r;
    };
    const Gap before = gap_between(a, b), after = gap_between(placed(a), placed(b));
    EXPECT_NEAR(before.distance_m, after.distance_m, kRounding_m);
    expect_near(turned(before.normal, angle_rad), after.normal);
    expect_near(turned(before.point_m, angle_rad) + way, after.point_m);
  }
}

TEST(Rectangle, AgreesWithSciPy) {
  const std::string path =
      ::testing::TempDir() + "/rectangles_" + std::to_string(::getpid()) + ".txt";
  std::mt19937_64 random(13);
  {
    std::ofstream file(path);
    file << std::setprecision(17);
    for (int i = 0; i < kPairs; ++i) {
      const Rectangle a = draw(random, 3.5), b = draw(random, 3.5);
      for (const Rectangle& r : {a, b})
        file << r.centre_m.x << ' ' << r.centre_m.y << ' ' << r.yaw_rad << ' ' << r.length_m << ' '
             << r.width_m << ' ';
      const Gap gap = gap_between(a, b);
      file << gap.distance_m << ' ' << gap.normal.x << ' ' << gap.normal.y << ' ' << gap.point_m.x
           << ' ' << gap.point_m.y << '\n';
    }
  }
  const std::string program = std::string("/usr/bin/python3 '") + PITWALL_SOURCE_DIR +
                              "/tests/hil/traffic/rectangle_oracle.py' '" + path + "'";
  std::FILE* pipe = popen(program.c_str(), "r");
  CHECK(pipe != nullptr);
  int separate = 0, overlapping = 0;
  double separate_m = kUnset, overlapping_m = kUnset;
  EXPECT_EQ(
      std::fscanf(pipe, "%d %d %lf %lf", &separate, &overlapping, &separate_m, &overlapping_m), 4);
  EXPECT_EQ(pclose(pipe), 0);
  std::filesystem::remove(path);
  EXPECT_EQ(separate + overlapping, kPairs);
  EXPECT_GT(separate, kPairs / 5);
  EXPECT_GT(overlapping, kPairs / 5);
  EXPECT_LE(separate_m, kOracle_m);
  EXPECT_LE(overlapping_m, kOracle_m);
}

TEST(Rectangle, NotANumberHasNoGap) {
  Rectangle car{.centre_m = {0.0, 0.0}, .yaw_rad = 0.0, .length_m = 4.0, .width_m = 2.0};
  Rectangle other = car;
  other.yaw_rad = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(gap_between(car, other).distance_m <= 0.0);
}

}  // namespace
}  // namespace pitwall::traffic
