// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "protocol/vocabulary/check.hpp"
#include "vehicle/autonomy/planning/line_speeds.hpp"

namespace pitwall::planning {
namespace {

constexpr double kHintReach_m = 50.0;

// wrap_pi for an angle that is at most one turn away: without the division, for at().
double within_a_turn(double angle_rad) {
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  if (angle_rad > std::numbers::pi) return angle_rad - kTurn_rad;
  return angle_rad < -std::numbers::pi ? angle_rad + kTurn_rad : angle_rad;
}

double mix(double a, double b, double t) { return a + t * (b - a); }

// Arc length along the offset line at each of the track's points, and its whole length.
std::vector<double> arc_lengths(const world::TrackMap& track, double offset_m) {
  std::vector<double> s_m{0.0};
  world::TrackPoint last = track.offset(track.point(0).s_m, offset_m);
  for (std::size_t i = 1; i <= track.size(); ++i) {
    const world::TrackPoint next = track.offset(track.point(i % track.size()).s_m, offset_m);
    // Chord to arc: half the turn over its sine, to second order.
    const double chord_m = std::hypot(next.x_m - last.x_m, next.y_m - last.y_m);
    const double bend = 0.5 * std::remainder(next.yaw_rad - last.yaw_rad, 2.0 * std::numbers::pi);
    s_m.push_back(s_m.back() + chord_m * (1.0 + bend * bend / 6.0));
    last = next;
  }
  return s_m;
}

LinePoint sample(const world::TrackMap& track, double offset_m, double s_m, double track_s_m) {
  const world::TrackPoint p = track.offset(track_s_m, offset_m);
  const double curvature_per_m = p.curvature_per_m / (1.0 - p.curvature_per_m * offset_m);
  return {.s_m = s_m,
          .track_s_m = track.wrap_station(track_s_m),
          .n_m = offset_m,
          .x_m = p.x_m,
          .y_m = p.y_m,
          .yaw_rad = wrap_pi(p.yaw_rad),
          .cos_yaw = std::cos(p.yaw_rad),
          .sin_yaw = std::sin(p.yaw_rad),
          .curvature_per_m = curvature_per_m,
          .bank_rad = p.bank_rad,
          .room_left_m = p.width_left_m - offset_m,
          .room_right_m = p.width_right_m + offset_m};
}

void place_points(const world::TrackMap& track, const LineParams& params, Line& line) {
  const std::vector<double> arc_m = arc_lengths(track, params.offset_m);
  const double track_step_m = track.length_m() / static_cast<double>(track.size());
  line.length_m = arc_m.back();
  const auto count = static_cast<std::size_t>(std::ceil(line.length_m / params.spacing_m));
  line.spacing_m = line.length_m / static_cast<double>(count);
  std::size_t i = 0;
  for (std::size_t n = 0; n < count; ++n) {
    const double s_m = line.spacing_m * static_cast<double>(n);
    while (arc_m[i + 1] <= s_m) ++i;
    const double t = (s_m - arc_m[i]) / (arc_m[i + 1] - arc_m[i]);
    line.points.push_back(
        sample(track, params.offset_m, s_m, (static_cast<double>(i) + t) * track_step_m));
  }
}

// The points of the raceline as they are: they are closer than a line at an offset needs.
void place_points(const world::TrackMap& track, const world::Raceline& raceline, Line& line) {
  line.length_m = raceline.length_m;
  line.spacing_m = raceline.spacing_m();
  std::optional<double> hint_m;
  for (const world::RacelinePoint& p : raceline.points) {
    const world::Curvilinear place = track.project(p.x_m, p.y_m, hint_m);
    const world::TrackPoint beside = track.at(place.s_m);
    hint_m = place.s_m;
    line.points.push_back({.s_m = line.spacing_m * static_cast<double>(line.points.size()),
                           .track_s_m = place.s_m,
                           .n_m = place.n_m,
                           .x_m = p.x_m,
                           .y_m = p.y_m,
                           .yaw_rad = wrap_pi(p.yaw_rad),
                           .cos_yaw = std::cos(p.yaw_rad),
                           .sin_yaw = std::sin(p.yaw_rad),
                           .curvature_per_m = p.curvature_per_m,
                           .bank_rad = p.bank_rad,
                           .room_left_m = beside.width_left_m - place.n_m,
                           .room_right_m = beside.width_right_m + place.n_m});
  }
}

// The first place where the line comes too close to a wall.
std::optional<Problem> off_road(const world::TrackMap& track, const LineParams& params) {
  for (std::size_t i = 0; i < track.size(); ++i) {
    const world::TrackPoint& p = track.point(i);
    if (params.offset_m + params.wall_clearance_m > p.width_left_m ||
        -params.offset_m + params.wall_clearance_m > p.width_right_m) {
      return Problem{"line.offset_m", "comes closer to a wall than line.wall_clearance_m at s = " +
                                          std::to_string(p.s_m) + " m of " + track.name()};
    }
  }
  return std::nullopt;
}

// The first place where a raceline comes too close to a wall; the car's side may not reach it even
// where the car strays.
std::optional<Problem> too_close(const LineParams& params, const Line& line,
                                 const std::string& source) {
  for (const LinePoint& p : line.points) {
    const double room_m = std::min(p.room_left_m, p.room_right_m);
    if (room_m >= params.wall_clearance_m) continue;
    return Problem{"line.wall_clearance_m",
                   source + ": " + params.name + ": s = " + std::to_string(p.s_m) +
                       " m: " + std::to_string(room_m) + " m from a wall, at least " +
                       std::to_string(params.wall_clearance_m)};
  }
  return std::nullopt;
}

std::string names_of(const world::RacelineBank& bank) {
  std::string names;
  for (const world::Raceline& line : bank.lines) names += (names.empty() ? "" : ", ") + line.name;
  return names;
}

// Number of the line that is named.
Result<std::size_t, Problem> chosen(const LineParams& params, const world::RacelineBank* bank) {
  if (bank == nullptr) return refuse("line.bank", params.bank + " is named, but not read");
  if (params.bank.empty()) return refuse("line.bank", "a bank is given, but none is named");
  const auto named = std::ranges::find(bank->lines, params.name, &world::Raceline::name);
  if (named == bank->lines.end())
    return refuse("line.name",
                  bank->source + " has no line \"" + params.name + "\", but " + names_of(*bank));
  if (named->region == world::Region::kPitLane)
    return refuse("line.name", bank->source + ": " + params.name +
                                   " leads through the pit lane: no line to race on");
  const auto number = static_cast<std::size_t>(named - bank->lines.begin()) + 1;
  if (number <= kLinesMost) return number;
  return refuse("line.name", bank->source + ": " + params.name + " is line " +
                                 std::to_string(number) + " of the bank, at most " +
                                 std::to_string(kLinesMost) + " are numbered");
}

}  // namespace

double Line::wrap(double s_m) const {
  const double wrapped = s_m - length_m * std::floor(s_m / length_m);
  return wrapped < length_m ? wrapped : 0.0;  // rounding of a tiny negative s
}

LinePoint Line::at(double s_m) const {
  CHECK(!points.empty());
  const double wrapped_m = wrap(s_m);
  const double index = wrapped_m / spacing_m;
  const std::size_t i = std::min(static_cast<std::size_t>(index), points.size() - 1);
  const double t = index - static_cast<double>(i);
  const LinePoint &a = points[i], &b = points[(i + 1) % points.size()];
  // A cubic through both ends with their headings: the chord alone would cut the corner.
  const double along = spacing_m * t, h = spacing_m;
  const double u2 = t * t, u3 = u2 * t;
  const auto hermite = [&](double p, double m, double q, double n) {
    return (2 * u3 - 3 * u2 + 1) * p + (u3 - 2 * u2 + t) * h * m + (3 * u2 - 2 * u3) * q +
           (u3 - u2) * h * n;
  };
  LinePoint p = a;
  p.s_m = wrapped_m;
  p.cos_yaw = p.sin_yaw = kUnset;
  const bool across_start = b.track_s_m < a.track_s_m;
  p.track_s_m = across_start ? a.track_s_m + along : mix(a.track_s_m, b.track_s_m, t);
  p.n_m = mix(a.n_m, b.n_m, t);
  p.x_m = hermite(a.x_m, a.cos_yaw, b.x_m, b.cos_yaw);
  p.y_m = hermite(a.y_m, a.sin_yaw, b.y_m, b.sin_yaw);
  p.yaw_rad = within_a_turn(a.yaw_rad + t * within_a_turn(b.yaw_rad - a.yaw_rad));
  p.curvature_per_m = mix(a.curvature_per_m, b.curvature_per_m, t);
  p.bank_rad = mix(a.bank_rad, b.bank_rad, t);
  for (std::size_t row = 0; row < p.speed_mps.size(); ++row)
    p.speed_mps[row] = mix(a.speed_mps[row], b.speed_mps[row], t);
  p.room_left_m = mix(a.room_left_m, b.room_left_m, t);
  p.room_right_m = mix(a.room_right_m, b.room_right_m, t);
  return p;
}

LinePosition Line::project(double x_m, double y_m, std::optional<double> hint_s_m) const {
  CHECK(!points.empty());
  if (!std::isfinite(x_m + y_m)) return {};
  const std::size_t n = points.size();
  std::size_t first = 0, count = n;
  if (hint_s_m && std::isfinite(*hint_s_m)) {
    const auto reach = std::min(static_cast<std::size_t>(kHintReach_m / spacing_m), n / 2);
    const auto centre = std::min(static_cast<std::size_t>(wrap(*hint_s_m) / spacing_m), n - 1);
    first = centre + n - reach;
    count = 2 * reach + 1;
  }
  std::size_t best = first % n;
  double best_m2 = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < count; ++k) {
    const LinePoint& p = points[(first + k) % n];
    const double m2 = (x_m - p.x_m) * (x_m - p.x_m) + (y_m - p.y_m) * (y_m - p.y_m);
    if (m2 < best_m2) best_m2 = m2, best = (first + k) % n;
  }
  double s_m = points[best].s_m;
  LinePoint p = points[best];
  double dx = x_m - p.x_m, dy = y_m - p.y_m;
  constexpr int kSteps = 2;  // of Newton along the line; the first is already within centimetres
  for (int i = 0; i < kSteps; ++i) {
    const double along_m = dx * std::cos(p.yaw_rad) + dy * std::sin(p.yaw_rad);
    const double left_m = dy * std::cos(p.yaw_rad) - dx * std::sin(p.yaw_rad);
    const double stretch = std::max(1.0 - p.curvature_per_m * left_m, 0.1);
    s_m += std::clamp(along_m / stretch, -spacing_m, spacing_m);
    p = at(s_m);
    dx = x_m - p.x_m, dy = y_m - p.y_m;
  }
  return {wrap(s_m), dy * std::cos(p.yaw_rad) - dx * std::sin(p.yaw_rad)};
}

Result<Line, Problem> build_line(const world::TrackMap& track, const LineParams& params,
                                 const world::RacelineBank* bank,
                                 const std::optional<envelope::SteeringLimit>& steering) {
  Line line;
  std::optional<BankLap> of_bank;
  if (!params.bank.empty() || bank != nullptr) {
    const auto number = chosen(params, bank);
    if (!number) return Unexpected{number.error()};
    line.number = *number;
    of_bank.emplace(BankLap{bank->lines[*number - 1], bank->tyre_share});
    place_points(track, of_bank->line, line);
    if (auto problem = too_close(params, line, bank->source)) return Unexpected{*problem};
  } else {
    if (auto problem = off_road(track, params)) return Unexpected{*problem};
    place_points(track, params, line);
  }
  add_speeds(envelope_of(params, track, steering), of_bank, line);
  return line;
}

}  // namespace pitwall::planning
