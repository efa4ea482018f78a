// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/console/track_document.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "protocol/json/json_text.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall::publishers::console {
namespace {

using json::Array;
using json::Object;
using state::CoursePoint;

constexpr double kStep_m = 1.0;        // of the integration
constexpr std::size_t kDrawEvery = 5;  // steps between points of the drawing
constexpr double kLengthMin_m = 50.0, kLengthMax_m = 50'000.0, kFar_m = 1e6;
constexpr double kTurn_rad = 2.0 * std::numbers::pi;

struct Knot {
  double s_m, curvature_per_m, left_m, right_m;
};
struct Pit {
  double from_s_m, to_s_m, offset_m;
};
struct Track {
  std::string name;
  double length_m = 0.0;
  TrackDatum datum;
  CoursePoint start;
  std::vector<Knot> knots;
  std::optional<Pit> pit;
};

double rad(double deg) { return deg * std::numbers::pi / 180.0; }

std::vector<Knot> read_knots(yaml::StrictMap& map, double length_m) {
  constexpr double kCurvatureMax = 0.2, kWidthMax_m = 500.0;
  std::vector<Knot> knots;
  for (yaml::StrictMap& row : map.maps("knots")) {
    const double first_m = knots.empty() ? 0.0 : knots.back().s_m;
    knots.push_back(
        {.s_m = row.number("s_m", first_m, length_m),
         .curvature_per_m = row.number("curvature_per_m", -kCurvatureMax, kCurvatureMax),
         .left_m = row.number("width_left_m", 0.0, kWidthMax_m),
         .right_m = row.number("width_right_m", 0.0, kWidthMax_m)});
    row.number_or("bank_deg", 0.0, -90.0, 90.0);
  }
  constexpr std::size_t kKnotsMin = 4;
  if (knots.size() < kKnotsMin) map.fail("knots", "expected at least four");
  return knots;
}

Track read(yaml::StrictMap& map) {
  Track track;
  track.name = map.text("name");
  track.length_m = map.number("length_m", kLengthMin_m, kLengthMax_m);
  yaml::StrictMap datum = map.map("datum");
  track.datum.latitude_deg = datum.number("latitude_deg", -90.0, 90.0);
  track.datum.longitude_deg = datum.number("longitude_deg", -180.0, 180.0);
  track.datum.height_m = datum.number_or("height_m", 0.0, -kFar_m, kFar_m);  // the drawing is flat
  yaml::StrictMap start = map.map("start");
  track.start = {.s_m = 0.0,
                 .x_m = start.number("x_m", -kFar_m, kFar_m),
                 .y_m = start.number("y_m", -kFar_m, kFar_m),
                 .yaw_rad = rad(start.number("yaw_deg", -360.0, 360.0))};
  if (auto pit = map.optional_map("pit")) {
    track.pit = Pit{.from_s_m = pit->number("entry_s_m", 0.0, track.length_m),
                    .to_s_m = pit->number("exit_s_m", 0.0, track.length_m),
                    .offset_m = pit->number("offset_m", -500.0, 500.0)};
    for (const char* const other : {"width_m", "speed_limit_mps"}) pit->number(other, 0.0, kFar_m);
  }
  track.knots = read_knots(map, track.length_m);
  return track;
}

// Linear between knots, around the lap.
Knot at(const std::vector<Knot>& knots, double s_m, double length_m) {
  const auto after =
      std::ranges::upper_bound(knots, s_m, {}, [](const Knot& knot) { return knot.s_m; });
  Knot a = after == knots.begin() ? knots.back() : *std::prev(after);
  Knot b = after == knots.end() ? knots.front() : *after;
  if (after == knots.begin()) a.s_m -= length_m;
  if (after == knots.end()) b.s_m += length_m;
  const double t = b.s_m > a.s_m ? (s_m - a.s_m) / (b.s_m - a.s_m) : 0.0;
  return {.s_m = s_m,
          .curvature_per_m = std::lerp(a.curvature_per_m, b.curvature_per_m, t),
          .left_m = std::lerp(a.left_m, b.left_m, t),
          .right_m = std::lerp(a.right_m, b.right_m, t)};
}

// One lap on from the start; the last point is where the lap ends, which is to be the first.
std::vector<CoursePoint> integrate(const Track& track, double curvature_more_per_m) {
  const auto steps = static_cast<std::size_t>(std::ceil(track.length_m / kStep_m));
  const double step_m = track.length_m / static_cast<double>(steps);
  std::vector<CoursePoint> points{track.start};
  for (std::size_t i = 0; i < steps; ++i) {
    CoursePoint& here = points.back();
    const double s_m = step_m * static_cast<double>(i);
    here.curvature_per_m =
        at(track.knots, s_m, track.length_m).curvature_per_m + curvature_more_per_m;
    const double middle_per_m =
        at(track.knots, s_m + 0.5 * step_m, track.length_m).curvature_per_m + curvature_more_per_m;
    const double yaw_rad = here.yaw_rad + 0.5 * step_m * here.curvature_per_m;
    points.push_back({.s_m = s_m + step_m,
                      .x_m = here.x_m + step_m * std::cos(yaw_rad),
                      .y_m = here.y_m + step_m * std::sin(yaw_rad),
                      .yaw_rad = here.yaw_rad + step_m * middle_per_m,
                      .curvature_per_m = 0.0});
  }
  return points;
}

std::vector<CoursePoint> closed_line(const Track& track) {
  std::vector<CoursePoint> points = integrate(track, 0.0);
  const double turned_rad = points.back().yaw_rad - track.start.yaw_rad;
  const double missing_rad = std::copysign(kTurn_rad, turned_rad) - turned_rad;
  points = integrate(track, missing_rad / track.length_m);
  const CoursePoint end = points.back();
  points.pop_back();
  for (CoursePoint& point : points) {
    const double share = point.s_m / track.length_m;
    point.x_m -= share * (end.x_m - track.start.x_m);
    point.y_m -= share * (end.y_m - track.start.y_m);
    point.yaw_rad = std::remainder(point.yaw_rad, kTurn_rad);
  }
  return points;
}

std::string numbers(std::initializer_list<double> list) {
  constexpr double kCentimetres = 100.0;
  Array array;
  for (const double v : list) array.json(json::number(std::round(v * kCentimetres) / kCentimetres));
  return array.str();
}

std::string beside(const CoursePoint& p, double offset_m) {
  return numbers({p.x_m - offset_m * std::sin(p.yaw_rad), p.y_m + offset_m * std::cos(p.yaw_rad)});
}

bool within(double s_m, double from_m, double to_m) {
  return from_m <= to_m ? s_m >= from_m && s_m <= to_m : s_m >= from_m || s_m <= to_m;
}

std::string pit_text(const Track& track, const std::vector<CoursePoint>& line) {
  if (!track.pit) return "[]";
  // From the entry on: the lane may lie across the start line.
  const auto first = static_cast<std::size_t>(1.0 + track.pit->from_s_m / track.length_m *
                                                        static_cast<double>(line.size()));
  Array pit;
  for (std::size_t i = 0; i < line.size(); i += kDrawEvery) {
    const CoursePoint& point = line[(first + i) % line.size()];
    if (!within(point.s_m, track.pit->from_s_m, track.pit->to_s_m)) break;
    pit.json(beside(point, track.pit->offset_m));
  }
  return pit.str();
}

std::string json_of(const Track& track, const std::vector<CoursePoint>& line,
                    const std::vector<state::CornerWindow>& corner_windows) {
  Array centre, left, right, corners;
  for (std::size_t i = 0; i < line.size(); i += kDrawEvery) {
    const CoursePoint& point = line[i];
    const Knot knot = at(track.knots, point.s_m, track.length_m);
    centre.json(numbers({point.x_m, point.y_m, point.s_m}));
    left.json(beside(point, knot.left_m));
    right.json(beside(point, -knot.right_m));
  }
  int number = 0;
  for (const state::CornerWindow& corner : corner_windows) {
    corners.json(Object{}
                     .text("name", "turn " + std::to_string(++number))
                     .number("from_s", corner.from_s_m)
                     .number("to_s", corner.to_s_m)
                     .str());
  }
  return Object{}
      .text("name", track.name)
      .number("length_m", track.length_m)
      .json("datum", Object{}
                         .number("latitude_deg", track.datum.latitude_deg)
                         .number("longitude_deg", track.datum.longitude_deg)
                         .str())
      .json("centre", centre.str())
      .json("left", left.str())
      .json("right", right.str())
      .json("lines", "[]")
      .json("pit", pit_text(track, line))
      .json("corners", corners.str())
      .json("sectors", "[]")
      .str();
}

}  // namespace

Result<TrackDocument, Problem> read_track(const std::string& path) {
  const auto document = yaml::load_file(path);
  if (!document) return Unexpected{document.error()};
  const auto track = yaml::read(*document, [](yaml::StrictMap& map) { return read(map); });
  if (!track) return Unexpected{track.error()};
  const std::vector<CoursePoint> line = closed_line(*track);
  auto course = state::Course::make(line, track->length_m);
  if (!course) return Unexpected{Problem{path, course.error().what}};
  if (const auto& pit = track->pit) course->set_pit({pit->from_s_m, pit->to_s_m, pit->offset_m});
  TrackDocument made;
  made.datum = track->datum;
  made.json = json_of(*track, line, course->corners());
  made.course = *std::move(course);
  return made;
}

}  // namespace pitwall::publishers::console
