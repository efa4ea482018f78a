// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/stop_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "protocol/vocabulary/check.hpp"
#include "vehicle/autonomy/planning/rival.hpp"

namespace pitwall::planning {
namespace {

constexpr std::array kDecelShares{1.0, 0.87, 0.75, 0.65};
constexpr std::array kChangeShares{1.0, 0.75, 0.5, 0.25};  // of the way to the low side
constexpr std::array kBegins{0.0, 0.15, 0.3, 0.45, 0.6};   // of the way to the low speed
constexpr double kChangeMost_mps2 = 1.5;                   // lateral, of the change alone
// Lateral, to end a change that is under way; the largest bend of a path that comes to run along
// the line, per its slope and length.
constexpr double kSettleMost_mps2 = 3.0, kSettleBend = 1.5;
constexpr double kChangeGripShare = 0.95;                     // of the share: the rest brakes
constexpr double kChangeLeast_m = 40.0, kShiftLeast_m = 0.3;  // less is not worth a change
constexpr double kLevel_rad = from_deg(1.0);                  // a road without a low side
constexpr double kBeyond_m = 48.0;                            // clear past the place, too
constexpr double kBeyondShare = 0.4;  // or so much of the way there: brakes may be weaker
// Between the centres of two cars: along, with the length of a car more than they need; beside.
constexpr double kAlong_m = 10.0, kApart_m = 3.0;
constexpr double kSlowest_mps = 1.0;
// What a place costs, in lengths of the shortest stop: 20 degrees of banking and a radius of 230 m.
constexpr double kBankCost_per_rad = 0.75 / from_deg(20.0);
constexpr double kBendCost_m = 0.35 * 230.0;

// The speed over distance, without its jerk: where the car would be slow and where it would stand.
struct Slowing {
  std::array<double, kRoadPoints> speed2{}, time_s{};
  std::size_t low = 0, stands = 0;  // points; stands == kRoadPoints: not within them
};

double distance_m(std::size_t point) { return static_cast<double>(point) * kRoadStep_m; }

Slowing slow_down(const RoadAhead& road, double speed_mps, const StopLimits& limits,
                  double low_speed_mps) {
  Slowing out;
  double v2 = speed_mps * speed_mps;
  const double begin_m = 0.5 * speed_mps * limits.decel_max_mps2 / limits.jerk_max_mps3;
  for (std::size_t i = 0; i < kRoadPoints; ++i) {
    if (!(v2 > 0.0)) break;  // it stands
    out.speed2[i] = v2;
    if (v2 > low_speed_mps * low_speed_mps) out.low = i + 1;
    out.stands = i + 1;
    const double decel =
        distance_m(i) < begin_m ? 0.0 : stop_decel_mps2(road, distance_m(i), std::sqrt(v2), limits);
    v2 = std::max(v2 - 2.0 * kRoadStep_m * decel, 0.0);
    const double step_s = kRoadStep_m / std::max(std::sqrt(out.speed2[i]), kSlowest_mps);
    if (i + 1 < kRoadPoints) out.time_s[i + 1] = out.time_s[i] + step_s;
  }
  out.low = std::min(out.low, kRoadPoints - 1);
  return out;
}

const LinePoint& closest(const Line& line, double s_m) {
  const auto i = static_cast<std::size_t>(line.wrap(s_m) / line.spacing_m + 0.5);
  return line.points[i % line.points.size()];
}

double cost_of(const LinePoint& place, double stretch) {
  return kBankCost_per_rad * std::abs(place.bank_rad) +
         kBendCost_m * std::abs(place.curvature_per_m) + (stretch - 1.0);
}

StopLimits softened(const StopLimits& limits, double share) {
  StopLimits out = limits;
  out.decel_max_mps2 *= share;
  return out;
}

// The gentlest of the decelerations that is worth its longer way.
double choose_decel(const Line& line, const RoadAhead& road, const StopFrom& from,
                    const StopLimits& limits, const StopPathParams& params, Slowing& best) {
  best = slow_down(road, from.speed_mps, limits, params.low_speed_mps);
  if (best.stands >= kRoadPoints) return 1.0;
  const double shortest_m = std::max(distance_m(best.stands), kRoadStep_m);
  double best_share = 1.0;
  double best_cost = cost_of(closest(line, from.s_m + shortest_m), 1.0);
  for (const double share : kDecelShares) {
    if (share == 1.0) continue;
    const Slowing s =
        slow_down(road, from.speed_mps, softened(limits, share), params.low_speed_mps);
    const double length_m = distance_m(s.stands);
    if (s.stands >= kRoadPoints || length_m > params.stretch_max * shortest_m) break;
    const double cost = cost_of(closest(line, from.s_m + length_m), length_m / shortest_m);
    if (cost < best_cost) best_cost = cost, best_share = share, best = s;
  }
  return best_share;
}

// Whether the corner leaves room for the curvature that the change adds.
bool is_carried(const StopLimits& limits, const LinePoint& p, const Offset& without,
                const Offset& with, double speed2) {
  if (std::abs(with.bend_per_m) * speed2 > kChangeMost_mps2) return false;
  const auto load = [&](const Offset& o) {
    return steering::RoadLoad{std::sqrt(speed2), curvature_beside(p.curvature_per_m, o),
                              p.bank_rad};
  };
  const double demand = std::abs(lateral_demand_mps2(load(with)));
  const double share = kChangeGripShare * limits.grip_share;
  return demand <= share * grip_mps2(limits.friction, load(with)) ||
         demand <= std::abs(lateral_demand_mps2(load(without)));
}

// Clear, or no nearer than one of two others is.
bool is_clear(const LinePoint& p, double clearance_m, double n_m, double one_m, double other_m) {
  const double left_m = std::min(clearance_m, p.room_left_m - std::max(one_m, other_m));
  const double right_m = std::min(clearance_m, p.room_right_m + std::min(one_m, other_m));
  return p.room_left_m - n_m >= left_m && p.room_right_m + n_m >= right_m;
}

// How far weak brakes may take it, in points.
std::size_t reach_of(const Slowing& slowing) {
  const double beyond_m = std::max(kBeyond_m, kBeyondShare * distance_m(slowing.stands));
  return std::min(slowing.stands + static_cast<std::size_t>(beyond_m / kRoadStep_m), kRoadPoints);
}

// Slow enough for a car that has not slowed down at all.
void lead_back(StopPath& path, double from_m, double speed_mps) {
  const double n_m = path.beside_m + path.merge.to_m + path.low.to_m;
  if (n_m == 0.0) return;
  const double carried_m = speed_mps * std::sqrt(kLargestBend * std::abs(n_m) / kChangeMost_mps2);
  path.back = {.from_s_m = from_m,
               .length_m = std::max(carried_m, kChangeLeast_m),
               .from_m = 0.0,
               .to_m = -n_m};
}

bool is_possible(const Line& line, const StopPath& path, const StopFrom& from,
                 const StopLimits& limits, const StopPathParams& params, const Slowing& slowing) {
  StopPath straight_on = path;
  straight_on.low = straight_on.back = {};
  const std::size_t reach = reach_of(slowing);
  for (std::size_t i = 0; i < reach; ++i) {
    const LinePoint& p = closest(line, from.s_m + distance_m(i));
    const Offset with = offset_at(path, distance_m(i)),
                 without = offset_at(straight_on, distance_m(i));
    if (!is_clear(p, params.clearance_m, with.n_m, without.n_m, without.n_m)) return false;
    if (!is_carried(limits, p, without, with, slowing.speed2[i])) return false;
  }
  const double back_m = distance_m(reach) + path.back.length_m;
  for (std::size_t i = reach; distance_m(i) < back_m; ++i) {
    const LinePoint& p = closest(line, from.s_m + distance_m(i));
    if (!is_clear(p, params.clearance_m, offset_at(path, distance_m(i)).n_m, path.beside_m, 0.0))
      return false;
  }
  return true;
}

// Whether this path meets the other car before it ends, or stands in the way of one that is behind.
bool meets(const StopPath& path, const Neighbour& other, const Slowing& slowing) {
  const auto is_in_way = [&](std::size_t point) {
    return std::abs(other.offset_m - offset_at(path, distance_m(point)).n_m) < kApart_m;
  };
  const auto lead_m = [&](std::size_t point) {
    return other.ahead_m + other.speed_mps * slowing.time_s[point] - distance_m(point);
  };
  for (std::size_t i = 0; i < slowing.stands; ++i)
    if (std::abs(lead_m(i)) < kAlong_m && is_in_way(i)) return true;
  return slowing.stands < kRoadPoints && lead_m(slowing.stands) < 0.0 && is_in_way(slowing.stands);
}

bool meets_one_of(const StopPath& path, const Neighbours& others, const Slowing& slowing) {
  return std::ranges::any_of(others.span(),
                             [&](const Neighbour& other) { return meets(path, other, slowing); });
}

// Those whom this path does not meet.
Neighbours clear_of(const StopPath& path, std::span<const Neighbour> others,
                    const Slowing& slowing) {
  Neighbours out;
  for (const Neighbour& other : others)
    if (!meets(path, other, slowing)) CHECK(out.push(other));
  return out;
}

// The merge is taken back to where the car is, on the way that was left for it.
StopPath without_merge(const StopPath& path) {
  StopPath out = path;
  const double rest_m = path.merge.from_s_m + path.merge.length_m;
  if (!(path.merge.from_s_m < 0.0 && rest_m > 0.0)) return out;
  const Offset now = offset_at(path.merge, 0.0);
  out.merge = {.from_s_m = 0.0,
               .length_m = rest_m,
               .from_m = now.n_m,
               .to_m = now.n_m,
               .from_slope = now.slope,
               .from_bend_per_m = now.bend_per_m};
  return out;
}

// The rest of a path that is followed, from where the car is.
StopPath rest_of(const StopPath& path) {
  StopPath rest = path;
  for (OffsetChange* const change : {&rest.merge, &rest.low, &rest.back})
    change->from_s_m -= path.gone_m;
  rest.gone_m = 0.0;
  return rest;
}

// Beside the place where the car is, as near as its sideways speed can be taken off.
StopPath ended_here(const StopPath& rest, double speed_mps) {
  const Offset now = offset_at(rest, 0.0);
  const double length_m =
      kSettleBend * std::abs(now.slope) * speed_mps * speed_mps / kSettleMost_mps2;
  StopPath out = rest;
  out.beside_m = 0.0;
  out.low = out.back = {};
  out.merge = {.from_s_m = 0.0,
               .length_m = std::max(length_m, kChangeLeast_m),
               .from_m = now.n_m,
               .to_m = now.n_m + 0.5 * now.slope * length_m,
               .from_slope = now.slope,
               .from_bend_per_m = now.bend_per_m};
  return out;
}

// How far the low side lies at the place where the car will stand; zero where it is level.
double way_down_m(const LinePoint& place, double offset_m, double clearance_m) {
  if (std::abs(place.bank_rad) < kLevel_rad) return 0.0;
  if (place.bank_rad > 0.0) return std::max(place.room_left_m - clearance_m - offset_m, 0.0);
  return std::min(clearance_m - place.room_right_m - offset_m, 0.0);
}

}  // namespace

Neighbours neighbours_of(const Line& line, const LinePosition& car, const world::TrackMap& track,
                         const world::Opponents* cars) {
  Neighbours out;
  if (cars == nullptr) return out;
  const double own_s_m = line.at(car.s_m).track_s_m;
  for (const world::Opponent& other : cars->cars) {
    const double ahead_m = -gap_m(track, own_s_m, other.s_m);
    if (!(std::abs(ahead_m) < kNeighbourReach_m)) continue;  // or nowhere
    const double offset_m = other.n_m - line.at(car.s_m + ahead_m).n_m;
    if (std::isfinite(offset_m + other.speed_mps))
      CHECK(out.push({ahead_m, offset_m, other.speed_mps}));
  }
  return out;
}

Offset offset_at(const StopPath& path, double gone_m) {
  const Offset aside{path.beside_m, 0.0, 0.0};
  return aside + offset_at(path.merge, gone_m) + offset_at(path.low, gone_m) +
         offset_at(path.back, gone_m);
}

RoadAhead road_ahead(const Line& line, const StopPath& path, double s_m) {
  RoadAhead road;
  for (std::size_t i = 0; i < kRoadPoints; ++i) {
    const double at_m = s_m + distance_m(i);
    const LinePoint& p = closest(line, at_m);
    const Offset offset = offset_at(path, path.gone_m + distance_m(i));
    road.at[i] = {curvature_beside(p.curvature_per_m, offset), p.bank_rad};
  }
  return road;
}

StopPath choose_stop(const Line& line, const StopFrom& from, const StopLimits& limits,
                     const StopPathParams& params) {
  StopPath path;
  path.chosen = true;
  path.merge = from.merge;
  path.merge.from_s_m = std::remainder(from.merge.from_s_m - from.s_m, line.length_m);
  path.beside_m = from.beside_m;
  const RoadAhead road = road_ahead(line, path, from.s_m);
  Slowing slowing;
  path.decel_share = choose_decel(line, road, from, limits, params, slowing);
  const double stop_m = distance_m(std::min(slowing.stands, kRoadPoints - 1));
  const double down_m =
      way_down_m(closest(line, from.s_m + stop_m), offset_at(path, stop_m).n_m, params.clearance_m);
  const double reach_m = distance_m(reach_of(slowing));
  const double low_m = distance_m(slowing.low);
  const StopLimits softer = softened(limits, path.decel_share);
  const StopPath as_it_is = without_merge(path);
  const Neighbours others = clear_of(as_it_is, from.neighbours, slowing);
  for (const double share : kChangeShares) {
    if (std::abs(share * down_m) < kShiftLeast_m) break;
    for (const double begin : kBegins) {
      StopPath tried = path;
      tried.low = {.from_s_m = begin * low_m,
                   .length_m = (1.0 - begin) * low_m,
                   .from_m = 0.0,
                   .to_m = share * down_m};
      if (tried.low.length_m < kChangeLeast_m) break;
      lead_back(tried, reach_m, from.speed_mps);
      if (is_possible(line, tried, from, softer, params, slowing) &&
          !meets_one_of(tried, others, slowing))
        return tried;
    }
  }
  if (meets_one_of(path, others, slowing)) path = as_it_is;
  lead_back(path, reach_m, from.speed_mps);
  return path;
}

void keep_clear(StopPath& path, const Line& line, const StopFrom& from, const StopLimits& limits,
                const StopPathParams& params) {
  if (from.neighbours.empty()) return;
  const StopPath rest = rest_of(path);
  const Slowing slowing = slow_down(road_ahead(line, rest, from.s_m), from.speed_mps,
                                    softened(limits, path.decel_share), params.low_speed_mps);
  StopPath here = ended_here(rest, from.speed_mps);
  const Neighbours others = clear_of(here, from.neighbours, slowing);
  if (!meets_one_of(rest, others, slowing)) return;
  lead_back(here, distance_m(reach_of(slowing)), from.speed_mps);
  path = here;
}

}  // namespace pitwall::planning
