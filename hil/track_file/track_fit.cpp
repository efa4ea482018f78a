// SPDX-License-Identifier: Apache-2.0
#include "hil/track_file/track_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "hil/report/text.hpp"
#include "hil/track_file/closed_curve.hpp"
#include "hil/track_file/crossings.hpp"
#include "hil/track_file/periodic_table.hpp"
#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::track_file {
namespace {

constexpr double kHeadingStep_m = 1.0;
constexpr double kNear_m = 0.25;      // points closer to each other say nothing of a track
constexpr double kGapMax_m = 60.0;    // between two points: what lies between is not known
constexpr double kOpenSteps = 2.0;    // of the longest step: where the last one is no step
constexpr double kMovedMax_m = 1.0;   // from a point to the smoothed line
constexpr double kRowsDiffer = 0.02;  // curvature of the first and last row, of the largest

Unexpected<Problem> refuse(const TrackCsv& csv, std::size_t row, const std::string& what) {
  return Unexpected{Problem{place_of(csv, row), what}};
}

double distance_m(const CsvRow& a, const CsvRow& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

// Indices of the rows that say something: not those beside their neighbour, and not a last one that
// is the first again.
std::vector<std::size_t> distinct(const TrackCsv& csv) {
  std::vector<std::size_t> kept{0};
  for (std::size_t i = 1; i < csv.rows.size(); ++i)
    if (distance_m(csv.rows[kept.back()], csv.rows[i]) >= kNear_m) kept.push_back(i);
  while (kept.size() > 1 && distance_m(csv.rows[kept.back()], csv.rows[0]) < kNear_m)
    kept.pop_back();
  return kept;
}

Result<bool, Problem> closed(const TrackCsv& csv, const std::vector<std::size_t>& kept) {
  double longest_m = 0.0;
  for (std::size_t j = 1; j < kept.size(); ++j) {
    const double step_m = distance_m(csv.rows[kept[j - 1]], csv.rows[kept[j]]);
    if (step_m > kGapMax_m)
      return refuse(csv, kept[j], formatted("a gap of %.1f m to the point before", step_m));
    longest_m = std::max(longest_m, step_m);
  }
  const double last_m = distance_m(csv.rows[kept.back()], csv.rows[kept[0]]);
  if (last_m > kOpenSteps * longest_m)
    return refuse(
        csv, kept.back(),
        formatted("open loop: the last point lies %.1f m from the first, and no two others "
                  "are farther than %.1f m apart",
                  last_m, longest_m));
  return true;
}

// What the knots are made from, however the line was given.
struct Line {
  double length_m = 0.0;
  Place start;
  double turn_rad = 0.0;                      // over the lap
  std::vector<PeriodicTable::Entry> yaw_rad;  // less the share of that turn: periodic
  std::vector<std::size_t> rows;              // that were kept; below, one entry for each
  std::vector<PeriodicTable::Entry> width_right_m, width_left_m, bank_rad;

  void add_heading(double s_m, double heading_rad) {
    yaw_rad.push_back({s_m, heading_rad - turn_rad * s_m / length_m});
  }
  void add_row(const CsvRow& row, double s_m, double n_m) {
    width_left_m.push_back({s_m, row.width_left_m + n_m});
    width_right_m.push_back({s_m, row.width_right_m - n_m});
    bank_rad.push_back({s_m, std::isfinite(row.bank_rad) ? row.bank_rad : 0.0});
  }
};

// Where the measured point lies beside the curve: the nearest piece is near the same chord length.
struct Beside {
  double s_m = 0.0, n_m = 0.0;
};

Beside beside(const ClosedCurve& curve, std::size_t near, const CsvRow& row) {
  constexpr std::size_t kReach = 8;
  const std::size_t n = curve.points.size() - 1;
  Beside best;
  double nearest_m = 1e300;
  for (std::size_t k = 0; k <= 2 * kReach; ++k) {
    const CurvePoint& p = curve.points[(near + n + k - kReach) % n];
    const double dx_m = row.x_m - p.x_m, dy_m = row.y_m - p.y_m;
    if (std::hypot(dx_m, dy_m) >= nearest_m) continue;
    nearest_m = std::hypot(dx_m, dy_m);
    const double cos_yaw = std::cos(p.yaw_rad), sin_yaw = std::sin(p.yaw_rad);
    best = {p.s_m + dx_m * cos_yaw + dy_m * sin_yaw, dy_m * cos_yaw - dx_m * sin_yaw};
  }
  return best;
}

Result<Line, Problem> line_of_places(const TrackCsv& csv, const FitOptions& options, Fit& fit) {
  Line line;
  line.rows = distinct(csv);
  if (line.rows.size() < kRowsMin)
    return refuse(csv, csv.rows.size() - 1,
                  formatted("only %zu points at least %.2f m apart", line.rows.size(), kNear_m));
  fit.removed = csv.rows.size() - line.rows.size();
  if (const auto ok = closed(csv, line.rows); !ok) return Unexpected{ok.error()};
  if (const auto crossing = crossing_of(csv, line.rows))
    return refuse(csv, crossing->row, crossing->what);

  std::vector<Place> places;
  for (const std::size_t i : line.rows) places.push_back({csv.rows[i].x_m, csv.rows[i].y_m});
  const ClosedCurve curve = smooth_curve(places, options.smoothing_m);
  const std::vector<double> along_m = chord_lengths(places);
  line.length_m = curve.length_m();
  line.start = {curve.points[0].x_m, curve.points[0].y_m};
  line.turn_rad = curve.points.back().yaw_rad - curve.points.front().yaw_rad;
  for (std::size_t i = 0; i + 1 < curve.points.size(); ++i)
    line.add_heading(curve.points[i].s_m, curve.points[i].yaw_rad);
  const double step_m = along_m.back() / static_cast<double>(curve.points.size() - 1);
  std::size_t farthest = 0;
  for (std::size_t j = 0; j < line.rows.size(); ++j) {
    const CsvRow& row = csv.rows[line.rows[j]];
    const Beside at = beside(curve, static_cast<std::size_t>(along_m[j] / step_m), row);
    line.add_row(row, at.s_m, at.n_m);
    if (std::abs(at.n_m) <= fit.moved_m) continue;
    fit.moved_m = std::abs(at.n_m), fit.moved_s_m = at.s_m;
    farthest = line.rows[j];
  }
  if (fit.moved_m > kMovedMax_m)
    return refuse(csv, farthest,
                  formatted("%.2f m beside the smoothed line: an outlier, or smoothing over %.0f m "
                            "is too much for this turn",
                            fit.moved_m, options.smoothing_m));
  return line;
}

Result<Line, Problem> line_of_stations(const TrackCsv& csv, Fit& fit) {
  const CsvRow &first = csv.rows.front(), &last = csv.rows.back();
  double largest_per_m = 0.0;
  for (const CsvRow& row : csv.rows)
    largest_per_m = std::max(largest_per_m, std::abs(row.curvature_per_m));
  if (std::abs(last.curvature_per_m - first.curvature_per_m) > kRowsDiffer * largest_per_m)
    return refuse(
        csv, csv.rows.size() - 1,
        "open loop: with stations the last row has to be the first one again, one lap on");
  Line line;
  fit.removed = 1;
  line.length_m = last.s_m - first.s_m;
  line.start = {0.0, 0.0};
  for (std::size_t i = 1; i < csv.rows.size(); ++i)
    line.turn_rad += 0.5 * (csv.rows[i].s_m - csv.rows[i - 1].s_m) *
                     (csv.rows[i].curvature_per_m + csv.rows[i - 1].curvature_per_m);
  double yaw_rad = 0.0;
  for (std::size_t i = 0; i + 1 < csv.rows.size(); ++i) {
    const CsvRow &a = csv.rows[i], &b = csv.rows[i + 1];
    const double piece_m = b.s_m - a.s_m;
    const double slope_per_m2 = (b.curvature_per_m - a.curvature_per_m) / piece_m;
    const auto steps = static_cast<std::size_t>(std::ceil(piece_m / kHeadingStep_m));
    const auto heading_rad = [&](double t_m) {
      return yaw_rad + t_m * (a.curvature_per_m + 0.5 * slope_per_m2 * t_m);
    };
    for (std::size_t k = 0; k < steps; ++k) {
      const double t_m = piece_m * static_cast<double>(k) / static_cast<double>(steps);
      line.add_heading(a.s_m - first.s_m + t_m, heading_rad(t_m));
    }
    yaw_rad = heading_rad(piece_m);
    line.rows.push_back(i);
    line.add_row(a, a.s_m - first.s_m, 0.0);
  }
  return line;
}

// The walls of the smoothed line, knot by knot, and what no car could drive.
std::optional<Problem> fault_of(const TrackCsv& csv, const Line& line,
                                const world::TrackKnot& knot) {
  const double inner_m = knot.curvature_per_m > 0.0 ? knot.width_left_m : knot.width_right_m;
  const bool folds = std::abs(knot.curvature_per_m) * inner_m >= 1.0;
  const bool narrow = knot.width_left_m <= 0.0 || knot.width_right_m <= 0.0;
  if (!folds && !narrow) return std::nullopt;
  std::size_t nearest = 0;
  for (std::size_t j = 0; j < line.rows.size(); ++j) {
    const auto off_m = [&](std::size_t k) {
      return std::abs(std::remainder(line.bank_rad[k].s_m - knot.s_m, line.length_m));
    };
    if (off_m(j) < off_m(nearest)) nearest = j;
  }
  if (narrow)
    return Problem{place_of(csv, line.rows[nearest]),
                   "the smoothed line leaves the track: smooth over a shorter length"};
  return Problem{place_of(csv, line.rows[nearest]),
                 formatted("the turn's radius of %.1f m is less than the %.1f m to its inner wall",
                           1.0 / std::abs(knot.curvature_per_m), inner_m)};
}

Result<world::TrackDescription, Problem> knots_of(const TrackCsv& csv, const Line& line,
                                                  const FitOptions& options) {
  const PeriodicTable yaw{line.length_m, line.yaw_rad}, left{line.length_m, line.width_left_m},
      right{line.length_m, line.width_right_m}, bank{line.length_m, line.bank_rad};
  const auto count = static_cast<std::size_t>(
      std::max(std::round(line.length_m / options.knot_spacing_m), static_cast<double>(kRowsMin)));
  const double step_m = line.length_m / static_cast<double>(count);
  world::TrackDescription track;
  track.name = options.name;
  track.source = csv.name;
  track.length_m = line.length_m;
  track.datum_latitude_deg = options.latitude_deg;
  track.datum_longitude_deg = options.longitude_deg;
  track.datum_height_m = options.height_m;
  track.start_x_m = line.start.x_m, track.start_y_m = line.start.y_m;
  track.start_yaw_rad = wrap_pi(yaw.at(0.0));
  for (std::size_t i = 0; i < count; ++i) {
    const double s_m = step_m * static_cast<double>(i);
    const double from_m = s_m - 0.5 * step_m, to_m = s_m + 0.5 * step_m;
    const double mean_per_m = line.turn_rad / line.length_m;
    track.knots.push_back({.s_m = s_m,
                           .curvature_per_m = mean_per_m + (yaw.at(to_m) - yaw.at(from_m)) / step_m,
                           .bank_rad = bank.mean(from_m, to_m),
                           .width_left_m = left.least_near(s_m, step_m),
                           .width_right_m = right.least_near(s_m, step_m)});
    if (auto fault = fault_of(csv, line, track.knots.back())) return Unexpected{*fault};
  }
  return track;
}

void look_at_heights(const TrackCsv& csv, const Line& line, Fit& fit) {
  if (!csv.has_height) return;
  double low_m = csv.rows[0].height_m, high_m = low_m;
  fit.gradient_max = 0.0;
  for (std::size_t j = 0; j < line.rows.size(); ++j) {
    const std::size_t next = (j + 1) % line.rows.size();
    const double rise_m = csv.rows[line.rows[next]].height_m - csv.rows[line.rows[j]].height_m;
    const double run_m =
        std::abs(std::remainder(line.bank_rad[next].s_m - line.bank_rad[j].s_m, line.length_m));
    low_m = std::min(low_m, csv.rows[line.rows[j]].height_m);
    high_m = std::max(high_m, csv.rows[line.rows[j]].height_m);
    fit.gradient_max = std::max(fit.gradient_max, std::abs(rise_m) / std::max(run_m, kNear_m));
  }
  fit.height_range_m = high_m - low_m;
}

}  // namespace

Result<Fit, Problem> fit_track(const TrackCsv& csv, const FitOptions& options) {
  CHECK(csv.rows.size() >= kRowsMin && options.knot_spacing_m > 0.0 && options.smoothing_m > 0.0);
  Fit fit;
  const auto line = csv.has_place ? line_of_places(csv, options, fit) : line_of_stations(csv, fit);
  if (!line) return Unexpected{line.error()};
  auto track = knots_of(csv, *line, options);
  if (!track) return Unexpected{track.error()};
  if (const auto map = world::TrackMap::build(*track); !map) return Unexpected{map.error()};
  fit.track = *std::move(track);
  look_at_heights(csv, *line, fit);
  return fit;
}

}  // namespace pitwall::track_file
