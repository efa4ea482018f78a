// SPDX-License-Identifier: Apache-2.0
#include "hil/traffic/ghost.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::traffic {
namespace {

constexpr double kWalkingPace_mps = 10.0;  // below it, change and drift go with the way driven
constexpr double kSteepest = 0.5;          // slope of a change of line
constexpr double kLeastSpin_mps = 1.0;     // a slower car stops without a turn
// Largest values of the derivatives of the minimum-jerk quintic: 15/8 and 10/sqrt(3).
constexpr double kLargestRate = 1.875;
constexpr double kLargestBend = 5.7735026918962573;

double share_of(double u) { return u * u * u * (10.0 - 15.0 * u + 6.0 * u * u); }
double rate_of(double u) { return 30.0 * u * u * (1.0 - u) * (1.0 - u); }

// Progress of what takes its time above `least_mps`, for each metre of the way.
double per_metre(double speed_mps, double least_mps) {
  return 1.0 / std::max(speed_mps, least_mps);
}

// Direction of the path, as parts of a step along and across the road.
struct Course {
  double n_m = 0.0;
  double along = 1.0, across = 0.0;
  double station_per_m = 1.0;
  double road_yaw_rad = 0.0, x_m = 0.0, y_m = 0.0;
};

Course course_of(const Ghost& ghost, const world::TrackMap& track, const GhostState& state) {
  const double s_m = track.wrap_station(state.travelled_m);
  const LineChange& change = state.change;
  const LineOffset to = ghost.lines[change.to].at(s_m);
  LineOffset line = to;
  double moved = 0.0;  // across the road by change and drift, for each metre of the way
  if (change.progress < 1.0) {
    const LineOffset from = ghost.lines[change.from].at(s_m);
    const double left = 1.0 - share_of(change.progress);
    line = {to.n_m + left * (from.n_m - to.n_m), to.slope + left * (from.slope - to.slope)};
    moved = (to.n_m - from.n_m) * rate_of(change.progress) / change.over_s *
            per_metre(state.speed_mps, change.least_mps);
  }
  const Drift drift = drift_at(ghost.params.drift, state.drift);
  moved += drift.rate_mps * per_metre(state.speed_mps, kWalkingPace_mps);
  moved = std::clamp(moved, -kSteepest, kSteepest);
  Course c;
  c.n_m = line.n_m + drift.n_m;
  const world::TrackPoint road = track.offset(s_m, c.n_m);
  const double stretch = 1.0 - road.curvature_per_m * c.n_m;
  // along^2 + across^2 = 1 with across = slope along + moved.
  const double slope = line.slope / stretch, square = 1.0 + slope * slope;
  c.along = (std::sqrt(square - moved * moved) - slope * moved) / square;
  c.across = slope * c.along + moved;
  c.station_per_m = c.along / stretch;
  c.road_yaw_rad = road.yaw_rad, c.x_m = road.x_m, c.y_m = road.y_m;
  return c;
}

double spin_rad(const GhostState& state) {
  if (state.pace != Action::kSpin || state.spin_from_mps < kLeastSpin_mps) return 0.0;
  return state.turn_rad * share_of(1.0 - state.speed_mps / state.spin_from_mps);
}

// The yaw rate is unset: two poses tell it.
plant::CarPose pose_of(const Ghost& ghost, const world::TrackMap& track, const GhostState& state) {
  const Course c = course_of(ghost, track, state);
  const double turned_rad = spin_rad(state);
  return {.x_m = c.x_m,
          .y_m = c.y_m,
          .yaw_rad = wrap_pi(c.road_yaw_rad + std::atan2(c.across, c.along) + turned_rad),
          .vx_mps = state.speed_mps * std::cos(turned_rad),
          .vy_mps = -state.speed_mps * std::sin(turned_rad),
          .s_m = track.wrap_station(state.travelled_m),
          .n_m = c.n_m,
          .length_m = ghost.params.length_m,
          .width_m = ghost.params.width_m};
}

void change_line(const Ghost& ghost, double s_m, std::size_t to, double over_s, GhostState& state) {
  const double way_m =
      std::abs(ghost.lines[to].at(s_m).n_m - ghost.lines[state.change.to].at(s_m).n_m);
  const double limit_mps2 = ghost.params.limits.lateral_mps2;
  LineChange change{.from = state.change.to, .to = to, .progress = 0.0};
  change.over_s = std::max(over_s, std::sqrt(kLargestBend * way_m / limit_mps2));
  change.least_mps = std::max(kWalkingPace_mps, kLargestRate * way_m / (change.over_s * kSteepest));
  state.change = change;
}

bool fires(const ScriptEntry& entry, const world::TrackMap& track, const Surroundings& around,
           GhostState& state) {
  const double gap_m = std::remainder(around.ego_s_m - state.travelled_m, track.length_m());
  switch (entry.trigger) {
    case Trigger::kTime:
      return (state.at - state.began).seconds() >= entry.value;
    case Trigger::kGapAbove:
      return gap_m >= entry.value;
    case Trigger::kGapBelow:
      return gap_m <= entry.value;
    case Trigger::kStation:
      break;
  }
  if (std::isnan(state.armed_m))
    state.armed_m = state.travelled_m + track.station_ahead(state.travelled_m, entry.value);
  return state.travelled_m >= state.armed_m;
}

void apply(const Ghost& ghost, const world::TrackMap& track, const ScriptEntry& entry,
           GhostState& state) {
  if (entry.action == Action::kLine) {
    change_line(ghost, track.wrap_station(state.travelled_m), entry.line, entry.over_s, state);
    state.speed = entry.speed;
    return;
  }
  state.pace = entry.action;
  state.decel_mps2 = entry.decel_mps2;
  state.to_mps = entry.to_mps;
  if (entry.action == Action::kSpeed) state.speed = entry.speed;
  if (entry.action == Action::kSpin) {
    state.spin_from_mps = state.speed_mps;
    state.turn_rad = entry.turn_rad;
  }
}

void follow_script(const Ghost& ghost, const world::TrackMap& track, const Surroundings& around,
                   GhostState& state) {
  const auto& script = ghost.params.script;
  for (; state.next < script.size(); ++state.next, state.armed_m = kUnset) {
    const ScriptEntry& entry = script[state.next];
    if (!fires(entry, track, around, state)) return;
    if (entry.action == Action::kLine && state.change.progress < 1.0) return;
    apply(ghost, track, entry, state);
  }
}

// A change of line is finished before the next one begins.
void follow_order(const Ghost& ghost, const world::TrackMap& track, const GhostOrder& order,
                  GhostState& state) {
  const std::size_t to = order.inside ? ghost.lanes->inside : ghost.lanes->outside;
  if (to == state.change.to || state.change.progress < 1.0) return;
  change_line(ghost, track.wrap_station(state.travelled_m), to, kLaneChange_s, state);
}

// The process of the lane drift, in m/s.
DriftParams wander_of(const SpeedDrift& drift) {
  return {
      .sigma_m = drift.sigma_mps, .correlation_s = drift.correlation_s, .most_m = drift.most_mps};
}

// What the speed is off the wanted one; less below a walking pace, nothing for a car that is to
// stand.
double strays_mps(const Ghost& ghost, const GhostState& state, double wanted_mps) {
  const double share = std::min(wanted_mps / kWalkingPace_mps, 1.0);
  return share * drift_at(wander_of(ghost.params.speed_drift), state.speed_drift).n_m;
}

double next_speed_mps(const Ghost& ghost, const world::TrackMap& track, const GhostState& state,
                      const std::optional<GhostOrder>& order, double dt_s) {
  const double v_mps = state.speed_mps;
  if (!order && state.pace != Action::kSpeed)
    return std::max(std::min(v_mps, state.to_mps), v_mps - state.decel_mps2 * dt_s);
  const double ordered_mps =
      order ? order->speed_mps
            : ghost.speeds[state.speed].at(track.wrap_station(state.travelled_m));
  const double wanted_mps = ordered_mps + strays_mps(ghost, state, ordered_mps) - v_mps;
  const GhostLimits& limits = ghost.params.limits;
  return v_mps + std::clamp(wanted_mps, -limits.brake_mps2 * dt_s, limits.accel_mps2 * dt_s);
}

}  // namespace

