// Planner: follows the line at the speed that race control and the operator allow, and provides a
// stop trajectory in every tick.
//   in     EgoState (Map), RaceControl, speed limit of the operator, the coldest tyre; the
//          trajectory that was followed since the last step
//   out    drive and stop trajectory (Map), both from the present position and the same reference
//          speed; the stop begins at the car, with the direction and the curvature of the drive
//          trajectory, so that switching to it causes no step
//   rate   20 Hz (any rate up to 100 Hz works: the reference speed advances with time)
//   invariants
//          the speed follows a reference that starts at the present speed, moves as governor.hpp
//          lets it, and stays within speed_band_mps of the measured speed
//          the stop uses stop_grip_share of the friction ellipse, by the temperature of the tyres,
//          along the path of stop_plan.hpp. Its path is fixed once it is followed; an emergency
//          stop is the same path with more brake
//          while the car coasts the drive trajectory slows like a car with closed throttle
//          a car far off the line returns by a minimum-jerk offset over merge_time_s
//          with fuel for the way home only the car drives at the speed of a caution; fuel that
//          nobody has entered limits nothing
//          other cars are regarded where params.passing is set (race.hpp); a stop keeps its line
//          a car that shall come in does so by the pit line and stops at its box; one that starts
//          in the pit lane, or shall race again, drives out by it
//   errors without a usable ego state both trajectories are empty, with the reason kNoEgo
//   cost   O(points + horizon steps), below 1 ms; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/rules/fuel.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/planning/flag_speed.hpp"
#include "vehicle/autonomy/planning/governor.hpp"
#include "vehicle/autonomy/planning/line.hpp"
#include "vehicle/autonomy/planning/offset.hpp"
#include "vehicle/autonomy/planning/pass.hpp"
#include "vehicle/autonomy/planning/pit_line.hpp"
#include "vehicle/autonomy/planning/stop_plan.hpp"
#include "vehicle/steering/angle_limits.hpp"
#include "vehicle/world/ego_state.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/opponent.hpp"
#include "vehicle/world/race_control.hpp"
#include "vehicle/world/track_map.hpp"
#include "vehicle/world/trajectory.hpp"

namespace pitwall::planning {

// kPaper: the published baseline, for comparison. The demanded speed is the target of every point
// of the drive trajectory, whatever the line, the tyres and the steering carry.
enum class SpeedLaw : std::uint8_t { kLimited, kPaper };

// A line beside the own one: of the same bank by its name, or at an offset from the reference line.
struct OtherLine {
  std::string name = {};
  double offset_m = 0.0;
};

struct Passing {
  PassParams pass;
  std::vector<OtherLine> lines;
};

struct Params {
  LineParams line;
  SpeedLaw speed_law = SpeedLaw::kLimited;
  double green_speed_mps = kUnset;    // if race control gives no round speed
  double caution_speed_mps = kUnset;  // under yellow
  Pace comfort;                       // of the drive trajectory
  // On a green track, towards its speed, and always for a corner ahead; at least as that.
  Pace racing;
  double speed_band_mps = kUnset;  // largest distance of the reference from the measured speed
  double stop_decel_max_mps2 = kUnset;
  double stop_jerk_max_mps3 = kUnset;
  double stop_grip_share = kUnset;  // 0.7 is a margin of 30 %
  double stop_friction = kUnset;    // assumed in a stop with warm tyres; low on purpose
  StopPathParams stop_path;
  double emergency_decel_max_mps2 = kUnset;  // stop_decel_max_mps2..15
  double emergency_jerk_max_mps3 = kUnset;   // stop_jerk_max_mps3..30
  double emergency_grip_share = kUnset;      // stop_grip_share..0.95
  double point_spacing_m = kUnset;           // of the drive trajectory
  double steer_share = kUnset;               // usable share of the gate's angle limit in a corner
  double merge_from_m = kUnset;              // deviation from the line that starts a merge
  double merge_time_s = kUnset;
  double merge_least_m = kUnset;        // shortest merge
  std::optional<Passing> passing = {};  // none: other cars change nothing
};

inline constexpr auto kRanges = std::to_array<world::NamedRange<Params>>({
    {"green_speed_mps", &Params::green_speed_mps, 0.0, 110.0},
    {"caution_speed_mps", &Params::caution_speed_mps, 0.0, 60.0},
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

inline constexpr auto kPaceRanges = std::to_array<world::NamedRange<Pace>>({
    {"accel_max_mps2", &Pace::accel_max_mps2, 0.2, 10.0},
    {"decel_max_mps2", &Pace::decel_max_mps2, 0.2, 10.0},
    {"jerk_max_mps3", &Pace::jerk_max_mps3, 0.5, 30.0},
});

enum class Followed : std::uint8_t {
  kNothing,
  kDrive,
  kCoast,  // the drive trajectory with closed throttle
  kStop,
  kEmergency  // the stop trajectory, as short as the grip allows
};

struct Inputs {
  const world::EgoState& ego;
  const world::RaceControl& race_control;
  double operator_speed_limit_mps = kUnset;  // unset: no limit
  Followed followed = Followed::kNothing;
  rules::FuelState fuel = rules::FuelState::kUnknown;
  double tyre_c = kUnset;                           // coldest tyre; unset counts as cold
  const steering::AngleBudget* steering = nullptr;  // null: no limit
  std::span<const Line> other_lines = {};           // as prepare_others() made them
  const PitLine* pit = nullptr;                     // null: the car stops where it should come in
  const world::Opponents* cars = nullptr;           // tracked; null: none
};

struct State {
  bool started = false;
  Instant at{};
  std::size_t line = 0;                         // in use: 0 the own one, the others, the pit's
  double line_s_m = kUnset;                     // station of the car on it
  double speed_mps = kUnset, accel_mps2 = 0.0;  // reference speed
  OffsetChange merge;                           // return to the line
  StopPath stop;                                // of the last stop trajectory
  PassState pass;
};

struct Output {
  world::Trajectory drive, stop;
  double target_speed_mps = kUnset;
  Reason reason = Reason::kUnknown;
  std::size_t line_number = 0;                   // of the line in use, in its bank
  double line_s_m = kUnset, track_s_m = kUnset;  // stations of the car
  double line_offset_m = kUnset;                 // signed distance to the line, positive left
  double stop_distance_m = kUnset;
  State next;
};

// At start-up: checks every parameter against its legal range; the place of a Problem is the name
// of the parameter.
Result<Line, Problem> prepare(const Params& params, const world::TrackMap& track,
                              const world::RacelineBank* bank = nullptr,
                              const std::optional<envelope::SteeringLimit>& steering = {});

// The lines of params.passing; empty without it.
Result<std::vector<Line>, Problem> prepare_others(
    const Params& params, const world::TrackMap& track, const world::RacelineBank* bank = nullptr,
    const std::optional<envelope::SteeringLimit>& steering = {});

Output step(const Params& params, const Line& line, const world::TrackMap& track,
            const State& state, const Inputs& inputs, Instant now);

}  // namespace pitwall::planning
