// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/offset.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/autonomy/planning/stadium.hpp"

namespace pitwall::planning {
namespace {

TEST(Offset, DerivativesAreThoseOfTheOffsetAndTheEndsAreSmooth) {
  const Line line = prepare(testing::recommended(), testing::stadium()).value();
  const OffsetChange change{.from_s_m = line.length_m - 50.0,  // across the start of the lap
                            .length_m = 200.0,
                            .from_m = 1.0,
                            .to_m = -4.0};
  constexpr double kStep_m = 0.01;
  double largest = 0.0;
  for (double d = -30.0; d < 230.0; d += 1.3) {
    const double s = change.from_s_m + d;
    const Offset a = offset_at(line, change, s - kStep_m), b = offset_at(line, change, s),
                 c = offset_at(line, change, s + kStep_m);
    EXPECT_NEAR(b.slope, (c.n_m - a.n_m) / (2.0 * kStep_m), 1e-6) << d;
    EXPECT_NEAR(b.bend_per_m, (c.slope - a.slope) / (2.0 * kStep_m), 2e-6) << d;
    largest = std::max(largest, std::abs(b.bend_per_m));
  }
  const OffsetChange begun{.from_s_m = 100.0,
                           .length_m = 150.0,
                           .from_m = 2.0,
                           .to_m = -1.0,
                           .from_slope = 0.03,
                           .from_bend_per_m = -0.002};
  const Offset first = offset_at(begun, 100.0), last = offset_at(begun, 250.0 - 1e-9);
  EXPECT_EQ(first.n_m, 2.0);
  EXPECT_NEAR(first.slope, 0.03, 1e-12);
  EXPECT_NEAR(first.bend_per_m, -0.002, 1e-12);
  EXPECT_NEAR(last.n_m, -1.0, 1e-9);
  EXPECT_NEAR(last.slope, 0.0, 1e-9);
  EXPECT_NEAR(last.bend_per_m, 0.0, 1e-9);
  for (double s = 101.0; s < 249.0; s += 1.3) {
    const Offset a = offset_at(begun, s - kStep_m), b = offset_at(begun, s),
                 c = offset_at(begun, s + kStep_m);
    EXPECT_NEAR(b.slope, (c.n_m - a.n_m) / (2.0 * kStep_m), 1e-6) << s;
    EXPECT_NEAR(b.bend_per_m, (c.slope - a.slope) / (2.0 * kStep_m), 2e-6) << s;
  }
  EXPECT_NEAR(largest, kLargestBend * 5.0 / (200.0 * 200.0), 1e-6);
  EXPECT_EQ(offset_at(line, change, change.from_s_m - 1.0).n_m, 1.0);
  EXPECT_EQ(offset_at(line, change, change.from_s_m + 201.0).n_m, -4.0);
  EXPECT_FALSE(is_over(line, change, change.from_s_m + 199.0));
  EXPECT_TRUE(is_over(line, change, change.from_s_m + 201.0));
  EXPECT_EQ(offset_at(line, OffsetChange{}, 17.0).n_m, 0.0);
}

TEST(Offset, DirectionAndCurvatureAreThoseOfThePathBesideTheLine) {
  const Line line = prepare(testing::recommended(), testing::stadium()).value();
  const OffsetChange change{
      .from_s_m = 700.0, .length_m = 150.0, .from_m = 0.0, .to_m = 5.0};  // within a turn
  constexpr double kStep_m = 1.0;
  for (double s = 700.0; s < 850.0; s += 3.7) {
    const auto place = [&](double at_m) {
      return beside(line.at(at_m), offset_at(line, change, at_m));
    };
    const Beside a = place(s - kStep_m), b = place(s), c = place(s + kStep_m);
    const double along = std::hypot(c.x_m - a.x_m, c.y_m - a.y_m);
    EXPECT_NEAR(wrap_pi(std::atan2(c.y_m - a.y_m, c.x_m - a.x_m) - b.yaw_rad), 0.0, 1e-4) << s;
    EXPECT_NEAR(wrap_pi(c.yaw_rad - a.yaw_rad) / along, b.curvature_per_m, 5e-5) << s;
  }
}

}  // namespace
}  // namespace pitwall::planning
