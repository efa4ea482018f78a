// SPDX-License-Identifier: Apache-2.0
#include "hil/report/ground_charts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hil/report/absent.hpp"
#include "hil/report/plot.hpp"
#include "hil/report/text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::report {
namespace {

using T = bench::TruthSample;

constexpr double kHalf = 592.0;                        // two beside each other
constexpr double kPlotSides = 84.0, kPlotEnds = 70.0;  // what a plot needs beside its frame
constexpr double kErrorMax_m = 2.0;  // of the bars: a car off the track would hide all others
constexpr std::size_t kMapPoints = 1600, kDots = 3500;

// Slow to fast; dark to light, so that it is read in print too.
constexpr std::array kSpeedColours{Colour{"#3b0f70"}, Colour{"#31688e"}, Colour{"#1f9e89"},
                                   Colour{"#5cb84b"}, Colour{"#c9a400"}, Colour{"#e8590c"}};

double speed_of(const T& v) { return std::hypot(v.vx_mps, v.vy_mps); }

struct Extent {
  double least = kUnset, greatest = kUnset;

  void add(double value) {
    least = std::fmin(least, value);
    greatest = std::fmax(greatest, value);
  }
  double middle() const { return 0.5 * (least + greatest); }
  double span() const { return greatest - least; }
};

struct Walls {
  Line left, right;
};

Walls walls_of(const world::TrackMap& track) {
  constexpr int kStations = 500;
  Walls walls;
  for (int i = 0; i <= kStations; ++i) {
    const double s_m = track.length_m() * i / kStations;
    const world::TrackPoint at = track.at(s_m);
    const world::TrackPoint left = track.offset(s_m, at.width_left_m);
    const world::TrackPoint right = track.offset(s_m, -at.width_right_m);
    walls.left.push_back({left.x_m, left.y_m});
    walls.right.push_back({right.x_m, right.y_m});
  }
  return walls;
}

// Axes of one scale that hold the whole extent.
std::pair<Axis, Axis> equal_axes(const Extent& x, const Extent& y, Size size) {
  const double wide = size.width - kPlotSides, tall = size.height - kPlotEnds;
  const double metres = 1.06 * std::max({x.span() / wide, y.span() / tall, 0.02});
  return {{x.middle() - 0.5 * metres * wide, x.middle() + 0.5 * metres * wide, "east, m"},
          {y.middle() - 0.5 * metres * tall, y.middle() + 0.5 * metres * tall, "north, m"}};
}

class SpeedScale {
 public:
  explicit SpeedScale(const RunData& run) {
    double fastest = 1.0;
    for (const auto& row : run.truth) fastest = std::fmax(fastest, speed_of(row.v));
    step_mps_ = std::max(1.0, std::ceil(fastest / static_cast<double>(kSpeedColours.size())));
  }
  std::size_t class_of(double speed_mps) const {
    const double place = std::floor(speed_mps / step_mps_);
    return static_cast<std::size_t>(
        std::clamp(place, 0.0, static_cast<double>(kSpeedColours.size() - 1)));
  }
  std::string legend() const {
    std::string out = "<p class=\"legend\">speed, m/s: ";
    for (std::size_t i = 0; i < kSpeedColours.size(); ++i)
      out += "<span><i style=\"background:" + std::string(kSpeedColours[i].css) + "\"></i>" +
             formatted("%.0f to %.0f", step_mps_ * static_cast<double>(i),
                       step_mps_ * static_cast<double>(i + 1)) +
             "</span> ";
    return out + "</p>\n";
  }

