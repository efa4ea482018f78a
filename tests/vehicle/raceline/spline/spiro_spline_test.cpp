// Spiro splines against what the library of the method's author computes, and against the laws of
// the curve.
//   source  coefficients: libspiro 1.3 (Debian libspiro1 20221101-1), run_spiro() on these points
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/spline/spiro_spline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pitwall::raceline {
namespace {

constexpr double kTolerance = 1e-5;

struct Segment {
  SpiroCoefficients k;
  double chord_m, chord_yaw_rad;
};

struct Reference {
  const char* name;
  std::vector<Place> points;
  std::vector<Segment> segments;
};

const std::vector<Reference> kReferences{
    {"circle",
     {{-100, 0}, {0, 100}, {100, 0}, {0, -100}},
     {{{-1.570796327, 0, 0, 0}, 141.421356, 0.785398163},
      {{-1.570796327, 0, 0, 0}, 141.421356, -0.785398163},
      {{-1.570796327, 0, 0, 0}, 141.421356, -2.356194490},
      {{-1.570796327, 0, 0, 0}, 141.421356, 2.356194490}}},
    {"oval",
     {{-300, -100}, {0, -110}, {300, -100}, {400, 0}, {300, 100}, {0, 110}, {-300, 100}, {-400, 0}},
     {{{0.007961949, -0.525912256, 5.155859166, -16.416138615}, 300.166620, -0.033320996},
      {{0.007961949, 0.525912256, 5.155859166, 16.416138615}, 300.166620, 0.033320996},
      {{1.403895552, 1.449323087, -1.341327344, -6.229275321}, 141.421356, 0.785398163},
      {{1.403895552, -1.449323087, -1.341327344, 6.229275321}, 141.421356, 2.356194490},
      {{0.007961949, -0.525912256, 5.155859166, -16.416138615}, 300.166620, 3.108271658},
      {{0.007961949, 0.525912256, 5.155859166, 16.416138615}, 300.166620, -3.108271658},
      {{1.403895552, 1.449323087, -1.341327344, -6.229275321}, 141.421356, -2.356194490},
      {{1.403895552, -1.449323087, -1.341327344, 6.229275321}, 141.421356, -0.785398163}}},
    {"bean",
     {{0, 0}, {120, -30}, {260, 10}, {310, 120}, {230, 190}, {150, 130}, {60, 180}, {-40, 110}},
     {{{0.749346582, -1.377484658, -0.193802983, 9.295009555}, 123.693169, -0.244978663},
      {{0.670986853, 1.471188337, 0.420812059, -13.524592156}, 145.602198, 0.278299659},
      {{0.742359510, -0.506761254, 1.681102446, 10.728492368}, 120.830460, 1.144168834},
      {{2.351808331, 2.384637656, -6.373482693, -29.521023696}, 106.301458, 2.422762654},
      {{-0.423283370, -4.603699902, 2.191034917, 24.029095484}, 100.000000, -2.498091545},
      {{-0.815826117, 4.385334034, 3.524412499, -25.394805757}, 102.956301, 2.634494149},
      {{2.321903272, -2.291320464, -7.231052479, 36.261895396}, 122.065556, -2.530866689},
      {{0.901842528, 0.753729340, 0.798121481, -10.092745357}, 117.046999, -1.222025323}}},
};

SpiroSpline spline_of(const std::vector<Place>& points) {
  auto spline = SpiroSpline::through(points);
  if (!spline) throw std::runtime_error(to_string(spline.error()));
  return *std::move(spline);
}

TEST(SpiroSpline, HasTheCoefficientsOfLibspiro) {
  for (const Reference& reference : kReferences) {
    const SpiroSpline spline = spline_of(reference.points);
    ASSERT_EQ(spline.segments().size(), reference.segments.size()) << reference.name;
    for (std::size_t i = 0; i < reference.segments.size(); ++i) {
      const SpiroSegment& ours = spline.segments()[i];
      const Segment& theirs = reference.segments[i];
      for (std::size_t j = 0; j < kSpiroOrder; ++j)
        EXPECT_NEAR(ours.k[j], theirs.k[j], kTolerance) << reference.name << " " << i << " " << j;
      EXPECT_NEAR(ours.chord_m, theirs.chord_m, kTolerance) << reference.name << " " << i;
      EXPECT_NEAR(ours.chord_yaw_rad, theirs.chord_yaw_rad, kTolerance) << reference.name;
    }
  }
}

TEST(SpiroSpline, PassesThroughItsPoints) {
  for (const Reference& reference : kReferences) {
    const SpiroSpline spline = spline_of(reference.points);
    for (std::size_t i = 0; i < spline.segments().size(); ++i) {
      const SpiroSegment& segment = spline.segments()[i];
      const SplinePoint end = spline.at(std::nextafter(segment.start_s_m + segment.length_m, 0.0));
      const Place& next = reference.points[(i + 1) % reference.points.size()];
      EXPECT_NEAR(std::hypot(end.x_m - next.x_m, end.y_m - next.y_m), 0.0, 1e-9)
          << reference.name << " " << i;
    }
  }
}

// Heading, curvature and its derivative by the spline; the second derivative by differences.
TEST(SpiroSpline, IsContinuousToTheSecondDerivativeOfTheCurvature) {
  constexpr double kNear_m = 1e-3;
  for (const Reference& reference : kReferences) {
    const SpiroSpline spline = spline_of(reference.points);
    for (std::size_t i = 0; i < spline.segments().size(); ++i) {
      const double s_m = spline.segments()[i].start_s_m;
      const double before_m = i == 0 ? spline.length_m() : s_m;
      const SplinePoint a = spline.at(before_m - 1e-9), b = spline.at(s_m);
      EXPECT_NEAR(wrap_pi(a.yaw_rad - b.yaw_rad), 0.0, 1e-9) << reference.name << " " << i;
      EXPECT_NEAR(a.curvature_per_m, b.curvature_per_m, 1e-9) << reference.name << " " << i;
      EXPECT_NEAR(a.curvature_rate_per_m2, b.curvature_rate_per_m2, 1e-10) << reference.name;
      const double rate_before =
          a.curvature_rate_per_m2 - spline.at(before_m - 1e-9 - kNear_m).curvature_rate_per_m2;
      const double rate_after =
          spline.at(s_m + kNear_m).curvature_rate_per_m2 - b.curvature_rate_per_m2;
      EXPECT_NEAR(rate_before / kNear_m, rate_after / kNear_m, 1e-8) << reference.name << " " << i;
    }
  }
}

TEST(SpiroSpline, OfACircleIsTheCircle) {
  std::vector<Place> points;
  for (const double angle_deg : {0.0, 20.0, 90.0, 100.0, 180.0, 250.0, 300.0})
    points.push_back({50.0 + 200.0 * std::cos(from_deg(angle_deg)),
                      -30.0 + 200.0 * std::sin(from_deg(angle_deg))});
  const SpiroSpline spline = spline_of(points);
  EXPECT_NEAR(spline.length_m(), 400.0 * std::numbers::pi, 1e-8);
  for (double s_m = 0.0; s_m < spline.length_m(); s_m += 7.0) {
    const SplinePoint p = spline.at(s_m);
    EXPECT_NEAR(std::hypot(p.x_m - 50.0, p.y_m + 30.0), 200.0, 1e-8);
    EXPECT_NEAR(p.curvature_per_m, 1.0 / 200.0, 1e-11);
  }
}

// The curve is the same at any size and direction: what libspiro's tests 14 and 15 ask.
TEST(SpiroSpline, TurnsAndGrowsWithItsPoints) {
  const Reference& reference = kReferences[2];
  const SpiroSpline spline = spline_of(reference.points);
  for (const double scale : {1e-40, 1e-3, 1.0, 1e12}) {
    std::vector<Place> points;
    for (const Place& p : reference.points)
      points.push_back({scale * (0.6 * p.x_m - 0.8 * p.y_m), scale * (0.8 * p.x_m + 0.6 * p.y_m)});
    const SpiroSpline other = spline_of(points);
    EXPECT_NEAR(other.length_m() / (scale * spline.length_m()), 1.0, 1e-9) << scale;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = 0; j < kSpiroOrder; ++j)
        EXPECT_NEAR(other.segments()[i].k[j], spline.segments()[i].k[j], 1e-7) << scale;
  }
}

// The error of Newton's method is squared at each step: from 0.1 it takes four to less than 1e-15,
// and one or two to get there. With a wrong derivative it is three times as many.
TEST(SpiroSpline, ConvergesInFewSteps) {
  constexpr int kStepsMost = 6;
  for (const Reference& reference : kReferences)
    EXPECT_LE(spline_of(reference.points).iterations(), kStepsMost) << reference.name;
  std::vector<Place> points;
  for (int i = 0; i < 200; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / 200.0;
    const double radius_m =
        300.0 + 20.0 * std::sin(3.0 * angle_rad) + 2.0 * std::cos(11.0 * angle_rad);
    points.push_back({1.8 * radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad)});
  }
  EXPECT_LE(spline_of(points).iterations(), kStepsMost);
}

TEST(SpiroSpline, RefusesWhatIsNoCurve) {
  const std::vector<Place> twice{{0, 0}, {10, 0}, {10, 0}, {0, 10}};
  const auto refused = SpiroSpline::through(twice);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("at one place"), std::string::npos);
  const std::vector<Place> unset{{0, 0}, {10, kUnset}, {0, 10}};
  EXPECT_FALSE(SpiroSpline::through(unset));
  const std::vector<Place> two{{0, 0}, {10, 0}};
  const auto few = SpiroSpline::through(two);
  ASSERT_FALSE(few);
  EXPECT_EQ(few.error().what, "2 points, at least 3 expected");
  // Test 3 of libspiro: its iteration fails, too.
  const std::vector<Place> wild{{233, 144}, {341, 138}, {386, 72},
                                {443, 141}, {467, 231}, {377, 333}};
  const auto coils = SpiroSpline::through(wild);
  ASSERT_FALSE(coils);
  EXPECT_NE(coils.error().what.find("no smooth curve found"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::raceline
