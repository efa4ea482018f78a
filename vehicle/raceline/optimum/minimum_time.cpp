// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/optimum/minimum_time.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "vehicle/raceline/optimum/box_problem.hpp"
#include "vehicle/raceline/optimum/minimum_curvature.hpp"
#include "vehicle/raceline/optimum/offset_line.hpp"
#include "vehicle/raceline/profile/lap_gradient.hpp"
#include "vehicle/raceline/profile/lap_road.hpp"

namespace pitwall::raceline {
namespace {

constexpr int kRoundsOfTime = 600;
constexpr int kQuietRounds = 30;     // after so many that lessen the lap little it has settled
constexpr double kLittle_s = 1e-5;   // in one round
constexpr double kMoveMost_m = 1.0;  // of an offset in a round
constexpr double kWeightFirst = 1.0, kWeightLeast = 1e-3, kWeightMost = 1e9;
constexpr double kStiff = 1e-4;     // of an offset, beside a change of curvature
constexpr double kInside_m = 1e-6;  // least distance between two bounds of a round

// Of the curvature squared over the lap, in s m, that is added to the lap time. A line along a wall
// takes over each corner of the wall, of which a spline makes a wave; this smooths it.
constexpr std::array kSmoothings{0.0, 0.03, 0.3, 3.0};

// A line by its offsets, with its fastest lap.
class TimedLine {
 public:
  TimedLine(const Lanes& lanes, OffsetLine begin, const envelope::EnvelopeTable& table,
            double smoothing)
      : line(std::move(begin)), table_(&table), profile_(table), smoothing_(smoothing) {
    road_.resize(line.size());
    lap_.resize(line.size());
    for (std::size_t i = 0; i < road_.size(); ++i)
      road_[i].bank_rad = lanes.track().at(line.station_m[i]).bank_rad;
  }

  // The time of a lap at the present offsets, and the smoothing; endless where no speed carries the
  // car.
  double cost_s() {
    double bends = 0.0;
    for (std::size_t i = 0; i < road_.size(); ++i) {
      const Bend bend = line.bend(i);
      road_[i].curvature_per_m = bend.curvature_per_m;
      road_[i].step_m = line.step(i).length_m;
      bends += bend.curvature_per_m * bend.curvature_per_m * bend.length_m;
    }
    const LapOutcome outcome = profile_.solve(road_, lap_);
    if (outcome.stuck) return std::numeric_limits<double>::infinity();
    return outcome.lap_s + smoothing_ * bends;
  }

  // The slope of the cost by the offsets, and the squares of the changes of curvature, `weight`
  // times; after cost_s().
  BoxProblem around(double weight) const {
    const std::size_t n = line.size();
    BoxProblem problem{
        std::vector<std::array<double, kReach + 1>>(n), std::vector<double>(n), {}, {}};
    const std::vector<LapSlope> slopes = lap_gradient(road_, lap_, *table_);
    for (std::size_t i = 0; i < n; ++i) {
      const Bend bend = line.bend(i);
      const Step step = line.step(i);
      const double by_curvature =
          slopes[i].by_curvature_s_m + 2.0 * smoothing_ * bend.curvature_per_m * bend.length_m;
      const double by_length = smoothing_ * bend.curvature_per_m * bend.curvature_per_m;
      const double square = (weight + 2.0 * smoothing_) * bend.length_m;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t row = (i + n + k - 1) % n;
        problem.gradient[row] +=
            by_curvature * bend.curvature_by_offset[k] + by_length * bend.length_by_offset[k];
        for (std::size_t l = k; l < 3; ++l)
          problem.hessian[row][l - k] +=
              square * bend.curvature_by_offset[k] * bend.curvature_by_offset[l];
      }
      for (std::size_t k = 0; k < 2; ++k)
        problem.gradient[(i + k) % n] += slopes[i].by_step_s_per_m * step.by_offset[k];
      problem.hessian[i][0] += weight * kStiff;
    }
    return problem;
  }