 private:
  double step_mps_ = 1.0;
};

// The way of the car as one line per class of speed, with gaps where it is in another class.
std::array<Line, kSpeedColours.size()> coloured_path(const std::vector<At<T>>& rows,
                                                     const SpeedScale& scale) {
  std::array<Line, kSpeedColours.size()> lines;
  const std::size_t stride = rows.size() / kMapPoints + 1;
  std::size_t before = 0;
  for (std::size_t i = 0; i < rows.size(); i += stride) {
    const T& v = rows[i].v;
    const std::size_t now = scale.class_of(speed_of(v));
    if (i > 0 && now != before) {
      lines[before].push_back({v.x_m, v.y_m});  // so that the lines meet
      lines[before].push_back({v.x_m, kUnset});
    }
    lines[now].push_back({v.x_m, v.y_m});
    before = now;
  }
  return lines;
}

const At<T>* row_at(const RunData& run, double t_s) {
  if (!std::isfinite(t_s)) return nullptr;
  const auto row = std::ranges::lower_bound(run.truth, t_s, {}, &At<T>::t_s);
  return row != run.truth.end() ? &*row : nullptr;
}

void add_signs(Plot& plot, const RunData& run) {
  const auto sign = [&](double t_s, const std::string& symbol, Colour colour,
                        const std::string& text) {
    const At<T>* row = row_at(run, t_s);
    if (row != nullptr && std::isfinite(row->v.x_m + row->v.y_m))
      plot.sign(row->v.x_m, row->v.y_m, symbol, colour, formatted("%.2f s: ", t_s) + text);
  };
  sign(run.truth.front().t_s, "S", kInk, "start");
  for (std::size_t i = 0; i < run.faults.size(); ++i)
    sign(run.faults[i].from_s, std::to_string(i + 1), kPurple, "fault " + run.faults[i].kind);
  for (const VerdictRow& verdict : run.verdicts)
    if (!verdict.pass)
      sign(verdict.first_violation_s, "!", kVermillion, "first violation: " + verdict.text);
}

// Where the car was when, for the page's cursor: t, x, y, t, x, y ...
std::string trace_of(const RunData& run) {
  std::string out = "<script type=\"application/json\" id=\"trace\">[";
  const std::size_t stride = run.truth.size() / kMapPoints + 1;
  for (std::size_t i = 0; i < run.truth.size(); i += stride) {
    const auto& [t_s, v] = run.truth[i];
    if (std::isfinite(v.x_m) && std::isfinite(v.y_m))
      out += formatted("%s%.2f,%.1f,%.1f", out.back() == '[' ? "" : ",", t_s, v.x_m, v.y_m);
  }
  return out + "]</script>\n";
}

}  // namespace

std::string map_chart(const RunData& run, const world::TrackMap* track,
                      const std::string& no_walls) {
  if (run.truth.empty()) return absent("map", "Map", "no truth was recorded");
  Extent x, y;
  for (const auto& row : run.truth) x.add(row.v.x_m), y.add(row.v.y_m);
  if (!std::isfinite(x.span() + y.span())) return absent("map", "Map", "the truth has no position");
  Walls walls;
  if (track != nullptr) walls = walls_of(*track);
  for (const Line& wall : {walls.left, walls.right})
    for (const Point& point : wall) x.add(point.x), y.add(point.y);
  const Size size{kHalf, 470.0};
  const auto [x_axis, y_axis] = equal_axes(x, y, size);
  Plot plot("map", "Map" + (track != nullptr ? " of " + track->name() : std::string()),
            Plot::Kind::kPlane, size, x_axis, y_axis);
  plot.line(walls.left, {.colour = kGrey, .name = {}, .unit = {}, .width = 1.2});
  plot.line(walls.right, {.colour = kGrey, .name = {}, .unit = {}, .width = 1.2});
  const SpeedScale scale(run);
  const auto path = coloured_path(run.truth, scale);
  for (std::size_t i = 0; i < path.size(); ++i)
    plot.line(path[i], {.colour = kSpeedColours[i], .name = {}, .unit = {}, .width = 3.0});
  add_signs(plot, run);
  std::string out = plot.svg() + scale.legend() +
                    "<p class=\"legend\">S start, numbers: where a fault began, !: first violation"
                    "</p>\n" +
                    trace_of(run);
  if (track == nullptr) out += absent("walls", "Walls", no_walls);
  return out;
}

std::string station_chart(const RunData& run) {
  Line line;
  double length_m = 0.0;
  for (const auto& [t_s, v] : run.truth) {
    if (!line.empty() && std::abs(v.s_m - line.back().x) > 50.0) line.push_back({v.s_m, kUnset});
    line.push_back({v.s_m, v.cross_track_m});
    length_m = std::fmax(length_m, v.s_m);
  }
  // Each lap by itself: buckets of stations, not of time.
  Line thin;
  for (std::size_t begin = 0; begin < line.size();) {
    std::size_t end = begin;
    while (end < line.size() && std::isfinite(line[end].y)) ++end;
    const Line lap = thinned(std::span(line).subspan(begin, end - begin), 0.0, length_m + 1.0, 480);
    thin.insert(thin.end(), lap.begin(), lap.end());
    if (!thin.empty()) thin.push_back({thin.back().x, kUnset});
    begin = end + 1;
  }
  const std::string title = "Cross-track error over the lap (left is positive)";
  if (thin.empty()) return absent("station", title, "this log holds none");
  Plot plot("station", title, Plot::Kind::kPlane, {kHalf, 330.0},
            {0.0, length_m + 1.0, "station, m"}, axis_over({{thin}}, "error, m", 0.1));
  plot.level(0.0, kGrey, "");
  plot.line(thin, {.colour = kBlue, .name = {}, .unit = {}, .width = 1.0});
  return plot.svg();
}

