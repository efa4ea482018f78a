// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/motion.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace pitwall::tracking {
namespace {

constexpr double kStepMax_s = 0.1;
constexpr double kRadiusLeftMin = 0.2;  // of 1 - kappa n, which is positive between the walls

// F P: rows of the positions are full, the others add one state to another.
RoadMatrix times_covariance(const MotionStep& step, std::size_t mode, const Advance& a,
                            const RoadMatrix& p) {
  const auto& [accel, turn] = step.mode[mode];
  RoadMatrix fp;
  for (std::size_t i = 0; i < 2; ++i) {
    const RoadVector& f = a.jacobian[i];
    for (std::size_t j = 0; j < kRoadStates; ++j)
      fp[i][j] = f[0] * p[0][j] + f[1] * p[1][j] + f[2] * p[2][j] + f[3] * p[3][j] +
                 f[4] * p[4][j] + f[5] * p[5][j];
  }
  for (std::size_t j = 0; j < kRoadStates; ++j) {
    fp[kHeading][j] = step.heading_kept * p[kHeading][j] + turn.gain_s * p[kTurn][j];
    fp[kSpeed][j] = p[kSpeed][j] + accel.gain_s * p[kAccel][j];
    fp[kAccel][j] = accel.kept * p[kAccel][j];
    fp[kTurn][j] = turn.kept * p[kTurn][j];
  }
  return fp;
}

void add_noise(const Fading& f, std::size_t integral, std::size_t value, RoadMatrix& p) {
  p[value][value] += f.value_variance;
  p[integral][integral] += f.integral_variance;
  p[integral][value] += f.covariance;
  p[value][integral] += f.covariance;
}

// F P F', whose upper half says all.
void move_covariance(const MotionStep& step, const Advance& a, std::size_t mode, RoadMatrix& p) {
  const auto& [accel, turn] = step.mode[mode];
  const RoadMatrix fp = times_covariance(step, mode, a, p);
  for (std::size_t i = 0; i < kRoadStates; ++i) {
    const RoadVector& row = fp[i];
    for (std::size_t j = i; j < 2; ++j) {
      const RoadVector& f = a.jacobian[j];
      p[i][j] = row[0] * f[0] + row[1] * f[1] + row[2] * f[2] + row[3] * f[3] + row[4] * f[4] +
                row[5] * f[5];
    }
    if (i <= kHeading)
      p[i][kHeading] = step.heading_kept * row[kHeading] + turn.gain_s * row[kTurn];
    if (i <= kSpeed) p[i][kSpeed] = row[kSpeed] + accel.gain_s * row[kAccel];
    if (i <= kAccel) p[i][kAccel] = accel.kept * row[kAccel];
    p[i][kTurn] = turn.kept * row[kTurn];
  }
  for (std::size_t i = 0; i < kRoadStates; ++i)
    for (std::size_t j = 0; j < i; ++j) p[i][j] = p[j][i];
  add_noise(accel, kSpeed, kAccel, p);
  add_noise(turn, kHeading, kTurn, p);
  p[kAlong][kAlong] += step.wander_variance;
  p[kAcross][kAcross] += step.wander_variance;
  p[kHeading][kHeading] += step.heading_variance;
}

std::size_t nearest_point(const world::TrackMap& map, double s_m) {
  const auto count = static_cast<double>(map.size());
  const double place = std::round(map.wrap_station(s_m) / map.length_m() * count);
  return place < count ? static_cast<std::size_t>(place) : 0;
}

struct Bend {
  double road_per_m = 0.0;
  double middle_per_m = 0.0, middle_slope = 0.0;
};

// Derivatives of the middle between the walls against the reference line, over the lap. A
// reference line may swing from wall to wall, as a racing line does; other cars keep to the road.
Bend bend_of(const world::TrackMap& map, std::size_t point) {
  constexpr double kSpan_m = 90.0;  // to both sides: what is shorter is the survey of the walls
  const std::size_t count = map.size();
  const double spacing_m = map.length_m() / static_cast<double>(count);
  const auto span = std::min(static_cast<std::size_t>(kSpan_m / spacing_m + 0.5), count);
  const auto middle_m = [&](std::size_t i) {
    const world::TrackPoint& p = map.point(i < count ? i : i - count);
    return 0.5 * (p.width_left_m - p.width_right_m);
  };
  const double span_m = static_cast<double>(span) * spacing_m;
  const double before_m = middle_m(point + count - span), after_m = middle_m(point + span);
  return {map.point(point).curvature_per_m,
          (after_m - 2.0 * middle_m(point) + before_m) / (span_m * span_m),
          0.5 * (after_m - before_m) / span_m};
}

Bend bend_at(const world::TrackMap* map, double s_m) {
  if (map == nullptr) return {};
  return bend_of(*map, nearest_point(*map, s_m));
}

StateVector states_of(const Track& track, std::size_t mode) {
  StateVector x = track.x;
  for (std::size_t i = 0; i < kRoadStates; ++i) x[i] += track.modes.apart[mode][i];
  return x;
}

// What a mode is apart from x is small: it needs no wrap.
void take_step(const MotionStep& step, const world::TrackMap* map, Track& track) {
  const double half_way_m = track.x[kAlong] + 0.5 * step.dt_s * track.x[kSpeed];
  const Bend bend = bend_at(map, half_way_m);
  Modes& m = track.modes;
  mix_modes(step.change, m);
  std::array<Advance, kModes> to;
  for (std::size_t mode = 0; mode < kModes; ++mode) {
    to[mode] = advanced(step, mode, bend.road_per_m, states_of(track, mode));
    move_covariance(step, to[mode], mode, m.p[mode]);
  }
  for (std::size_t k = 0; k < kModes; ++k)
    for (std::size_t i = 0; i < kRoadStates; ++i) m.apart[k][i] = to[k].x[i] - track.x[i];
  centre_modes(track);
  track.x[kHeading] =
      full_turn(track.x[kHeading] + step.dt_s * track.x[kSpeed] * bend.middle_per_m +
                (1.0 - step.heading_kept) * bend.middle_slope);
  if (map != nullptr) track.x[kAlong] = map->wrap_station(track.x[kAlong]);
}

void coast_all(const RoadParams& params, const world::TrackMap* map, Duration time,
               std::span<Track> tracks) {
  if (time <= Duration{} || tracks.empty()) return;
  const double steps = std::ceil(time.seconds() / kStepMax_s);
  const MotionStep step = motion_step(params, map != nullptr, time.seconds() / steps);
  for (double k = 0.0; k < steps; k += 1.0)
    for (Track& track : tracks) take_step(step, map, track);
}

struct Direction {
  double cos, sin;
};

// Of a small angle, as a car's to the road is, by the series: off by less than 1e-13, and faster.
Direction direction_of(double angle_rad) {
  constexpr double kSmall_rad = 0.2;
  if (!(std::abs(angle_rad) < kSmall_rad)) return {std::cos(angle_rad), std::sin(angle_rad)};
  const double q = angle_rad * angle_rad;
  constexpr double k2 = 1.0 / 2, k3 = k2 / 3, k4 = k3 / 4, k5 = k4 / 5, k6 = k5 / 6, k7 = k6 / 7,
                   k8 = k7 / 8, k9 = k8 / 9;
  return {1.0 - q * (k2 - q * (k4 - q * (k6 - q * k8))),
          angle_rad * (1.0 - q * (k3 - q * (k5 - q * (k7 - q * k9))))};
}

Fading with_sigma(Fading unit, double sigma) {
  const double variance = sigma * sigma;
  unit.value_variance *= variance, unit.integral_variance *= variance, unit.covariance *= variance;
  return unit;
}

}  // namespace

