// SPDX-License-Identifier: Apache-2.0
#include "vehicle/world/track_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

namespace pitwall::world {
namespace {

constexpr double kPointSpacing_m = 1.0;
constexpr double kLengthMin_m = 50.0, kLengthMax_m = 50'000.0;  // bounds the work of build()
constexpr std::size_t kKnotsMin = 4, kKnotsMax = 100'000;
constexpr double kBankMax_rad = from_deg(45.0);
constexpr double kCorrectionMax = 0.02;     // of the largest curvature
constexpr double kClosedPosition_m = 1e-7;  // where the iteration stops
constexpr double kClosedHeading_rad = 1e-12;
constexpr int kClosingIterations = 20;
constexpr double kHintReach_m = 50.0;
constexpr double kWallStep_m = 4.0;  // resolution at which crossing walls are looked for
constexpr double kTurn_rad = 2.0 * std::numbers::pi;

template <class... Args>
std::string format(const char* pattern, Args... args) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), pattern, args...);
  return text.data();
}

Unexpected<Problem> refuse(const TrackDescription& d, const std::string& where,
                           const std::string& what) {
  return pitwall::refuse((d.source.empty() ? d.name : d.source) + where, what);
}

std::string knot_place(std::size_t i, double s_m) {
  return format(":knot %zu (s = %.1f m)", i + 1, s_m);
}

std::optional<std::string> fault_of_knot(const TrackDescription& d, std::size_t i) {
  const TrackKnot& k = d.knots[i];
  for (const double v : {k.s_m, k.curvature_per_m, k.bank_rad, k.width_left_m, k.width_right_m})
    if (!std::isfinite(v)) return "a value is missing or not a number";
  if (k.s_m < 0.0 || k.s_m >= d.length_m) return "the station is outside of the lap";
  if (i > 0 && k.s_m <= d.knots[i - 1].s_m) return "the stations do not increase";
  if (std::abs(k.bank_rad) > kBankMax_rad) return "banking beyond 45 degrees";
  if (k.width_left_m <= 0.0 || k.width_right_m <= 0.0) return "a width is not positive";
  if (k.curvature_per_m * k.width_left_m >= 1.0 || -k.curvature_per_m * k.width_right_m >= 1.0)
    return "the inner wall lies beyond the centre of the turn, so it crosses itself";
  return std::nullopt;
}

std::optional<std::string> fault_of_pit(const TrackDescription& d) {
  const PitLane& p = *d.pit;
  for (const double v : {p.entry_s_m, p.exit_s_m, p.offset_m, p.width_m, p.speed_limit_mps})
    if (!std::isfinite(v)) return "a value is missing or not a number";
  for (const double s_m : {p.entry_s_m, p.exit_s_m})
    if (s_m < 0.0 || s_m >= d.length_m) return "a station is outside of the lap";
  if (p.width_m <= 0.0) return "the width is not positive";
  if (p.speed_limit_mps <= 0.0) return "the speed limit is not positive";
  const auto ahead_m = [&](double s_m) {
    return s_m >= p.entry_s_m ? s_m - p.entry_s_m : s_m - p.entry_s_m + d.length_m;
  };
  const double along = ahead_m(p.box_s_m) / ahead_m(p.exit_s_m);
  const bool on_ramp = along < kPitRampShare || along > 1.0 - kPitRampShare;
  if (on_ramp) return "the box is not where the car is in the lane's middle";
  return std::nullopt;
}

