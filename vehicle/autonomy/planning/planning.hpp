// The planner: holds the line at the speed that race control and the operator allow, and keeps a
// stop trajectory ready at every tick.
//   in     EgoState (Map), RaceControl, operator's limit, the coldest tyre; which trajectory
//          control has followed since the last step
//   out    drive and stop trajectory (Map), both from the car's present place and from the same
//          reference speed; the stop begins where the car is, in the direction and with the
//          curvature of the drive trajectory, so that a change to it never steps
//   rate   20 Hz (any rate up to 100 Hz works: the reference speed advances with time)
//   invariants
//          speed follows a reference that starts at the present speed, moves with limited jerk and
//          acceleration, and stays within speed_band_mps of the measured speed. The stop uses
//          stop_grip_share of the friction ellipse, by the temperature of the tyres, along the path
//          of stop_plan.hpp; its path is kept from the moment on at which it is followed, and an
//          emergency stop is the same path with more brake. While the car coasts the drive
//          trajectory slows as a car does whose throttle is closed. A car far off the line is led
//          back by a minimum-jerk offset over merge_time_s
//   errors without a usable ego both trajectories are empty and the reason says so
//   cost   O(points + horizon steps), below 1 ms; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/planning/line.hpp"
#include "vehicle/autonomy/planning/offset.hpp"
#include "vehicle/autonomy/planning/stop_plan.hpp"
#include "vehicle/steering/angle_limits.hpp"
#include "vehicle/world/ego_state.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/race_control.hpp"
#include "vehicle/world/track_map.hpp"
#include "vehicle/world/trajectory.hpp"

namespace pitwall::planning {

struct Params {
  LineParams line;
  double green_speed_mps = kUnset;    // when race control gives no round speed
  double caution_speed_mps = kUnset;  // under yellow
  double accel_max_mps2 = kUnset;
  double decel_max_mps2 = kUnset;  // of the drive trajectory
  double jerk_max_mps3 = kUnset;
  double speed_band_mps = kUnset;  // reference to measured speed
  double stop_decel_max_mps2 = kUnset;
  double stop_jerk_max_mps3 = kUnset;
  double stop_grip_share = kUnset;  // 0.7 is a margin of 30 %
  double stop_friction = kUnset;    // that a stop reckons with, tyres warm: low on purpose
  StopPathParams stop_path;
  double emergency_decel_max_mps2 = kUnset;  // stop_decel_max_mps2..15
  double emergency_jerk_max_mps3 = kUnset;   // stop_jerk_max_mps3..30
  double emergency_grip_share = kUnset;      // stop_grip_share..0.95
  double point_spacing_m = kUnset;           // of the drive trajectory
  double steer_share = kUnset;               // of the gate's angles, that a corner may need
  double merge_from_m = kUnset;              // deviation from the line that starts a merge
  double merge_time_s = kUnset;
  double merge_least_m = kUnset;  // shortest merge
};

inline constexpr auto kRanges = std::to_array<world::NamedRange<Params>>({
    {"green_speed_mps", &Params::green_speed_mps, 0.0, 110.0},
    {"caution_speed_mps", &Params::caution_speed_mps, 0.0, 60.0},
    {"accel_max_mps2", &Params::accel_max_mps2, 0.2, 10.0},
    {"decel_max_mps2", &Params::decel_max_mps2, 0.2, 10.0},
    {"jerk_max_mps3", &Params::jerk_max_mps3, 0.5, 30.0},
    {"speed_band_mps", &Params::speed_band_mps, 0.5, 10.0},
    {"stop_decel_max_mps2", &Params::stop_decel_max_mps2, 1.0, 12.0},
    {"stop_jerk_max_mps3", &Params::stop_jerk_max_mps3, 1.0, 30.0},
    {"stop_grip_share", &Params::stop_grip_share, 0.3, 0.9},
    {"point_spacing_m", &Params::point_spacing_m, 1.0, 4.0},
    {"steer_share", &Params::steer_share, 0.5, 1.0},
    {"merge_from_m", &Params::merge_from_m, 0.5, 5.0},
    {"merge_time_s", &Params::merge_time_s, 1.0, 10.0},
    {"merge_least_m", &Params::merge_least_m, 10.0, 200.0},
});

// Why the target speed is what it is.
enum class Reason : std::uint8_t {
  kUnknown,
  kNoEgo,
  kNoRaceControl,
  kNoFlag,
  kUnknownFlag,
  kRed,
  kOrange,
  kBlack,
  kStopFlag,
  kChequered,
  kCaution,
  kGreen,
  kRoundSpeed,
  kOperatorLimit,
  kLineLimit
};

enum class Followed : std::uint8_t {
  kNothing,
  kDrive,
  kCoast,  // the drive trajectory, without driving it on
  kStop,
  kEmergency  // the stop trajectory, as short as the grip allows
};

struct Inputs {
  const world::EgoState& ego;
  const world::RaceControl& race_control;
  double operator_speed_limit_mps = kUnset;  // unset: none
  Followed followed = Followed::kNothing;
  double tyre_c = kUnset;                           // the coldest; unset counts as cold
  const steering::AngleBudget* steering = nullptr;  // none: no limit
};

struct State {
  bool started = false;
  Instant at{};
  double line_s_m = kUnset;                     // the car on the line
  double speed_mps = kUnset, accel_mps2 = 0.0;  // the reference
  OffsetChange merge;                           // back to the line
  StopPath stop;                                // of the last stop trajectory
};

struct Output {
  world::Trajectory drive, stop;
  double target_speed_mps = kUnset;
  Reason reason = Reason::kUnknown;
  double line_s_m = kUnset, track_s_m = kUnset;  // where the car is
  double line_offset_m = kUnset;                 // signed distance to the line, positive left
  double stop_distance_m = kUnset;
  State next;
};

// Start-up: every parameter against its legal range; the place is the parameter's name.
Result<Line, Problem> prepare(const Params& params, const world::TrackMap& track);

Output step(const Params& params, const Line& line, const world::TrackMap& track,
            const State& state, const Inputs& inputs, Instant now);

struct SpeedDemand {
  double speed_mps = kUnset;
  Reason reason = Reason::kUnknown;
};

// The flag table alone; exposed for tests and displays.
SpeedDemand demanded_speed(const Params& params, const world::RaceControl& race_control,
                           double operator_speed_limit_mps);

}  // namespace pitwall::planning
