// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/planning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "vehicle/autonomy/planning/race.hpp"
#include "vehicle/autonomy/planning/speed_profile.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::planning {
namespace {

using world::EgoState;
using world::LegalRange;

constexpr double kTickMax_s = 0.2;      // a longer gap between steps moves the reference no further
constexpr double kBeyondStop_m = 40.0;  // path past the standstill: control looks ahead
constexpr double kGentleShare = 0.7;    // of comfort, with which a car ahead is met behind flags
constexpr double kCoastLeast_mps2 = 1.0;  // with the engine's own drag

std::optional<Problem> illegal_line(const LineParams& p) {
  if (auto problem = world::first_illegal(kOffsetRanges, p, "line.")) return problem;
  if (auto problem = world::first_illegal(kLineRanges, p, "line.")) return problem;
  return world::first_illegal(envelope::kFrictionRanges, p.friction, "line.friction.");
}

std::optional<Problem> illegal_tyres(const world::TyreGrip& tyres) {
  if (world::is_legal(tyres)) return std::nullopt;
  return Problem{"line.friction.tyres",
                 "temperatures must rise, shares must lie in (0, 1] and not fall"};
}

std::optional<Problem> illegal_stop(const Params& p) {
  if (auto problem = world::first_illegal(kStopPathRanges, p.stop_path, "stop_path."))
    return problem;
  return world::first_illegal(std::array{
      LegalRange{"stop_friction", p.stop_friction, 0.3, 2.0},
      LegalRange{"emergency_decel_max_mps2", p.emergency_decel_max_mps2, p.stop_decel_max_mps2, 15},
      LegalRange{"emergency_jerk_max_mps3", p.emergency_jerk_max_mps3, p.stop_jerk_max_mps3, 30},
      LegalRange{"emergency_grip_share", p.emergency_grip_share, p.stop_grip_share, 0.95}});
}

bool usable(const EgoState& ego) {
  const bool placed =
      ego.validity == world::Validity::kGood || ego.validity == world::Validity::kDeadReckoning;
  return placed && std::isfinite(ego.x_m + ego.y_m + ego.vx_mps);
}

void merge_if_far(const Params& params, const Line& line, const LinePosition& car, double speed_mps,
                  State& state) {
  OffsetChange& merge = state.merge;
  if (merge.length_m > 0.0 && is_over(line, merge, car.s_m)) merge = {};
  const double wanted_m = offset_at(line, merge, car.s_m).n_m;
  if (std::abs(car.offset_m - wanted_m) <= params.merge_from_m) return;
  merge = {.from_s_m = car.s_m,
           .length_m = std::clamp(speed_mps * params.merge_time_s, params.merge_least_m,
                                  std::max(params.merge_least_m, 0.5 * line.length_m)),
           .from_m = car.offset_m,
           .to_m = 0.0};
}

// At the mean speed, as of a constant acceleration; infinite for a car that stands.
double travel_s(double step_m, double from_mps, double to_mps) {
  const double mean_mps = 0.5 * (from_mps + to_mps);
  return mean_mps > 0.0 ? step_m / mean_mps : std::numeric_limits<double>::infinity();
}

template <class OffsetAt>
world::Trajectory trajectory(const Line& line, double line_s_m, OffsetAt offset,
                             const SpeedProfile& profile, Instant now) {
  world::Trajectory out;
  out.at = now;
  double s_m = 0.0, time_s = 0.0;
  for (std::size_t i = 0; i < profile.at.size(); ++i) {
    const double ahead_m = static_cast<double>(i) * profile.spacing_m;
    const LinePoint p = line.at(line_s_m + ahead_m);
    const Offset aside = offset(ahead_m);
    const Beside at = beside(p, aside);
    if (i > 0) {
      const world::TrajectoryPoint& last = out.points.back();
      const double step_m = std::hypot(at.x_m - last.x_m, at.y_m - last.y_m);
      s_m += step_m;
      time_s += travel_s(step_m, last.speed_mps, profile.at[i].speed_mps);
    }
    const bool pushed = out.points.push({.s_m = s_m,
                                         .x_m = at.x_m,
                                         .y_m = at.y_m,
                                         .yaw_rad = at.yaw_rad,
                                         .curvature_per_m = at.curvature_per_m,
                                         .bank_rad = p.bank_rad,
                                         .speed_mps = profile.at[i].speed_mps,
                                         .accel_mps2 = profile.at[i].accel_mps2,
                                         .time_s = time_s,
                                         .room_left_m = p.room_left_m - aside.n_m,
                                         .room_right_m = p.room_right_m + aside.n_m});
    CHECK(pushed);
  }
  return out;
}

void demand_everywhere(world::Trajectory& drive, double speed_mps) {
  for (world::TrajectoryPoint& point : drive.points) {
    point.speed_mps = speed_mps;
    point.accel_mps2 = 0.0;
    point.time_s = point.s_m > 0.0 ? travel_s(point.s_m, speed_mps, speed_mps) : 0.0;
  }
}

bool stops(Followed followed) {
  return followed == Followed::kStop || followed == Followed::kEmergency;
}

struct Limits {
  DriveLimits drive;
  StopLimits stop;
};

// Racing is for what race control wants on a green track; behind flags, and when the operator or a
// silent radio slows the car, it drives gently, but for a car in the way that it sees late.
Pace pace_of(const Params& p, const SpeedDemand& demand) {
  if (demand.races) return p.racing;
  Pace pace = p.comfort;
  if (demand.reason == Reason::kCarAhead || demand.reason == Reason::kTrail)
    pace.decel_max_mps2 = p.racing.decel_max_mps2, pace.jerk_max_mps3 = p.racing.jerk_max_mps3;
  return pace;
}

// In the order of RaceReason.
constexpr std::array kRaceReasons{Reason::kUnknown, Reason::kTrail,    Reason::kPass,
                                  Reason::kGiveWay, Reason::kCarAhead, Reason::kDeclined};

Limits limits_of(const Params& p, const Inputs& in, const SpeedDemand& demand, double speed_mps) {
  const envelope::FrictionParams friction = on_tyres(p.line.friction, in.tyre_c);
  envelope::FrictionParams stopping = friction;
  stopping.friction *= std::min(p.stop_friction / p.line.friction.friction, 1.0);
  const bool coasts = in.followed == Followed::kCoast;
  const double coast_mps2 = std::max(coasting_mps2(friction, speed_mps), kCoastLeast_mps2);
  const bool hard = in.followed == Followed::kEmergency;
  Pace pace = pace_of(p, demand);
  Pace corners = p.racing;
  if (coasts) pace.decel_max_mps2 = corners.decel_max_mps2 = coast_mps2;
  return {.drive = {.target_mps = coasts ? 0.0 : demand.speed_mps,
                    .pace = pace,
                    .corners = corners,
                    .brake_most_mps2 = coasts ? coast_mps2 : HUGE_VAL,
                    .friction = friction,
                    .grip_share = p.line.grip_share,
                    .tyres = world::place_of(p.line.friction.tyres, in.tyre_c),
                    .steering = in.steering},
          .stop = {.friction = stopping,
                   .grip_share = hard ? p.emergency_grip_share : p.stop_grip_share,
                   .decel_max_mps2 = hard ? p.emergency_decel_max_mps2 : p.stop_decel_max_mps2,
                   .jerk_max_mps3 = hard ? p.emergency_jerk_max_mps3 : p.stop_jerk_max_mps3}};
}

// The path that is driven goes on, and merges with another line.
void go_to_line(const Lines& lines, std::size_t line, double length_m, const EgoState& ego,
                LinePosition& car, State& next) {
  const Line& to = lines[line];
  next.merge = change_line(lines[next.line], next.merge, car.s_m, to, length_m);
  next.line = line;
  car = to.project(ego.x_m, ego.y_m);
}

// The line and the speed that the other cars leave, from the demand of flags and operator.
SpeedDemand race_on(const Params& p, const Lines& lines, const world::TrackMap& track,
                    const Inputs& in, const SpeedDemand& demand, LinePosition& car, State& next,
                    Instant now) {
  const Limits limits = limits_of(p, in, demand, std::max(in.ego.vx_mps, 0.0));
  const LinePoint here = lines[next.line].at(car.s_m);
  const OwnPlace own{.track_s_m = here.track_s_m, .speed_mps = in.ego.vx_mps};
  const RaceDecision decision = race(p.passing->pass, next.pass,
                                     {.lines = lines,
                                      .track = track,
                                      .cars = *in.cars,
                                      .race_control = in.race_control,
                                      .fuel = in.fuel,
                                      .line = next.line,
                                      .car = car,
                                      .merge = next.merge,
                                      .own = own,
                                      .base_mps = demand.speed_mps,
                                      .most_mps = in.operator_speed_limit_mps,
                                      .gentle_mps2 = kGentleShare * p.comfort.decel_max_mps2,
                                      .limits = limits.drive},
                                     now);
  if (next.pass.line != next.line && next.line < lines.size()) {
    double length_m = std::max(in.ego.vx_mps * p.passing->pass.merge_time_s, p.merge_least_m);
    if (next.pass.phase == PassPhase::kAhead)
      length_m = unhurried_m(lines[next.line], next.merge, car.s_m, lines[next.pass.line], length_m,
                             in.ego.vx_mps, limits.drive);
    go_to_line(lines, next.pass.line, length_m, in.ego, car, next);
  }
  if (decision.reason == RaceReason::kNone) return demand;
  return {decision.speed_mps, kRaceReasons[static_cast<std::size_t>(decision.reason)],
          is_racing(in.race_control)};
}

// Comes in, stops at the box, drives out again. The pit's line is that after all others.
SpeedDemand by_pit(const Params& p, const Lines& lines, const Inputs& in, const SpeedDemand& demand,
                   LinePosition& car, State& next) {
  if (in.pit == nullptr) return demand;
  const world::RaceControl& rc = in.race_control;
  const bool comes_in =
      rc.ever_received && demand_of(rc.track, rc.vehicle) == world::FlagDemand::kComeIn;
  const double speed_mps = std::max(in.ego.vx_mps, 0.0);
  OnTheWay way{.speed_mps = speed_mps,
               .merge_m = std::max(speed_mps * p.merge_time_s, p.merge_least_m),
               .decel_mps2 = p.comfort.decel_max_mps2};
  const bool on_own = next.line == 0 && next.pass.line == 0;
  if (on_own && comes_in) {
    way.s_m = in.pit->line.project(in.ego.x_m, in.ego.y_m).s_m;
    if (turns_in(*in.pit, way)) go_to_line(lines, lines.size(), way.merge_m, in.ego, car, next);
  }
  if (next.line != lines.size()) return demand;
  way.s_m = car.s_m;
  if (!is_in_lane(*in.pit, car.s_m)) {
    const bool is_out = in.pit->line.wrap(car.s_m) < 0.5 * in.pit->line.length_m;
    if (!comes_in || is_out) {
      go_to_line(lines, 0, way.merge_m, in.ego, car, next);
      return demand;
    }
    const double lane_mps = to_lane_mps(*in.pit, way);
    return lane_mps < demand.speed_mps ? SpeedDemand{lane_mps, Reason::kPitLane} : demand;
  }
  const double box_mps = comes_in ? to_box_mps(*in.pit, way) : HUGE_VAL;
  return box_mps < demand.speed_mps ? SpeedDemand{box_mps, Reason::kBox} : demand;
}

// The path that is followed stays but for a car in its way; before, it is chosen anew from where
// the car is.
void plan_stop_path(const Params& params, const Line& line, const LinePosition& car,
                    const Neighbours& neighbours, double speed_mps, Followed followed,
                    const StopLimits& limits, State& state) {
  const StopFrom from{.s_m = car.s_m,
                      .speed_mps = speed_mps,
                      .merge = state.merge,
                      .beside_m = car.offset_m - offset_at(line, state.merge, car.s_m).n_m,
                      .neighbours = neighbours.span()};
  if (stops(followed) && state.stop.chosen) {
    state.stop.gone_m += std::remainder(car.s_m - state.line_s_m, line.length_m);
    keep_clear(state.stop, line, from, limits, params.stop_path);
    return;
  }
  state.stop = choose_stop(line, from, limits, params.stop_path);
}

// The reference at `now`: moved on by what control followed, kept near the measured speed.
SpeedReference reference(const Params& params, const SpeedsAhead& ahead, const State& state,
                         const RoadAhead& road, const Limits& limits, const Inputs& in,
                         Instant now) {
  const double speed_mps = std::max(in.ego.vx_mps, 0.0);
  if (!state.started) return {speed_mps, 0.0};
  const double dt_s = std::clamp((now - state.at).seconds(), 0.0, kTickMax_s);
  const SpeedReference last{state.speed_mps, state.accel_mps2};
  const SpeedReference next = stops(in.followed) ? advance_stop(road, last, limits.stop, dt_s)
                                                 : advance_drive(ahead, last, limits.drive, dt_s);
  const double low = std::max(speed_mps - params.speed_band_mps, 0.0);
  return {std::clamp(next.speed_mps, low, speed_mps + params.speed_band_mps), next.accel_mps2};
}

// The demand, or the road where that is slower.
SpeedDemand with_road(const LinePoint& here, const DriveLimits& limits, const SpeedsAhead& ahead,
                      const SpeedDemand& demand) {
  constexpr double kSlower_mps = 0.05;
  const double limit = limit_mps(here, limits), corner = ahead.at[0].speed_mps;
  if (!(std::min(limit, corner) < demand.speed_mps)) return demand;
  if (corner < limit - kSlower_mps) return {corner, Reason::kCornerAhead};
  const bool cold = limit < limit_mps(here, world::kWarmTyres) - kSlower_mps;
  return {limit, cold ? Reason::kTyreLimit : Reason::kLineLimit};
}

std::optional<Problem> illegal_pace(const Params& p) {
  if (auto problem = world::first_illegal(kPaceRanges, p.comfort)) return problem;
  const Pace &least = p.comfort, &most = p.racing;
  return world::first_illegal(std::array{
      LegalRange{"racing.accel_max_mps2", most.accel_max_mps2, least.accel_max_mps2, 10.0},
      LegalRange{"racing.decel_max_mps2", most.decel_max_mps2, least.decel_max_mps2, 10.0},
      LegalRange{"racing.jerk_max_mps3", most.jerk_max_mps3, least.jerk_max_mps3, 30.0}});
}

// A car that starts in the pit lane, or finds itself there, is on the pit's line.
std::size_t line_at_start(const Lines& lines, const Inputs& in, std::size_t line) {
  constexpr double kBeside_m = 4.0;
  if (in.pit == nullptr) return line;
  const LinePosition at = in.pit->line.project(in.ego.x_m, in.ego.y_m);
  const double from_own_m = lines.own.project(in.ego.x_m, in.ego.y_m).offset_m;
  const bool in_pit = is_in_lane(*in.pit, at.s_m) && std::abs(at.offset_m) < kBeside_m &&
                      std::abs(from_own_m) > kBeside_m;
  return in_pit ? lines.size() : line;
}

}  // namespace

