// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/optimum/minimum_curvature.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "protocol/vocabulary/text.hpp"
#include "vehicle/raceline/optimum/box_problem.hpp"
#include "vehicle/raceline/optimum/offset_line.hpp"

namespace pitwall::raceline {
namespace {

constexpr double kStep_m = 4.0;  // between stations
constexpr int kRoundsMax = 50;
constexpr double kSettled = 1e-6;  // of the sum, by which a round lessens it
constexpr int kHalvingsMax = 6;
constexpr std::size_t kEvery = 3;  // stations from waypoint to waypoint

// The curvature times the root of the length that it stands for, and its derivatives.
struct RootedBend {
  double value = 0.0;
  std::array<double, 3> by_offset{};
};

RootedBend rooted(const Bend& bend) {
  const double root = std::sqrt(bend.length_m);
  RootedBend out{bend.curvature_per_m * root, {}};
  for (std::size_t k = 0; k < out.by_offset.size(); ++k)
    out.by_offset[k] = root * bend.curvature_by_offset[k] +
                       bend.curvature_per_m * 0.5 * bend.length_by_offset[k] / root;
  return out;
}

double sum_of(const OffsetLine& line) {
  double sum = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double value = rooted(line.bend(i)).value;
    sum += value * value;
  }
  return sum;
}

// Half of the sum of squares of the bends, made linear in the offsets around where they are.
BoxProblem linearised(const OffsetLine& line) {
  const std::size_t n = line.size();
  BoxProblem problem{
      std::vector<std::array<double, kReach + 1>>(n), std::vector<double>(n), {}, {}};
  for (std::size_t i = 0; i < n; ++i) {
    const RootedBend bend = rooted(line.bend(i));
    double at_zero = bend.value;
    for (std::size_t k = 0; k < 3; ++k)
      at_zero -= bend.by_offset[k] * line.offset_m[(i + n + k - 1) % n];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t row = (i + n + k - 1) % n;
      problem.gradient[row] += bend.by_offset[k] * at_zero;
      for (std::size_t l = k; l < 3; ++l)
        problem.hessian[row][l - k] += bend.by_offset[k] * bend.by_offset[l];
    }
  }
  return problem;
}

Unexpected<Problem> unsettled(const Lanes& lanes) {
  return refuse(lanes.track().name(), "the line of minimum curvature does not settle");
}

}  // namespace

Result<OffsetLine, Problem> minimum_curvature_offsets(const Lanes& lanes, double margin_m) {
  const world::TrackMap& track = lanes.track();
  OffsetLine line{track, stations_of(track, kStep_m, kEvery)};
  const auto bounds = bounds_of(line, lanes, margin_m);
  if (!bounds) return Unexpected{bounds.error()};
  for (std::size_t i = 0; i < line.size(); ++i)
    line.offset_m[i] = 0.5 * (bounds->low_m[i] + bounds->high_m[i]);
  for (int round = 0; round < kRoundsMax; ++round) {
    BoxProblem problem = linearised(line);
    problem.low = bounds->low_m, problem.high = bounds->high_m;
    const auto best = minimise(problem);
    if (!best) return unsettled(lanes);
    const std::vector<double> from = line.offset_m;
    const double before = sum_of(line);
    double share = 1.0;
    for (int halving = 0; halving < kHalvingsMax; ++halving, share *= 0.5) {
      for (std::size_t i = 0; i < from.size(); ++i)
        line.offset_m[i] = from[i] + share * ((*best)[i] - from[i]);
      if (sum_of(line) <= before) break;
    }
    if (before - sum_of(line) > kSettled * before) continue;
    return line;
  }
  return unsettled(lanes);
}

std::vector<Waypoint> waypoints_of(const OffsetLine& line) {
  std::vector<Waypoint> waypoints;
  for (std::size_t i = 0; i < line.size(); i += kEvery)
    waypoints.push_back({line.station_m[i], line.offset_m[i]});
  return waypoints;
}

Result<std::vector<Waypoint>, Problem> minimum_curvature(const Lanes& lanes, double margin_m) {
  const auto line = minimum_curvature_offsets(lanes, margin_m);
  if (!line) return Unexpected{line.error()};
  return waypoints_of(*line);
}

}  // namespace pitwall::raceline