Fading fading(double sigma, double time_s, double dt_s) {
  const double r = dt_s / time_s;
  const double half_lost = -std::expm1(-0.5 * r);     // after half of the step
  const double lost = half_lost * (2.0 - half_lost);  // 1 - kept
  const double kept = 1.0 - lost;
  const double variance = sigma * sigma;
  // 2 r - 3 + 4 e^-r - e^-2r, from its series (2/3 r^3 first) where the terms would cancel.
  constexpr double kSeries = 0.02;
  const double shape = r < kSeries
                           ? r * r * r * (2.0 / 3.0 - r * (0.5 - r * (7.0 / 30.0 - r / 12.0)))
                           : 2.0 * r - 2.0 * lost - lost * lost;
  return {.kept = kept,
          .gain_s = time_s * lost,
          .half_s = time_s * half_lost,
          .value_variance = variance * lost * (1.0 + kept),
          .integral_variance = variance * time_s * time_s * shape,
          .covariance = variance * time_s * lost * lost};
}

MotionStep motion_step(const RoadParams& p, bool with_map, double dt_s) {
  const Fading steady = fading(p.steady_accel_sigma_mps2, p.steady_accel_time_s, dt_s);
  const Fading changing = fading(p.accel_sigma_mps2, p.accel_time_s, dt_s);
  const Fading turn = fading(1.0, with_map ? p.turn_time_s : p.plane_turn_time_s, dt_s);
  const auto turning = [&](double with_map_sigma) {
    return with_sigma(turn, with_map ? with_map_sigma : p.plane_turn_sigma_rad_per_s);
  };
  MotionStep step;
  step.dt_s = dt_s;
  step.change = mode_change(p, dt_s);
  step.mode[kSteady] = {steady, turning(p.steady_turn_sigma_rad_per_s)};
  step.mode[kSpeedChange] = {changing, turning(p.speed_change_turn_sigma_rad_per_s)};
  step.mode[kLaneChange] = {changing, turning(p.turn_sigma_rad_per_s)};
  step.wander_variance = p.wander_m_per_sqrt_s * p.wander_m_per_sqrt_s * dt_s;
  step.heading_variance = p.heading_wander_rad_per_sqrt_s * p.heading_wander_rad_per_sqrt_s * dt_s;
  if (with_map) step.heading_kept = std::exp(-dt_s / p.heading_time_s);
  return step;
}

