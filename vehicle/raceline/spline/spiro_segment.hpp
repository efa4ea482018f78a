// Segment of a Spiro spline: the plane curve of unit arc length whose curvature is a cubic
// polynomial of the arc length.
//   in     coefficients k of curvature(u) = k0 + k1 u + k2 u^2/2 + k3 u^3/6, u from -1/2 to 1/2;
//          heading 0 at u = 0
//   out    chord, heading and curvature at the ends, each with its derivatives by k
//   units  none: a segment of length L metres has its curvature divided by L, and so on
//   invariants
//          the quadrature is in error by less than 1e-12 for a segment that turns up to 4 pi
//   source R. Levien, From Spiral to Spline, thesis, UC Berkeley 2009, chapter 8 (four-parameter
//          spline); Gauss-Legendre quadrature, Abramowitz and Stegun, table 25.4
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace pitwall::raceline {

inline constexpr std::size_t kSpiroOrder = 4;
using SpiroCoefficients = std::array<double, kSpiroOrder>;

// heading(u) and the derivatives of the curvature, `order` from 0 to 2.
double heading_at(const SpiroCoefficients& k, double u);
double curvature_at(const SpiroCoefficients& k, double u, std::size_t order = 0);

struct Displacement {
  double x = 0.0, y = 0.0;
};
// From one place of the segment to another.
Displacement displacement(const SpiroCoefficients& k, double from_u, double to_u);

// A quantity and its derivatives by the coefficients.
struct Sensitive {
  double value = 0.0;
  SpiroCoefficients by_k{};
};

struct SegmentShape {
  Sensitive chord;          // length, of unit arc length
  Sensitive start_heading;  // of the tangents, from the chord
  Sensitive end_heading;
};

SegmentShape shape_of(const SpiroCoefficients& k);
// d curvature(u)/dk_j of the given order: what curvature_at() is linear in.
SpiroCoefficients curvature_weights(double u, std::size_t order);

}  // namespace pitwall::raceline
