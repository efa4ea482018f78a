// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/spline/spiro_segment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pitwall::raceline {
namespace {

const std::vector<SpiroCoefficients> kShapes{{0.3, 0.0, 0.0, 0.0},
                                             {0.7, -1.4, -0.2, 9.3},
                                             {2.3, -2.3, -7.2, 36.3},
                                             {1.7, -2.9, 45.9, 235.3}};

TEST(SpiroSegment, OfConstantCurvatureIsAnArc) {
  for (const double turn_rad : {0.1, -1.0, std::numbers::pi, -6.0}) {
    const SegmentShape shape = shape_of({turn_rad, 0.0, 0.0, 0.0});
    const double half_rad = 0.5 * turn_rad;
    EXPECT_NEAR(shape.chord.value, std::sin(half_rad) / half_rad, 1e-14) << turn_rad;
    EXPECT_NEAR(shape.start_heading.value, -half_rad, 1e-14) << turn_rad;
    EXPECT_NEAR(shape.end_heading.value, half_rad, 1e-14) << turn_rad;
  }
}

// The integrals of Fresnel: C(1) and S(1), Abramowitz and Stegun, table 7.7.
TEST(SpiroSegment, OfLinearCurvatureIsAClothoid) {
  // heading of u + 1/2: pi/2 (u + 1/2)^2, less its value at u = 0
  const SpiroCoefficients k{0.5 * std::numbers::pi, std::numbers::pi, 0.0, 0.0};
  const Displacement d = displacement(k, -0.5, 0.5);
  const double turn_rad = std::numbers::pi / 8.0;
  EXPECT_NEAR(std::cos(turn_rad) * d.x - std::sin(turn_rad) * d.y, 0.7798934004, 1e-10);
  EXPECT_NEAR(std::sin(turn_rad) * d.x + std::cos(turn_rad) * d.y, 0.4382591474, 1e-10);
}

// A hundred pieces of a segment add up to it: the quadrature is good for the sharpest of them.
TEST(SpiroSegment, IsTheSumOfItsPieces) {
  for (const SpiroCoefficients& k : kShapes) {
    const Displacement whole = displacement(k, -0.5, 0.5);
    Displacement sum;
    for (int i = 0; i < 100; ++i) {
      const Displacement piece = displacement(k, -0.5 + 0.01 * i, -0.49 + 0.01 * i);
      sum.x += piece.x, sum.y += piece.y;
    }
    EXPECT_NEAR(sum.x, whole.x, 1e-12);
    EXPECT_NEAR(sum.y, whole.y, 1e-12);
  }
}

TEST(SpiroSegment, CurvatureIsTheDerivativeOfTheHeading) {
  constexpr double kStep = 1e-5;
  for (const SpiroCoefficients& k : kShapes)
    for (const double u : {-0.5, -0.2, 0.0, 0.31, 0.5}) {
      const double turned = heading_at(k, u + kStep) - heading_at(k, u - kStep);
      EXPECT_NEAR(turned / (2.0 * kStep), curvature_at(k, u), 1e-7);
      for (const std::size_t order : {std::size_t{1}, std::size_t{2}}) {
        const double change =
            curvature_at(k, u + kStep, order - 1) - curvature_at(k, u - kStep, order - 1);
        EXPECT_NEAR(change / (2.0 * kStep), curvature_at(k, u, order), 1e-6) << order;
      }
    }
}

TEST(SpiroSegment, DerivativesAreThoseOfTheFigures) {
  constexpr double kStep = 1e-6;
  for (const SpiroCoefficients& k : kShapes) {
    const SegmentShape shape = shape_of(k);
    for (std::size_t i = 0; i < kSpiroOrder; ++i) {
      SpiroCoefficients more = k, less = k;
      more[i] += kStep, less[i] -= kStep;
      const SegmentShape a = shape_of(less), b = shape_of(more);
      for (const auto figure :
           {&SegmentShape::chord, &SegmentShape::start_heading, &SegmentShape::end_heading})
        EXPECT_NEAR(((b.*figure).value - (a.*figure).value) / (2.0 * kStep),
                    (shape.*figure).by_k[i], 1e-8)
            << i;
    }
  }
}

}  // namespace
}  // namespace pitwall::raceline