Result<Line, Problem> prepare(const Params& params, const world::TrackMap& track,
                              const world::RacelineBank* bank,
                              const std::optional<envelope::SteeringLimit>& steering) {
  if (auto problem = illegal_line(params.line)) return Unexpected{*problem};
  if (auto problem = illegal_tyres(params.line.friction.tyres)) return Unexpected{*problem};
  if (auto problem = world::first_illegal(kRanges, params)) return Unexpected{*problem};
  if (auto problem = illegal_pace(params)) return Unexpected{*problem};
  if (auto problem = illegal_stop(params)) return Unexpected{*problem};
  return build_line(track, params.line, bank, steering);
}

Result<std::vector<Line>, Problem> prepare_others(
    const Params& params, const world::TrackMap& track, const world::RacelineBank* bank,
    const std::optional<envelope::SteeringLimit>& steering) {
  std::vector<Line> lines;
  if (!params.passing) return lines;
  const PassParams& pass = params.passing->pass;
  auto problem = world::first_illegal(kPassRanges, pass, "passing.");
  if (!problem) problem = world::first_illegal(kRivalRanges, pass.rival, "passing.");
  if (problem) return Unexpected{*std::move(problem)};
  if (params.passing->lines.size() >= kRaceLines)
    return refuse("passing.lines", std::to_string(params.passing->lines.size()) +
                                       " lines beside the own one, at most " +
                                       std::to_string(kRaceLines - 1));
  for (const OtherLine& other : params.passing->lines) {
    LineParams line = params.line;
    line.name = other.name;
    line.offset_m = other.offset_m;
    auto built = build_line(track, line, bank, steering);
    if (!built) return refuse("passing.lines: " + built.error().place, built.error().what);
    lines.push_back(*std::move(built));
  }
  return lines;
}

