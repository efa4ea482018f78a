// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/planning.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "vehicle/autonomy/planning/speed_profile.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::planning {
namespace {

using world::EgoState;
using world::LegalRange;
using world::TrackFlag;
using world::VehicleFlag;

constexpr double kTickMax_s = 0.2;      // a longer gap between steps moves the reference no further
constexpr double kBeyondStop_m = 40.0;  // path past the standstill: control looks ahead

std::optional<Problem> illegal_line(const LineParams& p) {
  const FrictionParams& f = p.friction;
  return world::first_illegal(
      std::array{LegalRange{"line.offset_m", p.offset_m, -50, 50},
                 LegalRange{"line.wall_clearance_m", p.wall_clearance_m, 0, 10},
                 LegalRange{"line.spacing_m", p.spacing_m, 0.5, 5},
                 LegalRange{"line.speed_max_mps", p.speed_max_mps, 5, 110},
                 LegalRange{"line.grip_share", p.grip_share, 0.1, 1},
                 LegalRange{"line.friction.friction", f.friction, 0.3, 2.5},
                 LegalRange{"line.friction.downforce_per_m", f.downforce_per_m, 0, 0.01},
                 LegalRange{"line.friction.drag_per_m", f.drag_per_m, 0, 0.01},
                 LegalRange{"line.friction.accel_max_mps2", f.accel_max_mps2, 0.5, 15},
                 LegalRange{"line.friction.power_w_per_kg", f.power_w_per_kg, 10, 1000},
                 LegalRange{"line.friction.brake_max_mps2", f.brake_max_mps2, 1, 30}});
}

std::optional<Problem> illegal_speed(const Params& p) {
  return world::first_illegal(
      std::array{LegalRange{"green_speed_mps", p.green_speed_mps, 0, 110},
                 LegalRange{"caution_speed_mps", p.caution_speed_mps, 0, 60},
                 LegalRange{"accel_max_mps2", p.accel_max_mps2, 0.2, 10},
                 LegalRange{"decel_max_mps2", p.decel_max_mps2, 0.2, 10},
                 LegalRange{"jerk_max_mps3", p.jerk_max_mps3, 0.5, 30},
                 LegalRange{"speed_band_mps", p.speed_band_mps, 0.5, 10},
                 LegalRange{"stop_decel_max_mps2", p.stop_decel_max_mps2, 1, 12},
                 LegalRange{"stop_jerk_max_mps3", p.stop_jerk_max_mps3, 1, 30},
                 LegalRange{"stop_grip_share", p.stop_grip_share, 0.3, 0.9},
                 LegalRange{"point_spacing_m", p.point_spacing_m, 1, 4},
                 LegalRange{"merge_from_m", p.merge_from_m, 0.5, 5},
                 LegalRange{"merge_time_s", p.merge_time_s, 1, 10},
                 LegalRange{"merge_least_m", p.merge_least_m, 10, 200}});
}

bool usable(const EgoState& ego) {
  const bool placed =
      ego.validity == world::Validity::kGood || ego.validity == world::Validity::kDeadReckoning;
  return placed && std::isfinite(ego.x_m + ego.y_m + ego.vx_mps);
}

// Lateral offset from the line and its first two derivatives along it.
struct Offset {
  double n_m = 0.0, slope = 0.0, bend_per_m = 0.0;
};

// n0 (1 - 10 u^3 + 15 u^4 - 6 u^5): of all ways back with no slope and no bend at either end the
// one with the least jerk.
Offset merge_offset(const Line& line, const State& state, double s_m) {
  if (!(state.merge_length_m > 0.0)) return {};
  const double l = state.merge_length_m;
  const double u = line.wrap(s_m - state.merge_from_s_m) / l;
  if (u >= 1.0) return {};
  const double u2 = u * u, v = 1.0 - u, n0 = state.merge_offset_m;
  return {n0 * (1.0 - u2 * u * (10.0 - 15.0 * u + 6.0 * u2)), -n0 * 30.0 * u2 * v * v / l,
          -n0 * 60.0 * u * v * (1.0 - 2.0 * u) / (l * l)};
}

void merge_if_far(const Params& params, const Line& line, const LinePosition& car, double speed_mps,
                  State& state) {
  const Offset wanted = merge_offset(line, state, car.s_m);
  if (std::abs(car.offset_m - wanted.n_m) <= params.merge_from_m) return;
  state.merge_from_s_m = car.s_m;
  state.merge_offset_m = car.offset_m;
  state.merge_length_m = std::clamp(speed_mps * params.merge_time_s, params.merge_least_m,
                                    std::max(params.merge_least_m, 0.5 * line.length_m));
}

world::Trajectory trajectory(const Line& line, const State& state, const SpeedProfile& profile,
                             Instant now) {
  world::Trajectory out;
  out.at = now;
  double s_m = 0.0;
  for (std::size_t i = 0; i < profile.at.size(); ++i) {
    const LinePoint p = line.at(state.line_s_m + static_cast<double>(i) * profile.spacing_m);
    const Offset o = merge_offset(line, state, p.s_m);
    const bool aside = o.n_m != 0.0 || o.slope != 0.0;
    const double stretch = 1.0 - p.curvature_per_m * o.n_m;
    const double x_m = aside ? p.x_m - o.n_m * std::sin(p.yaw_rad) : p.x_m;
    const double y_m = aside ? p.y_m + o.n_m * std::cos(p.yaw_rad) : p.y_m;
    if (i > 0) s_m += std::hypot(x_m - out.points.back().x_m, y_m - out.points.back().y_m);
    const bool pushed = out.points.push(
        {.s_m = s_m,
         .x_m = x_m,
         .y_m = y_m,
         .yaw_rad = aside ? wrap_pi(p.yaw_rad + std::atan2(o.slope, stretch)) : p.yaw_rad,
         .curvature_per_m = p.curvature_per_m / stretch + o.bend_per_m,
         .bank_rad = p.bank_rad,
         .speed_mps = profile.at[i].speed_mps,
         .accel_mps2 = profile.at[i].accel_mps2});
    CHECK(pushed);
  }
  return out;
}

// The reference at `now`: moved on by what control followed, kept near the measured speed.
SpeedReference reference(const Params& params, const Line& line, const State& state, double s_m,
                         const DriveLimits& drive, const StopLimits& stop, Followed followed,
                         double speed_mps, Instant now) {
  if (!state.started) return {speed_mps, 0.0};
  const double dt_s = std::clamp((now - state.at).seconds(), 0.0, kTickMax_s);
  const SpeedReference last{state.speed_mps, state.accel_mps2};
  const SpeedReference next = followed == Followed::kStop
                                  ? advance_stop(line, s_m, last, stop, dt_s)
                                  : advance_drive(line, s_m, last, drive, dt_s);
  const double low = std::max(speed_mps - params.speed_band_mps, 0.0);
  return {std::clamp(next.speed_mps, low, speed_mps + params.speed_band_mps), next.accel_mps2};
}

SpeedDemand by_track_flag(const Params& params, const world::RaceControl& rc) {
  switch (rc.track) {
    case TrackFlag::kNone:
      return {0.0, Reason::kNoFlag};
    case TrackFlag::kRed:
      return {0.0, Reason::kRed};
    case TrackFlag::kOrange:
      return {0.0, Reason::kOrange};
    case TrackFlag::kChequered:
      return {0.0, Reason::kChequered};
    case TrackFlag::kUnknown:
      return {0.0, Reason::kUnknownFlag};
    case TrackFlag::kYellow:
      return {params.caution_speed_mps, Reason::kCaution};
    case TrackFlag::kGreen:
    case TrackFlag::kWavingGreen:
      if (rc.round_target_speed_mps > 0.0 && std::isfinite(rc.round_target_speed_mps)) {
        return {rc.round_target_speed_mps, Reason::kRoundSpeed};
      }
      return {params.green_speed_mps, Reason::kGreen};
  }
  return {0.0, Reason::kUnknownFlag};
}

SpeedDemand by_vehicle_flag(const Params& params, VehicleFlag flag) {
  constexpr double kNoLimit_mps = 1e3;
  switch (flag) {
    case VehicleFlag::kNone:
    case VehicleFlag::kBlue:
    case VehicleFlag::kDefender:
    case VehicleFlag::kAttacker:
      return {kNoLimit_mps, Reason::kGreen};
    case VehicleFlag::kYellow:
      return {params.caution_speed_mps, Reason::kCaution};
    case VehicleFlag::kBlackPitIn:
      return {0.0, Reason::kBlack};
    case VehicleFlag::kStop:
    case VehicleFlag::kPurpleEmergency:
    case VehicleFlag::kEngineKill:
      return {0.0, Reason::kStopFlag};
    case VehicleFlag::kOrangeStartEngine:
      return {0.0, Reason::kOrange};
    case VehicleFlag::kChequered:
      return {0.0, Reason::kChequered};
    case VehicleFlag::kUnknown:
      return {0.0, Reason::kUnknownFlag};
  }
  return {0.0, Reason::kUnknownFlag};
}

}  // namespace

