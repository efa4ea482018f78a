// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/optimum/offset_line.hpp"

#include <cmath>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::raceline {
namespace {

PlaneVector operator-(const PlaneVector& a, const PlaneVector& b) { return {a.x - b.x, a.y - b.y}; }
PlaneVector operator+(const PlaneVector& a, const PlaneVector& b) { return {a.x + b.x, a.y + b.y}; }
PlaneVector operator*(double factor, const PlaneVector& a) { return {factor * a.x, factor * a.y}; }
double dot(const PlaneVector& a, const PlaneVector& b) { return a.x * b.x + a.y * b.y; }
double cross(const PlaneVector& a, const PlaneVector& b) { return a.x * b.y - a.y * b.x; }
double norm(const PlaneVector& a) { return std::hypot(a.x, a.y); }

}  // namespace

OffsetLine::OffsetLine(const world::TrackMap& track, std::size_t count) : offset_m(count, 0.0) {
  for (std::size_t i = 0; i < count; ++i) {
    const double s_m = track.length_m() * static_cast<double>(i) / static_cast<double>(count);
    const world::TrackPoint p = track.at(s_m);
    station_m.push_back(s_m);
    origin_.push_back({p.x_m, p.y_m});
    left_.push_back({-std::sin(p.yaw_rad), std::cos(p.yaw_rad)});
  }
}

PlaneVector OffsetLine::place(std::size_t i) const { return origin_[i] + offset_m[i] * left_[i]; }

Bend OffsetLine::bend(std::size_t i) const {
  const std::size_t n = size(), before = (i + n - 1) % n, after = (i + 1) % n;
  const PlaneVector a = place(i) - place(before), b = place(after) - place(i), c = a + b;
  const double la = norm(a), lb = norm(b), lc = norm(c);
  Bend bend{.curvature_per_m = 2.0 * cross(a, b) / (la * lb * lc), .length_m = 0.5 * (la + lb)};
  // What moves with each of the three offsets: the two chords.
  const PlaneVector zero{}, back = -1.0 * left_[before], in = left_[i], out = -1.0 * left_[i];
  const std::array<std::array<PlaneVector, 2>, 3> moves{
      {{back, zero}, {in, out}, {zero, left_[after]}}};
  for (std::size_t k = 0; k < moves.size(); ++k) {
    const auto& [da, db] = moves[k];
    const double dla = dot(a, da) / la, dlb = dot(b, db) / lb, dlc = dot(c, da + db) / lc;
    bend.curvature_by_offset[k] = 2.0 * (cross(da, b) + cross(a, db)) / (la * lb * lc) -
                                  bend.curvature_per_m * (dla / la + dlb / lb + dlc / lc);
    bend.length_by_offset[k] = 0.5 * (dla + dlb);
  }
  return bend;
}

Step OffsetLine::step(std::size_t i) const {
  const std::size_t after = (i + 1) % size();
  const PlaneVector b = place(after) - place(i);
  const double length_m = norm(b);
  return {length_m, {-dot(b, left_[i]) / length_m, dot(b, left_[after]) / length_m}};
}

Result<OffsetBounds, Problem> bounds_of(const OffsetLine& line, const Lanes& lanes,
                                        double margin_m) {
  OffsetBounds bounds;
  const double half_m = 0.5 * lanes.track().length_m() / static_cast<double>(line.size());
  for (const double s_m : line.station_m) {
    const Band free =
        lanes.narrowest(Region::kTrack, s_m - half_m, s_m + half_m).narrowed(margin_m);
    if (!(free.width_m() > 0.0))
      return refuse(formatted("%s: s = %.1f m", lanes.track().name().c_str(), s_m),
                    formatted("the track is %.2f m wide, more than %.2f m expected",
                              free.width_m() + 2.0 * margin_m, 2.0 * margin_m));
    bounds.low_m.push_back(free.right_m), bounds.high_m.push_back(free.left_m);
  }
  return bounds;
}

std::size_t stations_of(const world::TrackMap& track, double step_m, std::size_t every) {
  const double groups = std::ceil(track.length_m() / (step_m * static_cast<double>(every)));
  return every * static_cast<std::size_t>(groups);
}

}  // namespace pitwall::raceline
