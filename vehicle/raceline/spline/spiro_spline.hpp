// Closed Spiro spline through given points: on every segment the curvature is a cubic polynomial of
// Closed Spiro spline through given points: on every segment the curvature is a cubic polynomial of
//   in     points in order, no two neighbours at one place; the last one not the first again
//   out    position, heading, curvature and its derivative at any arc length
//   frames those of the points; curvature positive left
//   errors too few points, two neighbours at one place, a number that is none; an iteration that
//          does not converge (points that no such curve passes without coils)
//   cost   O(points) a Newton step, about 5 to 10 of them; at() O(log points)
//   source R. Levien, From Spiral to Spline, thesis, UC Berkeley 2009, chapters 7 and 8: unknown
//          are the four coefficients of each segment, Newton's method on the continuity at points
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/raceline/spline/spiro_segment.hpp"

namespace pitwall::raceline {

struct Place {
  double x_m = kUnset, y_m = kUnset;
};

struct SpiroSegment {
  SpiroCoefficients k{};
  Place start;
  double chord_m = kUnset, chord_yaw_rad = kUnset;  // from point to point
  double bend_rad = kUnset;                         // of the chords at the start
  double start_s_m = kUnset, length_m = kUnset;
  double middle_yaw_rad = kUnset;  // of the tangent at u = 0
};

struct SplinePoint {
  double s_m = kUnset, x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;
  double curvature_per_m = kUnset, curvature_rate_per_m2 = kUnset;
};

class SpiroSpline {
 public:
  static Result<SpiroSpline, Problem> through(std::span<const Place> points);

  double length_m() const { return length_m_; }
  const std::vector<SpiroSegment>& segments() const { return segments_; }
  int iterations() const { return iterations_; }
  SplinePoint at(double s_m) const;  // from 0 to length

 private:
  std::vector<SpiroSegment> segments_;
  double length_m_ = 0.0;
  int iterations_ = 0;
};

}  // namespace pitwall::raceline