  OffsetLine line;

 private:
  const envelope::EnvelopeTable* table_;
  LapProfile profile_;
  double smoothing_;
  std::vector<RoadStep> road_;
  std::vector<LapPoint> lap_;
};

// The offsets at the least of a problem whose variables are their changes.
std::optional<std::vector<double>> moved(BoxProblem problem, const std::vector<double>& from,
                                         const OffsetBounds& bounds) {
  const std::size_t n = from.size();
  problem.low.resize(n), problem.high.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    problem.low[i] = std::min(std::max(bounds.low_m[i] - from[i], -kMoveMost_m), -kInside_m);
    problem.high[i] = std::max(std::min(bounds.high_m[i] - from[i], kMoveMost_m), kInside_m);
  }
  auto change = minimise(problem);
  if (!change) return std::nullopt;
  for (std::size_t i = 0; i < n; ++i)
    (*change)[i] = std::clamp(from[i] + (*change)[i], bounds.low_m[i], bounds.high_m[i]);
  return change;
}

void descend(TimedLine& timed, const OffsetBounds& bounds) {
  double best_s = timed.cost_s(), weight = kWeightFirst;
  int quiet = 0;
  for (int round = 0; round < kRoundsOfTime && quiet < kQuietRounds; ++round) {
    const std::vector<double> from = timed.line.offset_m;
    bool is_better = false;
    while (!is_better && weight <= kWeightMost) {
      const auto to = moved(timed.around(weight), from, bounds);
      if (to) timed.line.offset_m = *to;
      const double cost_s = timed.cost_s();
      is_better = cost_s < best_s;
      if (is_better) {
        quiet = best_s - cost_s < kLittle_s ? quiet + 1 : 0;
        best_s = cost_s;
        weight = std::max(weight / 3.0, kWeightLeast);
      } else {
        timed.line.offset_m = from;
        timed.cost_s();  // what around() reads
        weight *= 4.0;
      }
    }
    if (!is_better) return;
  }
}

// The lap of the spline that is laid through the waypoints; endless where there is none.
double lap_of(const Lanes& lanes, double margin_m, const std::vector<Waypoint>& waypoints,
              const envelope::EnvelopeTable& table) {
  constexpr double kLineStep_m = 1.0;
  const auto spline = fit_between(lanes, Region::kTrack, margin_m, waypoints);
  if (!spline) return std::numeric_limits<double>::infinity();
  const Raceline line = sample_raceline(*spline, lanes.track(), kLineStep_m);
  const std::vector<RoadStep> road = road_of(line, lanes);
  std::vector<LapPoint> lap(road.size());
  const LapOutcome outcome = LapProfile{table}.solve(road, lap);
  return outcome.stuck ? std::numeric_limits<double>::infinity() : outcome.lap_s;
}

}  // namespace

Result<std::vector<Waypoint>, Problem> minimum_time(const Lanes& lanes, double margin_m,
                                                    const envelope::EnvelopeTable& table) {
  const auto begin = minimum_curvature_offsets(lanes, margin_m);
  if (!begin) return Unexpected{begin.error()};
  const auto bounds = bounds_of(*begin, lanes, margin_m);
  if (!bounds) return Unexpected{bounds.error()};
  envelope::EnvelopeParams car = table.params();
  car.friction.engine.shift_s = 0.0;  // a shift moves with every change of the line
  const envelope::EnvelopeTable smooth{car};
  std::vector<Waypoint> best = waypoints_of(*begin);
  double best_s = lap_of(lanes, margin_m, best, table);
  for (const double smoothing : kSmoothings) {
    TimedLine timed{lanes, *begin, smooth, smoothing};
    descend(timed, *bounds);
    std::vector<Waypoint> waypoints = waypoints_of(timed.line);
    const double lap_s = lap_of(lanes, margin_m, waypoints, table);
    if (lap_s < best_s) best_s = lap_s, best = std::move(waypoints);
  }
  return best;
}

}  // namespace pitwall::raceline