Result<Line, Problem> prepare(const Params& params, const world::TrackMap& track) {
  if (auto problem = illegal_line(params.line)) return Unexpected{*problem};
  if (auto problem = illegal_speed(params)) return Unexpected{*problem};
  return build_line(track, params.line);
}

SpeedDemand demanded_speed(const Params& params, const world::RaceControl& race_control,
                           double operator_speed_limit_mps) {
  if (!race_control.ever_heard) return {0.0, Reason::kNoRaceControl};
  SpeedDemand demand = by_track_flag(params, race_control);
  const SpeedDemand vehicle = by_vehicle_flag(params, race_control.vehicle);
  if (vehicle.speed_mps < demand.speed_mps) demand = vehicle;
  if (operator_speed_limit_mps < demand.speed_mps) {
    demand = {std::max(operator_speed_limit_mps, 0.0), Reason::kOperatorLimit};
  }
  return demand;
}

Output step(const Params& params, const Line& line, const world::TrackMap& track,
            const State& state, const EgoState& ego, const world::RaceControl& race_control,
            double operator_speed_limit_mps, Followed followed, Instant now) {
  Output out;
  out.next = state;
  if (!usable(ego)) {
    out.reason = Reason::kNoEgo;
    out.next.started = false;
    return out;
  }
  const std::optional<double> hint = state.started ? std::optional{state.line_s_m} : std::nullopt;
  const LinePosition car = line.project(ego.x_m, ego.y_m, hint);
  const SpeedDemand demand = demanded_speed(params, race_control, operator_speed_limit_mps);
  const DriveLimits drive{demand.speed_mps, params.accel_max_mps2, params.decel_max_mps2,
                          params.jerk_max_mps3};
  const StopLimits stop{params.line.friction, params.stop_grip_share, params.stop_decel_max_mps2,
                        params.stop_jerk_max_mps3};
  const double speed_mps = std::max(ego.vx_mps, 0.0);
  const SpeedReference now_at =
      reference(params, line, state, car.s_m, drive, stop, followed, speed_mps, now);
  State& next = out.next;
  next.started = true;
  next.at = now;
  next.line_s_m = car.s_m;
  next.speed_mps = now_at.speed_mps;
  next.accel_mps2 = now_at.accel_mps2;
  merge_if_far(params, line, car, speed_mps, next);

  const SpeedProfile stopping = stop_profile(line, car.s_m, now_at, stop, kBeyondStop_m);
  out.stop = trajectory(line, next, stopping, now);
  out.drive = trajectory(line, next,
                         drive_profile(line, car.s_m, now_at, drive, params.point_spacing_m), now);
  const LinePoint here = line.at(car.s_m);
  const bool line_limits = here.speed_mps < demand.speed_mps;
  out.target_speed_mps = line_limits ? here.speed_mps : demand.speed_mps;
  out.reason = line_limits ? Reason::kLineLimit : demand.reason;
  out.line_s_m = car.s_m;
  out.track_s_m = track.wrap_station(here.track_s_m);
  out.line_offset_m = car.offset_m;
  out.stop_distance_m = stopping.stop_distance_m;
  return out;
}

}  // namespace pitwall::planning