std::optional<Problem> fault_of(const TrackDescription& d) {
  if (!(d.length_m >= kLengthMin_m && d.length_m <= kLengthMax_m))
    return refuse(d, ":length_m", "expected 50 m to 50 km").error;
  for (const double v : {d.datum_latitude_deg, d.datum_longitude_deg, d.datum_height_m})
    if (!std::isfinite(v)) return refuse(d, ":datum", "a value is missing or not a number").error;
  if (std::abs(d.datum_latitude_deg) > 90.0 || std::abs(d.datum_longitude_deg) > 180.0)
    return refuse(d, ":datum", "latitude or longitude out of range").error;
  for (const double v : {d.start_x_m, d.start_y_m, d.start_yaw_rad})
    if (!std::isfinite(v)) return refuse(d, ":start", "a value is missing or not a number").error;
  if (d.knots.size() < kKnotsMin) return refuse(d, ":knots", "expected at least 4").error;
  if (d.knots.size() > kKnotsMax) return refuse(d, ":knots", "expected at most 100000").error;
  for (std::size_t i = 0; i < d.knots.size(); ++i)
    if (const auto what = fault_of_knot(d, i))
      return refuse(d, knot_place(i, d.knots[i].s_m), *what).error;
  if (d.pit)
    if (const auto what = fault_of_pit(d)) return refuse(d, ":pit", *what).error;
  return std::nullopt;
}

double mix(double a, double b, double t) { return a + (b - a) * t; }

// The knots sampled at equal stations; no position yet.
std::vector<TrackPoint> sample(const TrackDescription& d) {
  const auto count = static_cast<std::size_t>(std::ceil(d.length_m / kPointSpacing_m));
  std::vector<TrackPoint> points(count);
  std::size_t next = 0;  // first knot beyond the station
  for (std::size_t i = 0; i < count; ++i) {
    const double s_m = d.length_m * static_cast<double>(i) / static_cast<double>(count);
    while (next < d.knots.size() && d.knots[next].s_m <= s_m) ++next;
    const TrackKnot& a = next == 0 ? d.knots.back() : d.knots[next - 1];
    const TrackKnot& b = next == d.knots.size() ? d.knots.front() : d.knots[next];
    const double from_m = next == 0 ? a.s_m - d.length_m : a.s_m;
    const double to_m = next == d.knots.size() ? b.s_m + d.length_m : b.s_m;
    const double t = (s_m - from_m) / (to_m - from_m);
    points[i] = {.s_m = s_m,
                 .curvature_per_m = mix(a.curvature_per_m, b.curvature_per_m, t),
                 .bank_rad = mix(a.bank_rad, b.bank_rad, t),
                 .width_left_m = mix(a.width_left_m, b.width_left_m, t),
                 .width_right_m = mix(a.width_right_m, b.width_right_m, t)};
  }
  return points;
}

// Heading t metres behind a point, with curvature linear up to the next one.
double heading_after(double yaw_rad, double curvature_per_m, double next_per_m, double t_m,
                     double spacing_m) {
  return yaw_rad + t_m * (curvature_per_m + 0.5 * (next_per_m - curvature_per_m) * t_m / spacing_m);
}

struct Pose {
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0;
};

