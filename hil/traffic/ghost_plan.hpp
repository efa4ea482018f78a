// Plan of a ghost, a car without a stack, as a scenario file states it: names are not resolved yet.
//   units  in the names; offset positive to the left
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hil/plant/params.hpp"
#include "hil/traffic/lane_drift.hpp"
#include "hil/traffic/speed_table.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::traffic {

inline constexpr std::size_t kScriptMost = 16;  // entries

struct LinePlan {
  std::string name{};  // of the bank; empty: the track's reference line
  double offset_m = 0.0;
};

// One of the three.
struct SpeedPlan {
  double mps = kUnset;
  double lap_share = kUnset;  // of the line's own lap
  std::vector<SpeedKnot> by_station{};
};

struct GhostLimits {
  double accel_mps2 = 4.0, brake_mps2 = 8.0;
  double lateral_mps2 = 4.0;  // of a change of line, and of the drift
};

// Slow wander of the speed about the one that is wanted, as lane_drift.hpp has it of the offset.
struct SpeedDrift {
  double sigma_mps = 0.0;  // 0: none
  double correlation_s = 10.0;
  double most_mps = 0.0;
};

// What an entry of the script waits for. The gap is the station of our car less that of the ghost,
// of their centres: positive where our car is ahead.
enum class Trigger : std::uint8_t { kTime, kStation, kGapAbove, kGapBelow };
enum class Action : std::uint8_t { kSpeed, kLine, kBrake, kStand, kSpin };

struct ScriptPlan {
  Trigger trigger = Trigger::kTime;
  double value = kUnset;  // seconds since the start; station or gap in metres
  Action action = Action::kSpeed;
  SpeedPlan speed{};           // kSpeed
  LinePlan line{};             // kLine
  double over_s = kUnset;      // kLine
  double decel_mps2 = kUnset;  // kBrake, kSpin
  double to_mps = 0.0;         // kBrake
  double turn_rad = kUnset;    // kSpin, positive to the left
  std::string place{};         // for messages
};

// The two lanes that a ghost changes between when it is told to; offsets from the reference line.
struct LanePlan {
  double inside_m = kUnset, outside_m = kUnset;
};

struct GhostPlan {
  double start_s_m = 0.0, start_mps = 0.0;
  std::optional<double> start_n_m;  // empty: on its line
  LinePlan line;
  SpeedPlan speed;
  GhostLimits limits;
  DriftParams drift;
  SpeedDrift speed_drift;
  std::vector<ScriptPlan> script;
  std::optional<LanePlan> lanes;  // of a ghost that takes orders
  double length_m = plant::Chassis{}.length_m, width_m = plant::Chassis{}.width_m;
  std::uint64_t seed = 0;
  std::string place{};  // for messages
};

}  // namespace pitwall::traffic
