// SPDX-License-Identifier: Apache-2.0
#include "hil/track_file/track_check.hpp"

#include <algorithm>
#include <cmath>

#include "hil/report/text.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::track_file {
namespace {

using world::TrackMap;
using world::TrackPoint;

// What a single-seater at speed finds odd.
constexpr double kNarrow_m = 6.0;    // wall to wall
constexpr double kWallNear_m = 1.5;  // half a car and a hand's breadth
constexpr double kTight_m = 10.0;    // radius at the inner wall
constexpr double kBankChange_rad_per_m = from_deg(1.0);
constexpr double kWidthChange = 0.5;  // a wall that turns by 27 degrees
constexpr double kCorrectionOdd = 0.01;

void keep_max(AtStation& most, double value, double s_m) {
  if (!(value <= most.value)) most = {value, s_m};
}

void keep_min(AtStation& least, double value, double s_m) {
  if (!(value >= least.value)) least = {value, s_m};
}

// Radius less the way to the inner wall; on a straight there is room without end.
double inner_room_m(const TrackPoint& p) {
  const double inner_m = p.curvature_per_m > 0.0 ? p.width_left_m : p.width_right_m;
  return 1.0 / std::max(std::abs(p.curvature_per_m), 1e-9) - inner_m;
}

void look_at(TrackReport& r, const TrackPoint& p) {
  keep_max(r.curvature_max, p.curvature_per_m, p.s_m);
  keep_min(r.curvature_min, p.curvature_per_m, p.s_m);
  keep_min(r.inner_room, inner_room_m(p), p.s_m);
  keep_max(r.width_max, p.width_left_m + p.width_right_m, p.s_m);
  keep_min(r.width_min, p.width_left_m + p.width_right_m, p.s_m);
  keep_min(r.wall_nearest, std::min(p.width_left_m, p.width_right_m), p.s_m);
  keep_max(r.bank_max, p.bank_rad, p.s_m);
  keep_min(r.bank_min, p.bank_rad, p.s_m);
}

void look_between(TrackReport& r, const TrackPoint& a, const TrackPoint& b, double step_m) {
  keep_max(r.bank_change, std::abs(b.bank_rad - a.bank_rad) / step_m, a.s_m);
  keep_max(r.curvature_change, std::abs(b.curvature_per_m - a.curvature_per_m) / step_m, a.s_m);
  const double left = std::abs(b.width_left_m - a.width_left_m);
  keep_max(r.width_change, std::max(left, std::abs(b.width_right_m - a.width_right_m)) / step_m,
           a.s_m);
}

double correction_per_m(const world::TrackDescription& d, const TrackMap& map) {
  double largest_per_m = 0.0;
  for (const world::TrackKnot& k : d.knots) {
    // The map is straight between its own points, of which a knot need not be one.
    const double spacing_m = map.length_m() / static_cast<double>(map.size());
    const double behind_m = k.s_m - std::floor(k.s_m / spacing_m) * spacing_m;
    if (std::min(behind_m, spacing_m - behind_m) > 0.05 * spacing_m) continue;
    const double off_per_m = map.at(k.s_m).curvature_per_m - k.curvature_per_m;
    largest_per_m = std::max(largest_per_m, std::abs(off_per_m));
  }
  return largest_per_m;
}

void warn(TrackReport& r) {
  const auto add = [&r](bool odd, const std::string& what, double s_m) {
    if (odd) r.warnings.push_back(what + formatted(" at s = %.0f m", s_m));
  };
  add(r.width_min.value < kNarrow_m, formatted("only %.1f m wide", r.width_min.value),
      r.width_min.s_m);
  add(r.wall_nearest.value < kWallNear_m,
      formatted("the reference line runs %.2f m from a wall", r.wall_nearest.value),
      r.wall_nearest.s_m);
  add(r.inner_room.value < kTight_m,
      formatted("the inner wall turns in a radius of %.1f m", r.inner_room.value),
      r.inner_room.s_m);
  add(r.bank_change.value > kBankChange_rad_per_m,
      formatted("banking changes by %.1f degrees in a metre", to_deg(r.bank_change.value)),
      r.bank_change.s_m);
  add(r.width_change.value > kWidthChange,
      formatted("a wall moves by %.1f m in a metre", r.width_change.value), r.width_change.s_m);
  if (r.correction_share > kCorrectionOdd)
    r.warnings.push_back(
        formatted("the table closes only when bent by %.1f %% of its largest "
                  "curvature",
                  100.0 * r.correction_share));
}

std::string at(const AtStation& v) { return formatted(" at s = %.0f m", v.s_m); }

std::string radius(const AtStation& curvature) {
  constexpr double kStraight_per_m = 1e-5;
  if (std::abs(curvature.value) < kStraight_per_m) return "straight";
  return formatted("radius %.1f m %s%s", 1.0 / std::abs(curvature.value),
                   curvature.value > 0.0 ? "left" : "right", at(curvature).c_str());
}

std::string json_of(const AtStation& v) {
  return json::Object{}.number("value", v.value).number("s_m", v.s_m).str();
}

}  // namespace

