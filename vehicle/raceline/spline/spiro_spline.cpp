// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/spline/spiro_spline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "protocol/vocabulary/text.hpp"
#include "vehicle/raceline/spline/banded_matrix.hpp"

namespace pitwall::raceline {
namespace {

constexpr std::size_t kPointsMin = 3;
constexpr int kIterationsMax = 20;
constexpr std::array kStages{1, 4, 16, 64};
constexpr double kStepMax = 1e3;       // of a coefficient: on its way to nowhere
constexpr double kStepSettled = 1e-8;  // of a coefficient; the step after it would be its square
constexpr double kTurnMax_rad = 2.0 * std::numbers::pi;  // of one segment: more is a coil
constexpr std::size_t kCurvatures = 3;  // the curvature and two derivatives go on through a point

// The continuity of a spline as a system of equations in the coefficients of its segments.
class Continuity {
 public:
  explicit Continuity(const std::vector<SpiroSegment>& segments) : segments_(segments) {}

  std::size_t order() const { return kSpiroOrder * segments_.size(); }

  // The residuals at the current coefficients; their derivatives go into the matrix.
  std::vector<double> residuals(BandedMatrix& matrix) const {
    std::vector<SegmentShape> shapes;
    shapes.reserve(segments_.size());
    for (const SpiroSegment& segment : segments_) shapes.push_back(shape_of(segment.k));
    std::vector<double> r(order(), 0.0);
    const std::size_t n = segments_.size();
    for (std::size_t i = 0; i < n; ++i) join((i + n - 1) % n, i, row_of(i), shapes, r, matrix);
    return r;
  }

  BandedMatrix matrix() const {
    constexpr std::size_t kReach = 3 * kSpiroOrder - 1;  // neighbours are two blocks apart
    const std::size_t reach = std::min(kReach, order() - 1);
    return {order(), reach, reach};
  }

  // Place of a segment's first coefficient.
  std::size_t row_of(std::size_t segment) const {
    return kSpiroOrder * folded(segment, segments_.size());
  }

 private:
  // What goes on from segment `a` to segment `b`. The curvatures are those of the real lengths,
  // made free of units by the mean chord.
  void join(std::size_t a, std::size_t b, std::size_t row, const std::vector<SegmentShape>& shapes,
            std::vector<double>& r, BandedMatrix& matrix) const {
    const double mean_m = 0.5 * (segments_[a].chord_m + segments_[b].chord_m);
    r[row] = shapes[a].end_heading.value - shapes[b].start_heading.value - segments_[b].bend_rad;
    write(row, a, shapes[a].end_heading.by_k, 1.0, matrix);
    write(row, b, shapes[b].start_heading.by_k, -1.0, matrix);
    for (std::size_t order = 0; order < kCurvatures; ++order) {
      curvature(a, 0.5, order, 1.0, mean_m, row + 1 + order, shapes[a], r, matrix);
      curvature(b, -0.5, order, -1.0, mean_m, row + 1 + order, shapes[b], r, matrix);
    }
  }

  void curvature(std::size_t segment, double u, std::size_t order, double sign, double mean_m,
                 std::size_t row, const SegmentShape& shape, std::vector<double>& r,
                 BandedMatrix& matrix) const {
    const SpiroSegment& s = segments_[segment];
    const double ratio = mean_m / s.chord_m;
    const double scale = ratio * shape.chord.value;  // mean_m over the length of the arc
    const double power = std::pow(scale, static_cast<double>(order));
    const double value = curvature_at(s.k, u, order);
    r[row] += sign * value * power * scale;
    SpiroCoefficients by_k = curvature_weights(u, order);
    for (std::size_t i = 0; i < kSpiroOrder; ++i)
      by_k[i] = power * (scale * by_k[i] +
                         static_cast<double>(order + 1) * value * ratio * shape.chord.by_k[i]);
    write(row, segment, by_k, sign, matrix);
  }

  void write(std::size_t row, std::size_t segment, const SpiroCoefficients& by_k, double sign,
             BandedMatrix& matrix) const {
    for (std::size_t i = 0; i < kSpiroOrder; ++i)
      matrix.add(row, row_of(segment) + i, sign * by_k[i]);
  }