// Positions and headings along the curvature; returns the pose one lap on. Gauss-Legendre with 3
// nodes: the error over a segment of 1 m is below 1e-15 m for any radius that a car can drive.
Pose integrate(const Pose& start, double spacing_m, std::vector<TrackPoint>& points) {
  constexpr double kNode = 0.77459666924148337704;  // sqrt(3/5)
  constexpr std::array<double, 3> kAt{0.5 - 0.5 * kNode, 0.5, 0.5 + 0.5 * kNode};
  constexpr std::array<double, 3> kWeight{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  Pose p = start;
  for (std::size_t i = 0; i < points.size(); ++i) {
    TrackPoint& a = points[i];
    const double next_per_m = points[(i + 1) % points.size()].curvature_per_m;
    a.x_m = p.x_m, a.y_m = p.y_m, a.yaw_rad = p.yaw_rad;
    for (std::size_t k = 0; k < kAt.size(); ++k) {
      const double yaw_rad =
          heading_after(a.yaw_rad, a.curvature_per_m, next_per_m, kAt[k] * spacing_m, spacing_m);
      p.x_m += spacing_m * kWeight[k] * std::cos(yaw_rad);
      p.y_m += spacing_m * kWeight[k] * std::sin(yaw_rad);
    }
    p.yaw_rad = heading_after(a.yaw_rad, a.curvature_per_m, next_per_m, spacing_m, spacing_m);
  }
  return p;
}

// Solves a symmetric 3 x 3 system by Cramer's rule; nothing when it is singular.
using Row = std::array<double, 3>;
std::optional<Row> solve(const std::array<Row, 3>& m, const Row& b) {
  const auto det = [](const Row& u, const Row& v, const Row& w) {
    return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
           u[2] * (v[0] * w[1] - v[1] * w[0]);
  };
  const double d = det(m[0], m[1], m[2]);
  if (!(std::abs(d) > 0.0)) return std::nullopt;
  return Row{det(b, m[1], m[2]) / d, det(m[0], b, m[2]) / d, det(m[0], m[1], b) / d};
}

// Adds the curvature a + b x + c y that takes the residual (dx, dy, dyaw) away to first order.
// From d x(L) = -integral of (y(L) - y) dk and d y(L) = integral of (x(L) - x) dk, of all such dk
// the one with the smallest square is a combination of 1, x and y (Lagrange multipliers).
bool correct(const Pose& end, const Pose& residual, double spacing_m,
             std::vector<TrackPoint>& points) {
  std::array<Row, 3> gram{};
  for (const TrackPoint& p : points) {
    const Row basis{1.0, (p.x_m - end.x_m), (p.y_m - end.y_m)};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) gram[i][j] += basis[i] * basis[j] * spacing_m;
  }
  // d yaw = <1, dk>, d y = -<x - x(L), dk>, d x = <y - y(L), dk>; each shall be minus the residual.
  const auto weight = solve(gram, {-residual.yaw_rad, residual.y_m, -residual.x_m});
  if (!weight) return false;
  for (TrackPoint& p : points)
    p.curvature_per_m +=
        (*weight)[0] + (*weight)[1] * (p.x_m - end.x_m) + (*weight)[2] * (p.y_m - end.y_m);
  return true;
}

double largest_curvature(const std::vector<TrackPoint>& points) {
  double largest = 0.0;
  for (const TrackPoint& p : points) largest = std::max(largest, std::abs(p.curvature_per_m));
  return largest;
}

// Makes the line closed; says what is wrong when the table does not describe a closed line.
std::optional<std::string> close_line(const Pose& start, double spacing_m,
                                      std::vector<TrackPoint>& points) {
  const std::vector<TrackPoint> table = points;
  const double limit_per_m = kCorrectionMax * largest_curvature(points);
  std::string first_gap;
  for (int i = 0; i < kClosingIterations; ++i) {
    const Pose end = integrate(start, spacing_m, points);
    const double turned_rad = end.yaw_rad - start.yaw_rad;
    const Pose gap{end.x_m - start.x_m, end.y_m - start.y_m,
                   turned_rad - std::copysign(kTurn_rad, turned_rad)};
    const double distance_m = std::hypot(gap.x_m, gap.y_m);
    if (i == 0)
      first_gap = format("the line does not close: it ends %.2f m and %.2f degrees off its start",
                         distance_m, to_deg(gap.yaw_rad));
    if (distance_m < kClosedPosition_m && std::abs(gap.yaw_rad) < kClosedHeading_rad)
      return std::nullopt;
    if (!correct(end, gap, spacing_m, points)) return first_gap;
    for (std::size_t p = 0; p < points.size(); ++p)
      if (!(std::abs(points[p].curvature_per_m - table[p].curvature_per_m) <= limit_per_m))
        return first_gap;
  }
  return first_gap;
}

struct Segment {
  double ax_m, ay_m, bx_m, by_m;
  double s_m;
};

double side_of(const Segment& l, double x_m, double y_m) {
  return (l.bx_m - l.ax_m) * (y_m - l.ay_m) - (l.by_m - l.ay_m) * (x_m - l.ax_m);
}

bool cross(const Segment& a, const Segment& b) {
  if (std::max(a.ax_m, a.bx_m) < std::min(b.ax_m, b.bx_m) ||
      std::max(b.ax_m, b.bx_m) < std::min(a.ax_m, a.bx_m))
    return false;
  return side_of(a, b.ax_m, b.ay_m) * side_of(a, b.bx_m, b.by_m) < 0.0 &&
         side_of(b, a.ax_m, a.ay_m) * side_of(b, a.bx_m, a.by_m) < 0.0;
}