TrackReport check_track(const world::TrackDescription& description, const TrackMap& map) {
  TrackReport r;
  r.name = map.name();
  r.knots = description.knots.size();
  r.length_m = map.length_m();
  const double step_m = map.length_m() / static_cast<double>(map.size());
  r.turned_rad = 0.0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    const TrackPoint &a = map.point(i), &b = map.point((i + 1) % map.size());
    r.turned_rad += step_m * a.curvature_per_m;
    look_at(r, a);
    look_between(r, a, b, step_m);
  }
  const TrackPoint end = map.at(std::nextafter(map.length_m(), 0.0)), start = map.at(0.0);
  r.closure_m = std::hypot(end.x_m - start.x_m, end.y_m - start.y_m);
  const double largest = std::max(std::abs(r.curvature_max.value), std::abs(r.curvature_min.value));
  r.correction_share = correction_per_m(description, map) / largest;
  warn(r);
  return r;
}

std::string to_text(const TrackReport& r) {
  std::string out =
      formatted("%s: %.1f m, %zu knots, turns %.1f degrees to the %s over a lap\n",
                r.name.substr(0, 100).c_str(), r.length_m, r.knots, std::abs(to_deg(r.turned_rad)),
                r.turned_rad > 0.0 ? "left" : "right");
  out += formatted("closure    %.1e m; the table was bent by %.2f %% of its largest curvature\n",
                   r.closure_m, 100.0 * r.correction_share);
  out += "curvature  most to the left: " + radius(r.curvature_max) +
         "; most to the right: " + radius(r.curvature_min) + "\n";
  out += formatted("           steepest change %.2e 1/m^2%s\n", r.curvature_change.value,
                   at(r.curvature_change).c_str());
  out += formatted("width      %.1f m%s to %.1f m%s; line to wall at least %.1f m%s\n",
                   r.width_min.value, at(r.width_min).c_str(), r.width_max.value,
                   at(r.width_max).c_str(), r.wall_nearest.value, at(r.wall_nearest).c_str());
  out += formatted("banking    %.1f degrees%s to %.1f%s; steepest change %.2f degrees/m%s\n",
                   to_deg(r.bank_min.value), at(r.bank_min).c_str(), to_deg(r.bank_max.value),
                   at(r.bank_max).c_str(), to_deg(r.bank_change.value), at(r.bank_change).c_str());
  out += formatted("walls      cross nowhere; radius of the inner wall at least %.1f m%s\n",
                   r.inner_room.value, at(r.inner_room).c_str());
  for (const std::string& warning : r.warnings) out += "warning: " + warning + "\n";
  return out + formatted("%zu warnings\n", r.warnings.size());
}

std::string to_json(const TrackReport& r) {
  json::Array warnings;
  for (const std::string& warning : r.warnings) warnings.text(warning);
  return json::Object{}
             .number("length_m", r.length_m)
             .number("knots", r.knots)
             .number("turned_rad", r.turned_rad)
             .number("closure_m", r.closure_m)
             .number("correction_share", r.correction_share)
             .json("curvature_max_per_m", json_of(r.curvature_max))
             .json("curvature_min_per_m", json_of(r.curvature_min))
             .json("curvature_change_per_m2", json_of(r.curvature_change))
             .json("width_max_m", json_of(r.width_max))
             .json("width_min_m", json_of(r.width_min))
             .json("wall_nearest_m", json_of(r.wall_nearest))
             .json("inner_room_m", json_of(r.inner_room))
             .json("bank_max_rad", json_of(r.bank_max))
             .json("bank_min_rad", json_of(r.bank_min))
             .json("bank_change_rad_per_m", json_of(r.bank_change))
             .json("width_change_m_per_m", json_of(r.width_change))
             .json("warnings", warnings.str())
             .str() +
         "\n";
}

}  // namespace pitwall::track_file