GhostState begin(const Ghost& ghost, const world::TrackMap& track, Instant now) {
  const GhostParams& params = ghost.params;
  GhostState state;
  state.began = state.at = now;
  state.travelled_m = params.start_s_m;
  state.speed_mps = params.start_mps;
  state.change.from = state.change.to = params.joins ? 0 : 1;
  constexpr std::uint64_t kDriftStream = 1, kSpeedStream = 2;
  state.drift.noise = sensors::Noise(params.seed, kDriftStream);
  state.speed_drift.noise = sensors::Noise(params.seed, kSpeedStream);
  if (params.joins) change_line(ghost, params.start_s_m, 1, kJoining_s, state);
  state.pose = pose_of(ghost, track, state);
  state.pose.yaw_rate_rad_per_s = 0.0;
  return state;
}

GhostState step(const Ghost& ghost, const world::TrackMap& track, const GhostState& state,
                const Surroundings& around, Instant now) {
  GhostState next = state;
  const double dt_s = (now - state.at).seconds();
  if (!(dt_s > 0.0)) return next;
  const auto order = ghost.lanes ? around.order : std::nullopt;
  if (order)
    follow_order(ghost, track, *order, next);
  else
    follow_script(ghost, track, around, next);
  advance(wander_of(ghost.params.speed_drift), next.speed_drift, dt_s);
  const double speed_mps = next_speed_mps(ghost, track, next, order, dt_s);
  next.speed_mps = 0.5 * (next.speed_mps + speed_mps);
  const double way_m = next.speed_mps * dt_s;
  const Course course = course_of(ghost, track, next);
  LineChange& change = next.change;
  if (change.progress < 1.0)
    change.progress = std::min(
        1.0, change.progress + way_m / change.over_s * per_metre(next.speed_mps, change.least_mps));
  advance(ghost.params.drift, next.drift, way_m * per_metre(next.speed_mps, kWalkingPace_mps));
  next.travelled_m += way_m * course.station_per_m;
  next.speed_mps = speed_mps;
  next.at = now;
  next.pose = pose_of(ghost, track, next);
  next.pose.yaw_rate_rad_per_s = wrap_pi(next.pose.yaw_rad - state.pose.yaw_rad) / dt_s;
  return next;
}

}  // namespace pitwall::traffic
