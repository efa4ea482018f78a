// SPDX-License-Identifier: Apache-2.0
#include "hil/track_file/crossings.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hil/report/text.hpp"
#include "hil/track_file/closed_curve.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::track_file {
namespace {

struct Piece {
  Place a, b;
  std::size_t row = 0;    // of its end
  std::size_t order = 0;  // within its own line
};

double side_of(const Place& a, const Place& b, const Place& p) {
  return (b.x_m - a.x_m) * (p.y_m - a.y_m) - (b.y_m - a.y_m) * (p.x_m - a.x_m);
}

bool apart(double a0, double a1, double b0, double b1) {
  return std::max(a0, a1) < std::min(b0, b1) || std::max(b0, b1) < std::min(a0, a1);
}

bool cross(const Piece& p, const Piece& q) {
  if (apart(p.a.x_m, p.b.x_m, q.a.x_m, q.b.x_m) || apart(p.a.y_m, p.b.y_m, q.a.y_m, q.b.y_m))
    return false;
  return side_of(p.a, p.b, q.a) * side_of(p.a, p.b, q.b) <= 0.0 &&
         side_of(q.a, q.b, p.a) * side_of(q.a, q.b, p.b) <= 0.0;
}

std::vector<std::size_t> thinned(const TrackCsv& csv, const std::vector<std::size_t>& kept) {
  std::vector<std::size_t> out{kept.front()};
  for (const std::size_t i : kept) {
    const CsvRow &a = csv.rows[out.back()], &b = csv.rows[i];
    if (std::hypot(b.x_m - a.x_m, b.y_m - a.y_m) >= kCrossingStep_m) out.push_back(i);
  }
  return out;
}

// offset: -1 right wall, 0 the line itself, 1 left wall
std::vector<Piece> pieces(const TrackCsv& csv, const std::vector<std::size_t>& at, int offset) {
  const std::size_t n = at.size();
  std::vector<Place> places;
  for (std::size_t j = 0; j < n; ++j) {
    const CsvRow& row = csv.rows[at[j]];
    const CsvRow &before = csv.rows[at[(j + n - 1) % n]], &after = csv.rows[at[(j + 1) % n]];
    const double yaw_rad = std::atan2(after.y_m - before.y_m, after.x_m - before.x_m);
    const double n_m = offset == 0 ? 0.0 : offset > 0 ? row.width_left_m : -row.width_right_m;
    places.push_back({row.x_m - n_m * std::sin(yaw_rad), row.y_m + n_m * std::cos(yaw_rad)});
  }
  std::vector<Piece> out;
  for (std::size_t j = 0; j < n; ++j)
    out.push_back({places[j], places[(j + 1) % n], at[(j + 1) % n], j});
  return out;
}

std::optional<Crossing> first_crossing(const TrackCsv& csv, const std::vector<Piece>& one,
                                       const std::vector<Piece>& other, const char* what) {
  for (const Piece& p : one)
    for (const Piece& q : other) {
      const bool same_line = &one == &other;
      const bool joined = q.order <= p.order + 1 || q.order + 1 == p.order + one.size();
      if (same_line && joined) continue;
      if (!cross(p, q)) continue;
      const auto [earlier, later] = std::minmax(p.row, q.row);
      return Crossing{later, formatted("%s at line %zu", what, csv.rows[earlier].line)};
    }
  return std::nullopt;
}

}  // namespace

std::optional<Crossing> crossing_of(const TrackCsv& csv, const std::vector<std::size_t>& kept) {
  const auto at = thinned(csv, kept);
  const auto line = pieces(csv, at, 0), left = pieces(csv, at, 1), right = pieces(csv, at, -1);
  if (auto found = first_crossing(csv, line, line, "the line crosses itself")) return found;
  if (auto found = first_crossing(csv, left, left, "the left wall crosses itself")) return found;
  if (auto found = first_crossing(csv, right, right, "the right wall crosses itself")) return found;
  return first_crossing(csv, left, right, "the left wall crosses the right wall");
}

}  // namespace pitwall::track_file
