// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/race.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "vehicle/autonomy/planning/flag_speed.hpp"
#include "vehicle/autonomy/planning/paper_race.hpp"

namespace pitwall::planning {
namespace {

constexpr double kStep_s = 0.1, kHorizon_s = 25.0;  // of the own profile past a rival
constexpr double kMargin_m = 10.0;                  // of the gap that the profile must gain
constexpr double kDrift_s = 3.0;                    // over which a drift is believed
constexpr double kWayStep_m = 20.0, kWay_m = 400.0;
constexpr double kInWay_m =
    2.6;  // lateral distance of the centres, below which a car is in the way
constexpr double kAnyLimit_mps = 1e3;
constexpr std::array kStretches{1.0, 1.4, 2.0, 2.8};  // of a merge
constexpr double kCarried = 1.06;   // of the grip that is planned with: the governor slows, too
constexpr double kMoves_mps = 2.0;  // a slower car beside the way is passed even behind flags

// The places of our car on every line, once.
struct Places {
  std::array<double, kRaceLines> s_m{};
};

Places places_of(const RaceInputs& in) {
  const LinePoint p = in.lines[in.line].at(in.car.s_m);
  Places out;
  for (std::size_t i = 0; i < in.lines.size(); ++i)
    out.s_m[i] = i == in.line ? in.car.s_m : in.lines[i].project(p.x_m, p.y_m).s_m;
  return out;
}

// Another car along the line that it is nearest to, at its distance from it; for some seconds it
// may go on to leave it as it does.
struct OtherPath {
  std::size_t line = 0;
  double aside_m = 0.0, drift_mps = 0.0;
};

OtherPath path_of(const RaceInputs& in, const Places& at, const Rival& car) {
  OtherPath best;
  for (std::size_t i = 0; i < in.lines.size(); ++i) {
    const double n_m = in.lines[i].at(at.s_m[i] - car.gap_m).n_m;
    const double aside_m = car.n_m - n_m;
    if (i == 0 || std::abs(aside_m) < std::abs(best.aside_m)) best = {i, aside_m, car.drift_mps};
  }
  return best;
}

// Least lateral distance of a line to the path of another car, over the road ahead.
double beside_m(const RaceInputs& in, const Places& at, std::size_t line, const OtherPath& path) {
  double least_m = HUGE_VAL;
  for (double d_m = 0.0; d_m <= kWay_m; d_m += kWayStep_m) {
    const double own_n_m = in.lines[line].at(at.s_m[line] + d_m).n_m;
    const double n_m = in.lines[path.line].at(at.s_m[path.line] + d_m).n_m;
    const double after_s = std::min(d_m / std::max(in.own.speed_mps, 1.0), kDrift_s);
    const double beside_m = own_n_m - n_m - path.aside_m;
    least_m =
        std::min({least_m, std::abs(beside_m), std::abs(beside_m - path.drift_mps * after_s)});
  }
  return least_m;
}

// Greatest gap to the rival that the own limited profile reaches within the horizon.
double gained_m(const RaceInputs& in, const Line& line, double s_m, const Rival& rival,
                double speed_max_mps) {
  const SpeedsAhead ahead = look_ahead(line, s_m, in.limits);
  double gap_m = rival.gap_m, most_m = gap_m, gone_m = 0.0, speed_mps = in.own.speed_mps;
  for (double t_s = 0.0; t_s < kHorizon_s; t_s += kStep_s) {
    const auto i = static_cast<std::size_t>(gone_m / kAheadStep_m);
    if (i >= ahead.at.size()) break;
    steering::RoadLoad road = ahead.at[i].road;
    road.speed_mps = std::max(speed_mps, 1.0);
    const double accel_mps2 =
        std::min(envelope::drive_available_mps2(in.limits.friction, road, in.limits.grip_share),
                 in.limits.pace.accel_max_mps2);
    speed_mps = std::min({speed_mps + accel_mps2 * kStep_s, speed_max_mps, ahead.at[i].speed_mps});
    gone_m += speed_mps * kStep_s;
    gap_m += (speed_mps - rival.speed_mps) * kStep_s;
    most_m = std::max(most_m, gap_m);
  }
  return most_m - kMargin_m;
}

std::array<PassWay, kRaceLines> ways_past(const PassParams& p, const RaceInputs& in,
                                          const Places& at, const Rival& rival) {
  std::array<PassWay, kRaceLines> ways;
  const double speed_mps = std::min(std::max(in.base_mps, rival.speed_mps) + p.pass_extra_mps,
                                    std::isfinite(in.most_mps) ? in.most_mps : kAnyLimit_mps);
  for (std::size_t i = 0; i < in.lines.size(); ++i) {
    double least_m = HUGE_VAL;
    for (const world::Opponent& car : in.cars.cars) {
      const Rival other = rival_of(in.track, in.own, car, rival.at);
      const bool matters = other.known && other.gap_m > -p.rival.watch_ahead_m &&
                           other.gap_m < p.trail_gap_m && other.speed_mps < speed_mps;
      if (matters) least_m = std::min(least_m, beside_m(in, at, i, path_of(in, at, other)));
    }
    ways[i].beside_m = least_m;
    if (least_m < p.side_clear_m) continue;
    ways[i].gained_m = gained_m(in, in.lines[i], at.s_m[i], rival, speed_mps);
  }
  return ways;
}

// The slowest that a car in the way of the planned path asks for.
double in_way_mps(const PassParams& p, const RaceInputs& in, const PassState& state,
                  bool keeps_behind) {
  const Line& line = in.lines[in.line];
  double least_mps = HUGE_VAL;
  for (const world::Opponent& car : in.cars.cars) {
    const Rival other = rival_of(in.track, in.own, car, state.rival.at);
    const double ahead_m = -other.gap_m;
    if (!other.known || !(ahead_m > 0.0)) continue;
    const double s_m = in.car.s_m + ahead_m;
    const double path_n_m = line.at(s_m).n_m + offset_at(line, in.merge, s_m).n_m;
    const bool is_rival = state.rival.known && other.id == state.rival.id;
    const bool trails = is_rival && state.phase == PassPhase::kTrail;
    const bool blocks = std::abs(path_n_m - other.n_m) < kInWay_m;
    if (!blocks && !(is_rival && trails && keeps_behind && other.speed_mps > kMoves_mps)) continue;
    const double brake_mps2 =
        is_racing(in.race_control) ? p.brake_mps2 : std::min(p.brake_mps2, in.gentle_mps2);
    least_mps = std::min(least_mps, follow_mps(p, brake_mps2, ahead_m, other.speed_mps, trails));
  }
  return least_mps;
}

// Whether the corners have room for what the change adds.
bool is_carried(const OffsetChange& change, const SpeedsAhead& ahead, double speed_mps,
                const DriveLimits& limits) {
  for (std::size_t i = 0; i < ahead.at.size(); ++i) {
    const double gone_m = static_cast<double>(i) * kAheadStep_m;
    if (gone_m > change.length_m) break;
    steering::RoadLoad road = ahead.at[i].road;
    road.speed_mps = std::min(speed_mps, ahead.at[i].speed_mps);
    road.curvature_per_m =
        curvature_beside(road.curvature_per_m, offset_at(change, change.from_s_m + gone_m));
    const double carried_mps2 = limits.grip_share * grip_mps2(limits.friction, road);
    if (std::abs(lateral_demand_mps2(road)) > kCarried * carried_mps2) return false;
  }
  return true;
}

RaceReason reason_of(PassPhase phase) {
  switch (phase) {
    case PassPhase::kFree:  // closes up to a rival that is not seen yet
    case PassPhase::kTrail:
      return RaceReason::kTrail;
    case PassPhase::kPass:
    case PassPhase::kAhead:
      return RaceReason::kPass;
    case PassPhase::kYield:
      return RaceReason::kYield;
  }
  return RaceReason::kNone;
}

}  // namespace

RaceDecision race(const PassParams& p, PassState& state, const RaceInputs& in, Instant now) {
  bool attacks = in.race_control.vehicle == world::VehicleFlag::kAttacker;
  const bool waving = in.race_control.track == world::TrackFlag::kWavingGreen;
  const bool green = waving || in.race_control.track == world::TrackFlag::kGreen;
  state.attempt = choose_attempt(state.attempt, in.fuel, attacks && green, waving);
  attacks = attacks && state.attempt != AttemptChoice::kDeclined;
  const Rival rival = follow(p.rival, state.rival, in.track, in.own, in.cars, now);
  std::array<PassWay, kRaceLines> ways;
  std::size_t known_ways = 0;
  if (rival.known && attacks && waving && in.line < in.lines.size() &&
      state.phase == PassPhase::kTrail) {
    ways = ways_past(p, in, places_of(in), rival);
    known_ways = in.lines.size();
  }
  const double rival_gap_m = rival.known ? rival.gap_m : 0.0;
  const PassInputs inputs{.rival = rival,
                          .base_mps = in.base_mps,
                          .most_mps = std::isfinite(in.most_mps) ? in.most_mps : kAnyLimit_mps,
                          .may_pass = attacks && waving && in.line < in.lines.size(),
                          .may_close = attacks && green,
                          .ways = {ways.data(), known_ways},
                          .line_n_m = in.lines[in.line].at(in.car.s_m - rival_gap_m).n_m,
                          .speed_mps = in.own.speed_mps,
                          .has_merged = is_over(in.lines[in.line], in.merge, in.car.s_m)};
  state = p.law == PassLaw::kPaper ? advance_paper(p, state, inputs, in.lines.size(), now)
                                   : advance(p, state, inputs, now);
  RaceDecision out{pass_speed_mps(p, state, inputs), RaceReason::kNone};
  if (out.speed_mps != in.base_mps) out.reason = reason_of(state.phase);
  // Behind flags nobody overtakes.
  const double behind_mps = in_way_mps(p, in, state, attacks || !is_racing(in.race_control));
  if (behind_mps < out.speed_mps) {
    out.speed_mps = behind_mps;
    out.reason = state.phase == PassPhase::kTrail ? RaceReason::kTrail : RaceReason::kCarAhead;
  }
  if (state.attempt == AttemptChoice::kDeclined) out.reason = RaceReason::kDeclined;
  return out;
}

OffsetChange change_line(const Line& from, const OffsetChange& merge, double s_m, const Line& to,
                         double length_m) {
  const Beside path = beside(from.at(s_m), offset_at(from, merge, s_m));
  const LinePosition at = to.project(path.x_m, path.y_m);
  const Offset begin = offset_of(to.at(at.s_m), at.offset_m, path.yaw_rad, path.curvature_per_m);
  return {.from_s_m = at.s_m,
          .length_m = length_m,
          .from_m = begin.n_m,
          .to_m = 0.0,
          .from_slope = begin.slope,
          .from_bend_per_m = begin.bend_per_m};
}

double unhurried_m(const Line& from, const OffsetChange& merge, double s_m, const Line& to,
                   double length_m, double speed_mps, const DriveLimits& limits) {
  std::optional<SpeedsAhead> ahead;
  double tried_m = length_m;
  for (const double stretch : kStretches) {
    tried_m = stretch * length_m;
    const OffsetChange change = change_line(from, merge, s_m, to, tried_m);
    if (!ahead) ahead = look_ahead(to, change.from_s_m, limits);
    if (is_carried(change, *ahead, speed_mps, limits)) break;
  }
  return tried_m;
}

}  // namespace pitwall::planning
