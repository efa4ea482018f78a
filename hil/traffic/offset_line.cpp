// SPDX-License-Identifier: Apache-2.0
#include "hil/traffic/offset_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "hil/traffic/periodic_knots.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::traffic {
namespace {

constexpr double kSteepest_rad = from_deg(60.0);  // of a raceline, against the reference line

}  // namespace

Result<OffsetLine, Problem> OffsetLine::of(const world::Raceline& line,
                                           const world::TrackMap& track, double beside_m) {
  OffsetLine made(beside_m);
  made.length_m_ = track.length_m();
  made.knots_.reserve(line.points.size());
  std::optional<double> hint_s_m;
  double around_m = 0.0;
  for (const world::RacelinePoint& p : line.points) {
    const world::Curvilinear place = track.project(p.x_m, p.y_m, hint_s_m);
    const world::TrackPoint road = track.at(place.s_m);
    const double turn_rad = wrap_pi(p.yaw_rad - road.yaw_rad);
    const double step_m =
        std::remainder(place.s_m - hint_s_m.value_or(place.s_m), track.length_m());
    if (!(std::abs(turn_rad) < kSteepest_rad) || (hint_s_m && !(step_m > 0.0)))
      return refuse(line.name, formatted("does not follow the track at s = %.0f m", place.s_m));
    around_m += step_m;
    hint_s_m = place.s_m;
    made.knots_.push_back(
        {place.s_m, place.n_m, (1.0 - road.curvature_per_m * place.n_m) * std::tan(turn_rad)});
  }
  if (made.knots_.empty() || around_m >= track.length_m())
    return refuse(line.name, "does not lead once around the track");
  const auto first = std::min_element(made.knots_.begin(), made.knots_.end(),
                                      [](const Knot& a, const Knot& b) { return a.s_m < b.s_m; });
  std::rotate(made.knots_.begin(), first, made.knots_.end());
  return made;
}

LineOffset OffsetLine::at(double s_m) const {
  if (knots_.empty()) return {beside_m_, 0.0};
  const Between<Knot> place = between(knots_, s_m, length_m_);
  const double u = place.share, v = 1.0 - u, rise_m = place.after.n_m - place.before.n_m;
  const double n_m = place.before.n_m + rise_m * u * u * (3.0 - 2.0 * u) +
                     place.way_m * u * v * (v * place.before.slope - u * place.after.slope);
  const double slope = 6.0 * u * v * rise_m / place.way_m +
                       v * (1.0 - 3.0 * u) * place.before.slope +
                       u * (1.0 - 3.0 * v) * place.after.slope;
  return {n_m + beside_m_, slope};
}

std::optional<Problem> touches_wall(const OffsetLine& line, const world::TrackMap& track,
                                    double half_width_m) {
  for (std::size_t i = 0; i < track.size(); ++i) {
    const world::TrackPoint& road = track.point(i);
    const double n_m = line.at(road.s_m).n_m;
    if (n_m + half_width_m < road.width_left_m && half_width_m - n_m < road.width_right_m) continue;
    return Problem{"offset_m", formatted("the car touches a wall at s = %.0f m, %.2f m beside the "
                                         "reference line",
                                         road.s_m, n_m)};
  }
  return std::nullopt;
}

}  // namespace pitwall::traffic
