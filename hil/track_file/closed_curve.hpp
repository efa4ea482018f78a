// Smooth closed curve through measured points: the low-pass of its Fourier series, whose
// derivatives are exact.
//   in     points in order, without a repetition of the first one; the cutoff wavelength
//   out    equal steps of about a metre along the chords, with the direction of travel
//   invariants
//          harmonic k of a curve of length L is scaled by 1 / (1 + (k cutoff / L)^6): 98 % at twice
//          the cutoff, half at the cutoff, almost nothing at half of it. A circle remains the same
//          circle
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
  double yaw_rad = kUnset;  // not wrapped: it changes by a whole turn over the lap
};

struct ClosedCurve {
  std::vector<CurvePoint> points;  // the last one repeats the first, one lap later
  double length_m() const { return points.back().s_m; }
};

// Needs at least 3 points; no two neighbours may be at the same place.
ClosedCurve smooth_curve(const std::vector<Place>& points, double cutoff_m);

// Distance along the chords to each point; the last entry is that of the whole lap.
std::vector<double> chord_lengths(const std::vector<Place>& points);

}  // namespace pitwall::track_file
