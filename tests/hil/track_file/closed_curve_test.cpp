// SPDX-License-Identifier: Apache-2.0
#include "hil/track_file/closed_curve.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/hil/track_file/csv_text.hpp"

namespace pitwall::track_file {
namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

std::vector<Place> circle(double radius_m, int count, double wobble_m = 0.0, int waves = 0) {
  std::vector<Place> places;
  for (int i = 0; i < count; ++i) {
    const double a = kTurn_rad * i / count;
    const double r_m = radius_m + wobble_m * std::cos(waves * a);
    places.push_back({r_m * std::cos(a), r_m * std::sin(a)});
  }
  return places;
}

TEST(ClosedCurve, ACircleStaysTheCircleItIs) {
  for (const double cutoff_m : {10.0, 30.0, 100.0}) {
    const ClosedCurve curve = smooth_curve(circle(200.0, 250), cutoff_m);
    EXPECT_NEAR(curve.length_m(), kTurn_rad * 200.0, 0.05);
    for (const CurvePoint& p : curve.points)
      ASSERT_NEAR(std::hypot(p.x_m, p.y_m), 200.0, 5e-3) << p.s_m;
  }
}

TEST(ClosedCurve, EndsWhereItBeganOneTurnOn) {
  for (const bool reversed : {false, true}) {
    auto places = stadium();
    if (reversed) std::reverse(places.begin(), places.end());
    const ClosedCurve curve = smooth_curve(places, 30.0);
    const CurvePoint &a = curve.points.front(), &b = curve.points.back();
    EXPECT_NEAR(std::hypot(a.x_m - b.x_m, a.y_m - b.y_m), 0.0, 1e-9);
    EXPECT_NEAR(b.yaw_rad - a.yaw_rad, reversed ? -kTurn_rad : kTurn_rad, 1e-9);
  }
}

// The direction is that of the next step, and the station the length of the steps.
TEST(ClosedCurve, HeadingAndStationBelongToThePlaces) {
  const ClosedCurve curve = smooth_curve(stadium(), 30.0);
  for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
    const CurvePoint &a = curve.points[i], &b = curve.points[i + 1];
    const double dx_m = b.x_m - a.x_m, dy_m = b.y_m - a.y_m;
    ASSERT_NEAR(b.s_m - a.s_m, std::hypot(dx_m, dy_m), 1e-4);
    ASSERT_NEAR(wrap_pi(std::atan2(dy_m, dx_m) - 0.5 * (a.yaw_rad + b.yaw_rad)), 0.0, 1e-4);
  }
}

// What is left of a wobble follows the law of the low-pass.
TEST(ClosedCurve, TakesAwayWhatIsShorterThanTheCutoff) {
  const double length_m = kTurn_rad * 200.0;
  for (const auto& [waves, least, most] :
       {std::tuple{20, 0.97, 1.01}, std::tuple{42, 0.4, 0.6}, std::tuple{110, 0.0, 0.01}}) {
    const ClosedCurve curve = smooth_curve(circle(200.0, 1257, 0.05, waves), length_m / 42.0);
    double low_m = 1e9, high_m = 0.0;
    for (const CurvePoint& p : curve.points) {
      low_m = std::min(low_m, std::hypot(p.x_m, p.y_m));
      high_m = std::max(high_m, std::hypot(p.x_m, p.y_m));
    }
    EXPECT_GE(high_m - low_m, 0.1 * least) << waves;
    EXPECT_LE(high_m - low_m, 0.1 * most) << waves;
  }
}

TEST(ClosedCurve, ChordsAddUp) {
  const auto at_m = chord_lengths({{0.0, 0.0}, {3.0, 4.0}, {3.0, 0.0}});
  EXPECT_EQ(at_m, (std::vector<double>{0.0, 5.0, 9.0, 12.0}));
}

}  // namespace
}  // namespace pitwall::track_file
