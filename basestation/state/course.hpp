// Track as the base needs it: positions along the line, corners, pit lane.
//   in     points along the reference line, stations rising from 0; the line is closed
//   out    pose at a station; corner windows; distance to the next one; whether a car is in the pit
//          lane
//   frames Map, as the car's position; offset left positive
//   errors make(): Problem for fewer than 4 points, stations that do not rise, values that are not
//          numbers
//   invariants
//          a corner window is a stretch whose curvature is at least kCornerCurvature; gaps shorter
//          than kCornerGap_m belong to it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::state {

struct CoursePoint {
  double s_m = kUnset, x_m = kUnset, y_m = kUnset, yaw_rad = kUnset, curvature_per_m = kUnset;
};
struct CoursePose {
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;
};
// From, to: in driving direction; to < from if the window crosses the start line.
struct CornerWindow {
  double from_s_m = kUnset, to_s_m = kUnset;
};

// Pit lane beside the line, offset left positive; from, to as for a corner.
struct PitLane {
  double from_s_m = kUnset, to_s_m = kUnset, offset_m = kUnset;
};

class Course {
 public:
  static constexpr double kCornerCurvature = 1.0 / 500.0;  // oval turns have radii of 150 .. 300 m
  static constexpr double kCornerGap_m = 50.0;

  static Result<Course, Problem> make(std::vector<CoursePoint> points, double length_m);

  double length_m() const { return length_m_; }
  const std::vector<CornerWindow>& corners() const { return corners_; }
  void set_pit(const PitLane& pit) { pit_ = pit; }
  // True between entry and exit, if nearer to the lane than to the line.
  bool in_pit(double s_m, double offset_m) const;
  CoursePose at(double s_m, double offset_m) const;  // s is wrapped
  // Distance in driving direction: 0 inside a corner; infinity without corners.
  double to_corner_m(double s_m) const;

 private:
  Course(std::vector<CoursePoint> points, double length_m);
  double wrapped(double s_m) const;

  std::vector<CoursePoint> points_;
  double length_m_ = kUnset;
  std::vector<CornerWindow> corners_;
  std::optional<PitLane> pit_;
};

}  // namespace pitwall::state
