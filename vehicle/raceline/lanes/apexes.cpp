// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/lanes/apexes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

namespace pitwall::raceline {
namespace {

constexpr double kAverage_m = 80.0;  // over which the curvature is averaged
constexpr double kDip = 0.8;         // of a corner's curvature, between it and the next
constexpr double kPlateau = 0.9;     // of a corner's curvature: its apex is amid this
constexpr double kCurvatureMin_per_m = 1.0 / 1500.0;
constexpr double kStraightest = 1.05;  // of the least curvature between two corners
constexpr std::size_t kWaypointsMin = 4;

// Mean over a window around each point of a closed row.
std::vector<double> averaged(const Raceline& line) {
  const std::size_t n = line.points.size();
  const auto half = std::min(static_cast<std::size_t>(0.5 * kAverage_m / line.spacing_m()), n / 4);
  std::vector<double> sums{0.0};
  for (std::size_t i = 0; i < 2 * n; ++i)
    sums.push_back(sums.back() + line.points[i % n].curvature_per_m);
  std::vector<double> mean(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t from = i + (i < half ? n : 0) - half;
    mean[i] = (sums[from + 2 * half + 1] - sums[from]) / static_cast<double>(2 * half + 1);
  }
  return mean;
}

// A stretch of a closed row, from `first` on over `count` points.
struct Stretch {
  std::size_t first = 0, count = 1;
  std::size_t middle(std::size_t n) const { return (first + count / 2) % n; }
};

// Around point i, as long as the values stay above the bound.
Stretch stretch_above(const std::vector<double>& values, std::size_t i, double bound) {
  const std::size_t n = values.size();
  Stretch s{i, 1};
  while (s.count < n && values[(s.first + n - 1) % n] > bound)
    s.first = (s.first + n - 1) % n, ++s.count;
  while (s.count < n && values[(s.first + s.count) % n] > bound) ++s.count;
  return s;
}

// The corners of one direction: peaks from the highest down, each with its surroundings.
void add_apexes(const std::vector<double>& curvature, bool is_left, std::vector<std::size_t>& at,
                std::vector<bool>& left) {
  const std::size_t n = curvature.size();
  std::vector<std::size_t> by_height(n);
  std::iota(by_height.begin(), by_height.end(), std::size_t{0});
  std::ranges::stable_sort(by_height, std::greater<>{},
                           [&](std::size_t i) { return curvature[i]; });
  std::vector<bool> taken(n, false);
  for (const std::size_t i : by_height) {
    if (curvature[i] < kCurvatureMin_per_m) break;
    const Stretch corner = stretch_above(curvature, i, kDip * curvature[i]);
    bool is_new = true;
    for (std::size_t k = 0; k < corner.count; ++k) {
      const std::size_t j = (corner.first + k) % n;
      is_new = is_new && !taken[j];
      taken[j] = true;
    }
    if (!is_new) continue;
    at.push_back(stretch_above(curvature, i, kPlateau * curvature[i]).middle(n));
    left.push_back(is_left);
  }
}

double station_of(const world::TrackMap& track, const RacelinePoint& p) {
  return track.project(p.x_m, p.y_m).s_m;
}

// The station between two others where the line is straightest.
double straightest(const Raceline& line, const std::vector<double>& curvature,
                   const world::TrackMap& track, double from_s_m, double to_s_m) {
  const double between_m = track.station_ahead(from_s_m, to_s_m);
  const double span_m = between_m > 0.0 ? between_m : track.length_m();
  std::vector<std::pair<double, double>> places;  // metres from the first corner, curvature
  double hint_m = kUnset, least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const RacelinePoint& p = line.points[i];
    hint_m = std::isfinite(hint_m) ? track.project(p.x_m, p.y_m, hint_m).s_m : station_of(track, p);
    const double ahead_m = track.station_ahead(from_s_m, hint_m);
    if (ahead_m >= span_m) continue;
    places.emplace_back(ahead_m, std::abs(curvature[i]));
    least = std::min(least, places.back().second);
  }
  double first_m = span_m, last_m = 0.0;
  for (const auto& [ahead_m, bend] : places) {
    if (bend > kStraightest * least + 1e-5) continue;
    first_m = std::min(first_m, ahead_m), last_m = std::max(last_m, ahead_m);
  }
  return track.wrap_station(from_s_m + 0.5 * (first_m + last_m));
}

}  // namespace

std::vector<Apex> find_apexes(const Raceline& centre, const world::TrackMap& track) {
  std::vector<double> left = averaged(centre), right = left;
  for (double& value : right) value = -value;
  std::vector<std::size_t> at;
  std::vector<bool> is_left;
  add_apexes(left, true, at, is_left);
  add_apexes(right, false, at, is_left);
  std::vector<Apex> apexes;
  for (std::size_t i = 0; i < at.size(); ++i)
    apexes.push_back({station_of(track, centre.points[at[i]]), is_left[i]});
  std::ranges::sort(apexes, {}, &Apex::s_m);
  return apexes;
}

std::vector<Waypoint> apex_waypoints(const Lanes& lanes, Region region, const Raceline& centre,
                                     double margin_m, const std::vector<Waypoint>& given) {
  const world::TrackMap& track = lanes.track();
  const auto free = [&](double s_m) { return lanes.band(region, s_m).narrowed(margin_m); };
  std::vector<Waypoint> at;
  std::vector<Apex> apexes;
  if (given.empty()) apexes = find_apexes(centre, track);
  for (const Apex& a : apexes)
    at.push_back({a.s_m, a.is_left ? free(a.s_m).left_m : free(a.s_m).right_m});
  for (const Waypoint& w : given) {
    at.push_back(w);
    apexes.push_back({w.s_m, w.n_m > lanes.band(region, w.s_m).middle_m()});
  }
  std::vector<Waypoint> waypoints = at;
  const std::vector<double> curvature = averaged(centre);
  for (std::size_t i = 0; i < apexes.size(); ++i) {
    const Apex &a = apexes[i], &b = apexes[(i + 1) % apexes.size()];
    const double s_m = straightest(centre, curvature, track, a.s_m, b.s_m);
    const Band between = free(s_m);
    const double outside_m = a.is_left ? between.right_m : between.left_m;
    waypoints.push_back({s_m, a.is_left == b.is_left ? outside_m : between.middle_m()});
  }
  // A lap with a single corner has too few of them for a closed line.
  for (double k = 0.0; waypoints.size() < kWaypointsMin; ++k) {
    const double s_m = track.length_m() * (k + 0.5) / static_cast<double>(kWaypointsMin);
    waypoints.push_back({s_m, free(s_m).middle_m()});
  }
  std::ranges::sort(waypoints, {}, &Waypoint::s_m);
  return waypoints;
}

}  // namespace pitwall::raceline