std::vector<Segment> walls(const std::vector<TrackPoint>& points, double spacing_m) {
  const auto step = std::max(std::size_t{1}, static_cast<std::size_t>(kWallStep_m / spacing_m));
  std::vector<Segment> segments;
  const auto wall_point = [&](std::size_t i, bool left) {
    const TrackPoint& p = points[i % points.size()];
    const double n_m = left ? p.width_left_m : -p.width_right_m;
    return std::array{p.x_m - n_m * std::sin(p.yaw_rad), p.y_m + n_m * std::cos(p.yaw_rad)};
  };
  for (const bool left : {true, false})
    for (std::size_t i = 0; i < points.size(); i += step) {
      const auto a = wall_point(i, left);
      const auto b = wall_point(std::min(i + step, points.size()), left);
      segments.push_back({a[0], a[1], b[0], b[1], points[i].s_m});
    }
  return segments;
}

std::optional<std::string> crossing_walls(const std::vector<TrackPoint>& points, double spacing_m) {
  const std::vector<Segment> w = walls(points, spacing_m);
  for (std::size_t i = 0; i < w.size(); ++i)
    for (std::size_t j = i + 1; j < w.size(); ++j)
      if (cross(w[i], w[j]))
        return format("the walls at s = %.0f m and s = %.0f m cross", w[i].s_m, w[j].s_m);
  return std::nullopt;
}

}  // namespace

Result<TrackMap, Problem> TrackMap::build(const TrackDescription& description) {
  const TrackDescription& d = description;
  if (auto problem = fault_of(d)) return Unexpected{std::move(*problem)};
  TrackMap map;
  map.name_ = d.name;
  map.length_m_ = d.length_m;
  map.datum_latitude_deg_ = d.datum_latitude_deg;
  map.datum_longitude_deg_ = d.datum_longitude_deg;
  map.datum_height_m_ = d.datum_height_m;
  map.pit_ = d.pit;
  map.points_ = sample(d);
  map.spacing_m_ = d.length_m / static_cast<double>(map.points_.size());
  const Pose start{d.start_x_m, d.start_y_m, d.start_yaw_rad};
  if (const auto what = close_line(start, map.spacing_m_, map.points_))
    return refuse(d, ":knots", *what);
  for (TrackPoint& p : map.points_) p.yaw_rad = wrap_pi(p.yaw_rad);
  if (const auto what = crossing_walls(map.points_, map.spacing_m_))
    return refuse(d, ":knots", *what);
  return map;
}

double TrackMap::wrap_station(double s_m) const {
  double wrapped_m = s_m - length_m_ * std::floor(s_m / length_m_);
  if (wrapped_m < 0.0) wrapped_m += length_m_;  // the quotient was rounded up
  return wrapped_m >= length_m_ ? 0.0 : wrapped_m;
}

double TrackMap::station_ahead(double from_s_m, double to_s_m) const {
  return wrap_station(to_s_m - from_s_m);
}

