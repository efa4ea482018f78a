// A closed curve through measured points, made smooth: the low-pass of its Fourier series, whose
// derivatives are exact.
//   in     points in order, the last one not the first again; wavelength below which detail goes
//   out    equal steps of about a metre along the chords, with the direction of travel
//   invariants
//          harmonic k of a curve of length L keeps 1 / (1 + (k cutoff / L)^6) of itself: 98 % at
//          twice the cutoff, half at the cutoff, nothing to speak of at half of it. A circle stays
//          the circle it is
//   units  m
//   cost   O(length^2 / cutoff)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::track_file {

struct Place {
  double x_m = kUnset, y_m = kUnset;
};

struct CurvePoint {
  double along_m = kUnset;  // along the chords of the measured points
  double s_m = kUnset;      // along the smooth curve
  double x_m = kUnset, y_m = kUnset;
  double yaw_rad = kUnset;  // not wrapped: it grows or falls by a whole turn over the lap
};

struct ClosedCurve {
  std::vector<CurvePoint> points;  // the last one is the first again, one lap on
  double length_m() const { return points.back().s_m; }
};

// At least 3 points, no two neighbours at one place.
ClosedCurve smooth_curve(const std::vector<Place>& points, double cutoff_m);

// Lengths along the chords: of each point, and of the whole lap as the last entry.
std::vector<double> chord_lengths(const std::vector<Place>& points);

}  // namespace pitwall::track_file