  const std::vector<SpiroSegment>& segments_;
};

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

// The chords; nothing where two neighbours are at one place or a number is none.
std::optional<std::vector<SpiroSegment>> chords_of(std::span<const Place> points) {
  const std::size_t n = points.size();
  std::vector<SpiroSegment> segments(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Place &a = points[i], &b = points[(i + 1) % n];
    segments[i].start = a;
    segments[i].chord_m = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    segments[i].chord_yaw_rad = std::atan2(b.y_m - a.y_m, b.x_m - a.x_m);
    if (!(segments[i].chord_m > 0.0) || !std::isfinite(segments[i].chord_m)) return std::nullopt;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = (i + n - 1) % n;
    segments[i].bend_rad = wrap_pi(segments[i].chord_yaw_rad - segments[before].chord_yaw_rad);
  }
  return segments;
}

bool is_without_coils(const std::vector<SpiroSegment>& segments) {
  return std::ranges::all_of(segments, [](const SpiroSegment& s) {
    return std::abs(heading_at(s.k, 0.5) - heading_at(s.k, -0.5)) < kTurnMax_rad;
  });
}

// Newton's method; the number of steps taken, nothing where they lead nowhere.
std::optional<int> iterate(std::vector<SpiroSegment>& segments) {
  const Continuity continuity{segments};
  for (int iteration = 1; iteration <= kIterationsMax; ++iteration) {
    BandedMatrix matrix = continuity.matrix();
    std::vector<double> step = continuity.residuals(matrix);
    if (!matrix.solve(step)) return std::nullopt;
    for (std::size_t i = 0; i < segments.size(); ++i)
      for (std::size_t j = 0; j < kSpiroOrder; ++j)
        segments[i].k[j] -= step[continuity.row_of(i) + j];
    const double moved = largest(step);
    if (!(moved < kStepMax)) return std::nullopt;
    if (moved < kStepSettled) return iteration;
  }
  return std::nullopt;
}

// Straight segments solve the problem whose chords do not bend. From there the bends grow to what
// they are, in one stage where that converges, else in more of them.
std::optional<int> solve(std::vector<SpiroSegment>& segments) {
  for (const int stages : kStages) {
    std::vector<SpiroSegment> bent = segments;
    int iterations = 0;
    for (int stage = 1; stage <= stages; ++stage) {
      for (std::size_t i = 0; i < segments.size(); ++i)
        bent[i].bend_rad = segments[i].bend_rad * stage / stages;
      const auto steps = iterate(bent);
      if (!steps || !is_without_coils(bent)) break;
      iterations += *steps;
      if (stage < stages) continue;
      segments = std::move(bent);
      return iterations;
    }
  }
  return std::nullopt;
}

}  // namespace

Result<SpiroSpline, Problem> SpiroSpline::through(std::span<const Place> points) {
  if (points.size() < kPointsMin)
    return refuse("spline",
                  formatted("%zu points, at least %zu expected", points.size(), kPointsMin));
  auto segments = chords_of(points);
  if (!segments)
    return refuse("spline", "two neighbours at one place, or a coordinate that is no number");
  const auto iterations = solve(*segments);
  if (!iterations)
    return refuse("spline",
                  "no smooth curve found through the points: too sharp a bend, or points "
                  "too unevenly spaced");
  SpiroSpline spline;
  spline.iterations_ = *iterations;
  for (SpiroSegment& s : *segments) {
    const SegmentShape shape = shape_of(s.k);
    s.length_m = s.chord_m / shape.chord.value;
    s.start_s_m = spline.length_m_;
    s.middle_yaw_rad = s.chord_yaw_rad + shape.start_heading.value - heading_at(s.k, -0.5);
    spline.length_m_ += s.length_m;
  }
  spline.segments_ = *std::move(segments);
  return spline;
}

SplinePoint SpiroSpline::at(double s_m) const {
  const auto after = std::ranges::upper_bound(segments_, s_m, {}, &SpiroSegment::start_s_m);
  const SpiroSegment& s = after == segments_.begin() ? segments_.front() : *(after - 1);
  const double u = std::clamp((s_m - s.start_s_m) / s.length_m, 0.0, 1.0) - 0.5;
  const Displacement d = displacement(s.k, -0.5, u);
  const double c = std::cos(s.middle_yaw_rad), n = std::sin(s.middle_yaw_rad);
  return {.s_m = s_m,
          .x_m = s.start.x_m + s.length_m * (c * d.x - n * d.y),
          .y_m = s.start.y_m + s.length_m * (n * d.x + c * d.y),
          .yaw_rad = wrap_pi(s.middle_yaw_rad + heading_at(s.k, u)),
          .curvature_per_m = curvature_at(s.k, u) / s.length_m,
          .curvature_rate_per_m2 = curvature_at(s.k, u, 1) / (s.length_m * s.length_m)};
}

}  // namespace pitwall::raceline