// Cubic Hermite between two points of the line: off by less than 1e-9 m at 1 m spacing.
TrackPoint TrackMap::at(double s_m) const {
  const double station_m = wrap_station(s_m);
  if (!std::isfinite(station_m)) return {};
  const std::size_t i =
      std::min(static_cast<std::size_t>(station_m / spacing_m_), points_.size() - 1);
  const TrackPoint& a = points_[i];
  const TrackPoint& b = points_[(i + 1) % points_.size()];
  const double t_m = station_m - a.s_m;
  const double u = t_m / spacing_m_;
  const double b_weight = u * u * (3.0 - 2.0 * u);
  const double a_slope_m = spacing_m_ * u * (1.0 - u) * (1.0 - u);
  const double b_slope_m = spacing_m_ * u * u * (u - 1.0);
  return {.s_m = station_m,
          .x_m = mix(a.x_m, b.x_m, b_weight) + a_slope_m * std::cos(a.yaw_rad) +
                 b_slope_m * std::cos(b.yaw_rad),
          .y_m = mix(a.y_m, b.y_m, b_weight) + a_slope_m * std::sin(a.yaw_rad) +
                 b_slope_m * std::sin(b.yaw_rad),
          .yaw_rad = wrap_pi(
              heading_after(a.yaw_rad, a.curvature_per_m, b.curvature_per_m, t_m, spacing_m_)),
          .curvature_per_m = mix(a.curvature_per_m, b.curvature_per_m, u),
          .bank_rad = mix(a.bank_rad, b.bank_rad, u),
          .width_left_m = mix(a.width_left_m, b.width_left_m, u),
          .width_right_m = mix(a.width_right_m, b.width_right_m, u)};
}

Curvilinear TrackMap::project(double x_m, double y_m, std::optional<double> hint_s_m) const {
  if (!std::isfinite(x_m) || !std::isfinite(y_m)) return {};
  const auto count = points_.size();
  std::size_t first = 0, candidates = count;
  if (hint_s_m && std::isfinite(*hint_s_m)) {
    const auto reach = static_cast<std::size_t>(kHintReach_m / spacing_m_);
    const auto centre = static_cast<std::size_t>(wrap_station(*hint_s_m) / spacing_m_);
    first = (centre + count - std::min(reach, count)) % count;
    candidates = std::min(count, 2 * reach + 1);
  }
  std::size_t nearest = first;
  double nearest_m2 = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < candidates; ++k) {
    const std::size_t i = first + k < count ? first + k : first + k - count;
    const double dx_m = x_m - points_[i].x_m, dy_m = y_m - points_[i].y_m;
    const double m2 = dx_m * dx_m + dy_m * dy_m;
    if (m2 < nearest_m2) nearest = i, nearest_m2 = m2;
  }
  // Newton on (p - r(s)) . t(s) = 0; the step is bounded so that a point near the centre of a turn
  // cannot throw it out of the neighbourhood of the nearest point.
  double s_m = points_[nearest].s_m, n_m = 0.0;
  constexpr int kNewtonSteps = 6;
  constexpr double kRadiusLeftMin = 0.05;  // of 1 - kappa n
  for (int k = 0; k < kNewtonSteps; ++k) {
    const TrackPoint r = at(s_m);
    const double cos_yaw = std::cos(r.yaw_rad), sin_yaw = std::sin(r.yaw_rad);
    const double dx_m = x_m - r.x_m, dy_m = y_m - r.y_m;
    const double along_m = dx_m * cos_yaw + dy_m * sin_yaw;
    n_m = dy_m * cos_yaw - dx_m * sin_yaw;
    const double step_m = along_m / std::max(1.0 - r.curvature_per_m * n_m, kRadiusLeftMin);
    s_m = s_m + std::clamp(step_m, -2.0 * spacing_m_, 2.0 * spacing_m_);
    if (std::abs(step_m) < 1e-10) break;
  }
  return {wrap_station(s_m), n_m};
}

TrackPoint TrackMap::offset(double s_m, double n_m) const {
  TrackPoint p = at(s_m);
  p.x_m -= n_m * std::sin(p.yaw_rad);
  p.y_m += n_m * std::cos(p.yaw_rad);
  return p;
}

RoadPoint TrackMap::road(double s_m, double n_m) const {
  const TrackPoint here = at(s_m);
  const TrackPoint before = at(s_m - spacing_m_), after = at(s_m + spacing_m_);
  const double change = (std::tan(after.bank_rad) - std::tan(before.bank_rad)) / (2.0 * spacing_m_);
  const double stretch = 1.0 - n_m * here.curvature_per_m;  // of a step along the offset line
  return {.height_m = -n_m * std::tan(here.bank_rad),
          .bank_rad = here.bank_rad,
          .climb_rad = std::atan(-n_m * change / stretch)};
}

}  // namespace pitwall::world
