// Ghost: a car without a stack that follows lines of the track by a script.
//   in     the ghost with its lines and speeds, the track, the station of our car, the time
//   out    its true pose; the next state
//   method path speed v with dv/dt within the limits; it drives along its line without slip, so the
//          body points along the path. The offset is the line's, plus what is left of the line
//          before in a minimum-jerk change of line, plus the drift. Change and drift run with the
//          time above a walking pace and stop with the car, so that a standing car does not move
//   spin   the car slides along its line to a stop and turns, by a minimum-jerk turn over the speed
//          that it loses: without a jump of the yaw rate when it begins or when the car stands
//   script the entries fire one after another: each waits for its own condition and for those
//          before it, and a change of line also for the end of the one before
//   invariants
//          position is C1 in time and yaw continuous; dv/dt is within [-brake, accel]. The offset
//          accelerates against the line by at most lateral_mps2 for a change of line between
//          parallel lines, which takes longer than stated where it must
//          between two lines at all times, but for the drift
//          the same seed and the same inputs give the same bits
//   errors none: build_ghost() refuses what cannot be driven; NaN for our car never fires a gap
//   cost   O(log points), no allocation; states are trivially copyable
//   source minimum-jerk quintic: Flash and Hogan, J. Neuroscience 5 (1985), eq. 12
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "hil/plant/car_pose.hpp"
#include "hil/traffic/ghost_plan.hpp"
#include "hil/traffic/lane_drift.hpp"
#include "hil/traffic/offset_line.hpp"
#include "hil/traffic/speed_table.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::traffic {

// Entry of a script with lines and speeds by their index.
struct ScriptEntry {
  Trigger trigger = Trigger::kTime;
  double value = kUnset;
  Action action = Action::kSpeed;
  std::size_t line = 0;   // kLine
  std::size_t speed = 0;  // kSpeed and kLine: from then on
  double over_s = kUnset;
  double decel_mps2 = kUnset, to_mps = 0.0, turn_rad = 0.0;
};

struct GhostParams {
  double start_s_m = 0.0, start_mps = 0.0;
  bool joins = false;  // begins beside its line, with a change of line
  GhostLimits limits;
  DriftParams drift;
  SpeedDrift speed_drift;
  FixedVector<ScriptEntry, kScriptMost> script;
  double length_m = kUnset, width_m = kUnset;
  std::uint64_t seed = 0;
};

// Lines of the two lanes that it may be ordered to.
struct Lanes {
  std::size_t inside = 0, outside = 0;
};

// Line 0 goes through the start, line 1 and speed 0 are the first that it follows.
struct Ghost {
  GhostParams params;
  std::optional<Lanes> lanes;
  std::vector<OffsetLine> lines;
  std::vector<SpeedTable> speeds;
};

inline constexpr double kJoining_s = 4.0;     // time of the change from the start to the first line
inline constexpr double kLaneChange_s = 3.0;  // of an ordered one

struct LineChange {
  std::size_t from = 0, to = 0;
  double progress = 1.0;  // [0, 1]
  double over_s = kUnset;
  double least_mps = kUnset;  // below this speed it slows down with the car
};

struct GhostState {
  Instant began{}, at{};
  double travelled_m = 0.0;  // station, not wrapped
  double speed_mps = 0.0;
  LineChange change;
  DriftState drift, speed_drift;
  std::size_t speed = 0;
  Action pace = Action::kSpeed;  // what decides about the speed: any but kLine
  double decel_mps2 = 0.0, to_mps = 0.0;
  double spin_from_mps = 0.0, turn_rad = 0.0;
  std::size_t next = 0;     // entry of the script
  double armed_m = kUnset;  // kStation: travelled_m where it fires; unset: not yet armed
  plant::CarPose pose;
};

// Lane and speed, in place of those of the script.
struct GhostOrder {
  bool inside = false;
  double speed_mps = 0.0;
};

struct Surroundings {
  double ego_s_m = kUnset;
  std::optional<GhostOrder> order{};  // ignored by a ghost without lanes
};

GhostState begin(const Ghost& ghost, const world::TrackMap& track, Instant now);
GhostState step(const Ghost& ghost, const world::TrackMap& track, const GhostState& state,
                const Surroundings& around, Instant now);

}  // namespace pitwall::traffic