std::string acceleration_chart(const RunData& run) {
  const std::string title = "g-g diagram: specific force in the plane of the road";
  Line points;
  double most_g = 1.0;
  const std::size_t stride = run.truth.size() / kDots + 1;
  for (std::size_t i = 0; i < run.truth.size(); i += stride) {
    const T& v = run.truth[i].v;
    points.push_back({v.ay_mps2 / kGravity_mps2, v.ax_mps2 / kGravity_mps2});
    most_g = std::fmax(most_g, std::fmax(std::abs(points.back().x), std::abs(points.back().y)));
  }
  const bool drawn = std::ranges::any_of(
      points, [](const Point& p) { return std::isfinite(p.x) && std::isfinite(p.y); });
  if (!drawn) return absent("gg", title, "no truth was recorded");
  const double limit_g = 1.06 * std::min(most_g, 10.0);
  const double tall = 430.0, wide = tall - kPlotEnds + kPlotSides;
  // Left is drawn on the left.
  Plot plot("gg", title, Plot::Kind::kPlane, {wide, tall}, {limit_g, -limit_g, "to the left, g"},
            {-limit_g, limit_g, "forward, g"});
  for (double g = 1.0; g < limit_g; g += 1.0) plot.circle(g, kPale);
  plot.dots(points, {.colour = kBlue, .name = {}, .unit = {}}, 3.0);
  return plot.svg();
}

grading::CrossTrack cross_track_of(const RunData& run) {
  grading::CrossTrack statistics;
  for (const auto& row : run.truth) grading::add(statistics, speed_of(row.v), row.v.cross_track_m);
  return statistics;
}

std::string bracket_chart(const grading::CrossTrack& statistics) {
  const std::string title = "Mean cross-track error by speed";
  if (statistics.overall.samples == 0)
    return absent("brackets", title, "the car was never faster than 10 m/s");
  const std::size_t count = grading::kBrackets.size();
  std::vector<Bar> ours, paper;
  std::vector<std::string> names;
  Line heights;
  for (std::size_t i = 0; i < count; ++i) {  // slow to fast
    const grading::Bracket& bracket = grading::kBrackets[count - 1 - i];
    const double mean_m = statistics.by_bracket[count - 1 - i].mean_m();
    const auto at = static_cast<double>(i);
    ours.push_back({at + 0.12, at + 0.50, mean_m});
    paper.push_back({at + 0.50, at + 0.88, bracket.paper_mean_m});
    heights.push_back({at, mean_m});
    heights.push_back({at, bracket.paper_mean_m});
    names.push_back(formatted("%.0f", bracket.from_mps) +
                    (bracket.to_mps < 1e3 ? formatted("-%.0f", bracket.to_mps) : std::string("+")));
  }
  heights.push_back({0.0, 0.0});
  Axis errors = axis_over({{heights}}, "error, m", 0.1);
  errors.to = std::min(errors.to, kErrorMax_m);
  Plot plot("brackets", title, Plot::Kind::kBars, {kHalf, 250.0},
            {0.0, static_cast<double>(count), "speed, m/s"}, std::move(errors));
  plot.x_names(std::move(names));
  plot.bars(ours, {.colour = kBlue, .name = "this run", .unit = "m"});
  plot.bars(paper, {.colour = kOrange, .name = "paper, real car", .unit = "m"});
  return plot.svg();
}

std::string bracket_table(const grading::CrossTrack& statistics) {
  std::string out =
      "<table class=\"numbers\"><thead><tr><th>speed, m/s</th><th>ticks</th><th>mean, m</th>"
      "<th>max, m</th><th>paper, real car: best, m</th><th>mean, m</th></tr></thead><tbody>";
  const auto row = [&out](const std::string& name, const grading::ErrorStatistics& s, double best_m,
                          double mean_m) {
    const std::string none = "&ndash;";
    out += "<tr><td>" + name + "</td><td>" + std::to_string(s.samples) + "</td><td>" +
           (s.samples > 0 ? number(s.mean_m(), 3) : none) + "</td><td>" +
           (s.samples > 0 ? number(s.max_m, 3) : none) + "</td><td class=\"paper\">" +
           number(best_m, 3) + "</td><td class=\"paper\">" + number(mean_m, 3) + "</td></tr>";
  };
  for (std::size_t i = 0; i < grading::kBrackets.size(); ++i) {
    const grading::Bracket& b = grading::kBrackets[i];
    const std::string to =
        b.to_mps < 1e3 ? formatted(" to %.0f", b.to_mps) : std::string(" and more");
    row(formatted("%.0f", b.from_mps) + to, statistics.by_bracket[i], b.paper_best_m,
        b.paper_mean_m);
  }
  row("all above 10", statistics.overall, grading::kPaperBestOverall_m,
      grading::kPaperMeanOverall_m);
  return out + "</tbody></table>\n";
}

}  // namespace pitwall::report