Output step(const Params& params, const Line& own_line, const world::TrackMap& track,
            const State& state, const Inputs& in, Instant now) {
  Output out;
  out.next = state;
  State& next = out.next;
  if (!usable(in.ego)) {
    out.reason = Reason::kNoEgo;
    next.started = false;
    return out;
  }
  const Lines lines{own_line, in.other_lines, in.pit == nullptr ? nullptr : &in.pit->line};
  if (!state.started) next.line = line_at_start(lines, in, next.line);
  CHECK(next.line < lines.size() || (in.pit != nullptr && next.line == lines.size()));
  const std::optional<double> hint = state.started ? std::optional{state.line_s_m} : std::nullopt;
  LinePosition car = lines[next.line].project(in.ego.x_m, in.ego.y_m, hint);
  const double speed_mps = std::max(in.ego.vx_mps, 0.0);
  SpeedDemand demand = demanded_speed({.green_mps = params.green_speed_mps,
                                       .caution_mps = params.caution_speed_mps,
                                       .has_pit = in.pit != nullptr},
                                      in.race_control, in.operator_speed_limit_mps);
  if (in.fuel == rules::FuelState::kHomeNow && params.caution_speed_mps < demand.speed_mps)
    demand = {params.caution_speed_mps, Reason::kFuelHome};
  if (!stops(in.followed)) demand = by_pit(params, lines, in, demand, car, next);
  if (params.passing && in.cars != nullptr && !stops(in.followed))
    demand = race_on(params, lines, track, in, demand, car, next, now);
  const Line& line = lines[next.line];
  Limits limits = limits_of(params, in, demand, speed_mps);

  if (!stops(in.followed)) merge_if_far(params, line, car, speed_mps, next);
  plan_stop_path(params, line, car, neighbours_of(line, car, track, in.cars), speed_mps,
                 in.followed, limits.stop, next);
  if (in.followed != Followed::kEmergency) limits.stop.decel_max_mps2 *= next.stop.decel_share;
  const RoadAhead road = road_ahead(line, next.stop, car.s_m);
  const SpeedsAhead ahead = look_ahead(line, car.s_m, limits.drive, next.merge);
  const SpeedReference now_at = reference(params, ahead, state, road, limits, in, now);
  next.started = true;
  next.at = now;
  next.line_s_m = car.s_m;
  next.speed_mps = now_at.speed_mps;
  next.accel_mps2 = now_at.accel_mps2;

  const SpeedProfile stopping = stop_profile(road, now_at, limits.stop, kBeyondStop_m);
  out.stop = trajectory(
      line, car.s_m,
      [&](double ahead_m) { return offset_at(next.stop, next.stop.gone_m + ahead_m); }, stopping,
      now);
  out.drive = trajectory(
      line, car.s_m, [&](double ahead_m) { return offset_at(line, next.merge, car.s_m + ahead_m); },
      drive_profile(ahead, now_at, limits.drive, params.point_spacing_m), now);
  const bool unlimited = params.speed_law == SpeedLaw::kPaper;
  if (unlimited) demand_everywhere(out.drive, limits.drive.target_mps);
  const LinePoint here = line.at(car.s_m);
  SpeedDemand limited = unlimited ? demand : with_road(here, limits.drive, ahead, demand);
  if (next.line == lines.size() && limited.reason != demand.reason && is_in_lane(*in.pit, car.s_m))
    limited.reason = Reason::kPitLane;
  out.target_speed_mps = limited.speed_mps;
  out.reason = limited.reason;
  out.line_number = line.number;
  out.line_s_m = car.s_m;
  out.track_s_m = track.wrap_station(here.track_s_m);
  out.line_offset_m = car.offset_m;
  out.stop_distance_m = stopping.stop_distance_m;
  return out;
}

}  // namespace pitwall::planning
