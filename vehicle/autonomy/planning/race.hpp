// What the other cars mean for ours: the line to drive and the speed on it, by the pass (pass.hpp)
// and by every car in the way.
//   in     the lines, our place, the tracked cars, the demand of flags and operator
//   out    RaceDecision; the state of the pass
//   frames as planning.hpp
//   invariants
//          without tracked cars it is the own line at the demanded speed
//          no speed above what the operator allows; none above the demand but for an attacker
//          on a green track
//          a car that is in the way of our path is followed or met standing, whatever the phase is
//          an attempt is declined as long as it has not been given waving green, by fuel; later
//          it is finished, unless there is fuel for the way home only. What was declined stays so
//          another car goes on along the line that it is nearest to, at its distance from it
//   cost   some 0.3 ms where a pass is looked for, otherwise 10 us; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "vehicle/autonomy/planning/governor.hpp"
#include "vehicle/autonomy/planning/line.hpp"
#include "vehicle/autonomy/planning/offset.hpp"
#include "vehicle/autonomy/planning/pass.hpp"
#include "vehicle/world/opponent.hpp"
#include "vehicle/world/race_control.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::planning {

// The own line and those that a pass may use; the own one has number 0 here, and the pit's, where
// there is one, the number after all others.
inline constexpr std::size_t kRaceLines = 4;
struct Lines {
  const Line& own;
  std::span<const Line> others = {};
  const Line* pit = nullptr;

  std::size_t size() const { return 1 + others.size(); }  // to race on
  const Line& operator[](std::size_t i) const {
    if (i == size()) return *pit;
    return i == 0 ? own : others[i - 1];
  }
};

struct RaceInputs {
  const Lines& lines;
  const world::TrackMap& track;
  const world::Opponents& cars;
  const world::RaceControl& race_control;
  rules::FuelState fuel = rules::FuelState::kUnknown;
  std::size_t line = 0;  // in use
  LinePosition car;      // of our car on it
  OffsetChange merge;    // on it
  OwnPlace own;
  double base_mps = kUnset;     // demanded by flags and operator
  double most_mps = kUnset;     // by the operator; unset: no limit
  double gentle_mps2 = kUnset;  // with which a car in the way is met behind flags
  const DriveLimits& limits;
};

enum class RaceReason : std::uint8_t { kNone, kTrail, kPass, kYield, kCarAhead, kDeclined };

struct RaceDecision {
  double speed_mps = kUnset;
  RaceReason reason = RaceReason::kNone;  // where the speed is not the demand
};

RaceDecision race(const PassParams& params, PassState& state, const RaceInputs& in, Instant now);

// The path that is driven goes on, beside another line, and merges with it.
OffsetChange change_line(const Line& from, const OffsetChange& merge, double s_m, const Line& to,
                         double length_m);

// Length of such a merge that is in no hurry: longer than length_m where the corners on its way
// would not carry a shorter one at this speed.
double unhurried_m(const Line& from, const OffsetChange& merge, double s_m, const Line& to,
                   double length_m, double speed_mps, const DriveLimits& limits);

}  // namespace pitwall::planning