double curvature_at(const world::TrackMap* map, double s_m) { return bend_at(map, s_m).road_per_m; }

double road_turn_of(double curvature_per_m, const StateVector& x) {
  const double left = std::max(1.0 - curvature_per_m * x[kAcross], kRadiusLeftMin);
  return curvature_per_m * x[kSpeed] * std::cos(x[kHeading]) / left;
}

Advance advanced(const MotionStep& step, std::size_t mode, double curvature_per_m,
                 const StateVector& x) {
  const auto& [accel, turn] = step.mode[mode];
  const double heading_rad = x[kHeading] + turn.half_s * x[kTurn];
  const double speed_mps = x[kSpeed] + accel.half_s * x[kAccel];
  const double left = std::max(1.0 - curvature_per_m * x[kAcross], kRadiusLeftMin);
  const Direction direction = direction_of(heading_rad);
  const double along = step.dt_s * direction.cos / left;
  const double across = step.dt_s * direction.sin;
  Advance a;
  a.x = x;
  a.x[kAlong] += speed_mps * along;
  a.x[kAcross] += speed_mps * across;
  a.x[kHeading] = step.heading_kept * x[kHeading] + turn.gain_s * x[kTurn];
  a.x[kSpeed] += accel.gain_s * x[kAccel];
  a.x[kAccel] *= accel.kept;
  a.x[kTurn] *= turn.kept;
  const double along_by_heading = -speed_mps * across / left;
  const double across_by_heading = speed_mps * along * left;
  a.jacobian[0] = {1.0,
                   speed_mps * along * curvature_per_m / left,
                   along_by_heading,
                   along,
                   along * accel.half_s,
                   along_by_heading * turn.half_s};
  a.jacobian[1] = {
      0.0, 1.0, across_by_heading, across, across * accel.half_s, across_by_heading * turn.half_s};
  return a;
}

void coast(const RoadParams& params, const world::TrackMap* map, Duration time, Tracks& tracks) {
  coast_all(params, map, time, std::span<Track>{tracks.list.begin(), tracks.list.size()});
}

void coast(const RoadParams& params, const world::TrackMap* map, Duration time, Track& track) {
  coast_all(params, map, time, std::span<Track>{&track, 1});
  join_modes(track);
}

}  // namespace pitwall::tracking
