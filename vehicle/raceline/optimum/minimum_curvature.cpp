// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/optimum/minimum_curvature.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "protocol/vocabulary/text.hpp"
#include "vehicle/raceline/optimum/box_problem.hpp"

namespace pitwall::raceline {
namespace {

constexpr double kStep_m = 4.0;  // between stations
constexpr int kRoundsMax = 50;
constexpr double kSettled = 1e-6;  // of the sum, by which a round lessens it
constexpr int kHalvingsMax = 6;
constexpr std::size_t kEvery = 3;  // stations from waypoint to waypoint

struct Vector {
  double x = 0.0, y = 0.0;
};
Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y}; }
Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y}; }
Vector operator*(double factor, const Vector& a) { return {factor * a.x, factor * a.y}; }
double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y; }
double cross(const Vector& a, const Vector& b) { return a.x * b.y - a.y * b.x; }
double norm(const Vector& a) { return std::hypot(a.x, a.y); }

// The curvature of the circle through three points times the root of the length that it stands for,
// and its derivatives by the offsets of the three.
struct Bend {
  double value = 0.0;
  std::array<double, 3> by_offset{};
};

class OffsetLine {
 public:
  OffsetLine(const world::TrackMap& track, std::size_t count) : offset_m(count, 0.0) {
    for (std::size_t i = 0; i < count; ++i) {
      const double s_m = track.length_m() * static_cast<double>(i) / static_cast<double>(count);
      const world::TrackPoint p = track.at(s_m);
      station_m.push_back(s_m);
      origin_.push_back({p.x_m, p.y_m});
      left_.push_back({-std::sin(p.yaw_rad), std::cos(p.yaw_rad)});
    }
  }

  std::size_t size() const { return offset_m.size(); }

  Bend bend(std::size_t i) const {
    const std::size_t n = size(), before = (i + n - 1) % n, after = (i + 1) % n;
    const Vector a = place(i) - place(before), b = place(after) - place(i), c = a + b;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    const double curvature = 2.0 * cross(a, b) / (la * lb * lc);
    const double root = std::sqrt(0.5 * (la + lb));
    Bend bend{curvature * root, {}};
    // What moves with each of the three offsets: the two chords.
    const Vector zero{}, back = -1.0 * left_[before], in = left_[i], out = -1.0 * left_[i];
    const std::array<std::array<Vector, 2>, 3> moves{
        {{back, zero}, {in, out}, {zero, left_[after]}}};
    for (std::size_t k = 0; k < moves.size(); ++k) {
      const auto& [da, db] = moves[k];
      const double dla = dot(a, da) / la, dlb = dot(b, db) / lb, dlc = dot(c, da + db) / lc;
      const double d_curvature = 2.0 * (cross(da, b) + cross(a, db)) / (la * lb * lc) -
                                 curvature * (dla / la + dlb / lb + dlc / lc);
      bend.by_offset[k] = root * d_curvature + curvature * 0.25 * (dla + dlb) / root;
    }
    return bend;
  }

  double sum() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < size(); ++i) sum += bend(i).value * bend(i).value;
    return sum;
  }

  std::vector<double> station_m, offset_m;

 private:
  Vector place(std::size_t i) const { return origin_[i] + offset_m[i] * left_[i]; }

  std::vector<Vector> origin_, left_;
};

// Half of the sum of squares of the bends, made linear in the offsets around where they are.
BoxProblem linearised(const OffsetLine& line) {
  const std::size_t n = line.size();
  BoxProblem problem{
      std::vector<std::array<double, kReach + 1>>(n), std::vector<double>(n), {}, {}};
  for (std::size_t i = 0; i < n; ++i) {
    const Bend bend = line.bend(i);
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

Result<std::vector<Waypoint>, Problem> minimum_curvature(const Lanes& lanes, double margin_m) {
  const world::TrackMap& track = lanes.track();
  OffsetLine line{
      track, kEvery * static_cast<std::size_t>(std::ceil(track.length_m() / (kStep_m * kEvery)))};
  std::vector<double> low, high;
  for (const double s_m : line.station_m) {
    const Band free = lanes.narrowest(Region::kTrack, s_m - 0.5 * kStep_m, s_m + 0.5 * kStep_m)
                          .narrowed(margin_m);
    if (!(free.width_m() > 0.0))
      return refuse(formatted("%s: s = %.1f m", track.name().c_str(), s_m),
                    formatted("the track is %.2f m wide, more than %.2f m expected",
                              free.width_m() + 2.0 * margin_m, 2.0 * margin_m));
    low.push_back(free.right_m), high.push_back(free.left_m);
    line.offset_m[low.size() - 1] = free.middle_m();
  }
  for (int round = 0; round < kRoundsMax; ++round) {
    BoxProblem problem = linearised(line);
    problem.low = low, problem.high = high;
    const auto best = minimise(problem);
    if (!best) return unsettled(lanes);
    const std::vector<double> from = line.offset_m;
    const double before = line.sum();
    double share = 1.0;
    for (int halving = 0; halving < kHalvingsMax; ++halving, share *= 0.5) {
      for (std::size_t i = 0; i < from.size(); ++i)
        line.offset_m[i] = from[i] + share * ((*best)[i] - from[i]);
      if (line.sum() <= before) break;
    }
    if (before - line.sum() > kSettled * before) continue;
    std::vector<Waypoint> waypoints;
    for (std::size_t i = 0; i < line.size(); i += kEvery)
      waypoints.push_back({line.station_m[i], line.offset_m[i]});
    return waypoints;
  }
  return unsettled(lanes);
}

}  // namespace pitwall::raceline
