// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/course.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pitwall::state {
namespace {

constexpr std::size_t kPointsMin = 4;

bool finite(const CoursePoint& p) {
  return std::isfinite(p.s_m) && std::isfinite(p.x_m) && std::isfinite(p.y_m) &&
         std::isfinite(p.yaw_rad) && std::isfinite(p.curvature_per_m);
}

bool in_corner(const CoursePoint& p) {
  return std::abs(p.curvature_per_m) >= Course::kCornerCurvature;
}

std::vector<CornerWindow> windows_of(const std::vector<CoursePoint>& points, double length_m) {
  std::vector<CornerWindow> windows;
  for (const CoursePoint& point : points) {
    if (!in_corner(point)) continue;
    if (!windows.empty() && point.s_m - windows.back().to_s_m <= Course::kCornerGap_m) {
      windows.back().to_s_m = point.s_m;
    } else {
      windows.push_back({point.s_m, point.s_m});
    }
  }
  if (windows.size() < 2) return windows;
  // One that lies across the start line is one.
  const double across_m = windows.front().from_s_m + length_m - windows.back().to_s_m;
  if (across_m <= Course::kCornerGap_m) {
    windows.front().from_s_m = windows.back().from_s_m;
    windows.pop_back();
  }
  return windows;
}

}  // namespace

Result<Course, Problem> Course::make(std::vector<CoursePoint> points, double length_m) {
  const auto wrong = [](const char* what) { return Unexpected{Problem{"track", what}}; };
  if (points.size() < kPointsMin) return wrong("a course has four points or more");
  if (!std::all_of(points.begin(), points.end(), finite)) return wrong("a point is no number");
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!(points[i].s_m > points[i - 1].s_m)) return wrong("stations rise");
  }
  if (!(points.front().s_m >= 0.0 && std::isfinite(length_m) && length_m > points.back().s_m)) {
    return wrong("stations lie within the length of the lap");
  }
  return Course{std::move(points), length_m};
}

Course::Course(std::vector<CoursePoint> points, double length_m)
    : points_(std::move(points)), length_m_(length_m), corners_(windows_of(points_, length_m)) {}

double Course::wrapped(double s_m) const {
  const double rest = std::fmod(s_m, length_m_);
  return rest < 0.0 ? rest + length_m_ : rest;
}

CoursePose Course::at(double s_m, double offset_m) const {
  const double s = wrapped(s_m);
  const auto after = std::upper_bound(points_.begin(), points_.end(), s,
                                      [](double v, const CoursePoint& p) { return v < p.s_m; });
  const CoursePoint& to = after == points_.end() ? points_.front() : *after;
  const CoursePoint& from = after == points_.begin() ? points_.back() : *(after - 1);
  const double gap_m = wrapped(to.s_m - from.s_m), along_m = wrapped(s - from.s_m);
  const double t = gap_m > 0.0 ? along_m / gap_m : 0.0;
  const double yaw = from.yaw_rad + t * wrap_pi(to.yaw_rad - from.yaw_rad);
  return {.x_m = from.x_m + t * (to.x_m - from.x_m) - offset_m * std::sin(yaw),
          .y_m = from.y_m + t * (to.y_m - from.y_m) + offset_m * std::cos(yaw),
          .yaw_rad = wrap_pi(yaw)};
}

bool Course::in_pit(double s_m, double offset_m) const {
  if (!pit_) return false;
  const double length_m = wrapped(pit_->to_s_m - pit_->from_s_m);
  return wrapped(s_m - pit_->from_s_m) <= length_m &&
         std::abs(offset_m - pit_->offset_m) < std::abs(offset_m);
}

double Course::to_corner_m(double s_m) const {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const CornerWindow& corner : corners_) {
    const double length_m = wrapped(corner.to_s_m - corner.from_s_m);
    const double inside_m = wrapped(s_m - corner.from_s_m);
    if (inside_m <= length_m) return 0.0;
    nearest_m = std::min(nearest_m, wrapped(corner.from_s_m - s_m));
  }
  return nearest_m;
}

}  // namespace pitwall::state
