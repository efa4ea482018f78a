// Attempts of the passing competition: their number, how much of its two laps the present one has
// used, and whether the pass is complete.
//   in     race control's flags, lap number and station of the car, the gap to the opponent, each
//          with the time at which it was measured
//   out    Attempt: number, laps driven in it, state
//   invariants
//          an attempt begins when a car with a role receives WAVING GREEN, and ends when another
//          flag or another role has held for kEndsAfter. An unknown flag ends nothing; a flag that
//          is shown for a shorter time is ignored as flicker
//          it is used up when its laps are driven. An attacker that began behind and is kPassGap_m
//          ahead has passed, and stays so until the next attempt
//          the distance between two samples less than kByStation apart follows from the station
//          alone, because the lap number may change a sample before or after the station does; over
//          a longer gap the lap number counts the laps without samples
//   units  m; flags as telemetry::kTrackFlags and kVehicleFlags
//   errors a value that is not a number changes nothing. A lap number that falls is a new count;
//          the laps driven so far stay
//   source Saba et al.: two laps for each attempt, a pass counts at 30 m
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::state {

inline constexpr double kPassGap_m = 30.0;
// In the order of kAttemptStates of station_field.hpp.
enum class AttemptState : std::uint8_t { kNone, kRunning, kUsedUp, kPassed, kEnded };

enum class Role : std::uint8_t { kNone, kDefender, kAttacker };
// Role from race control's vehicle flag; nullopt for an unknown flag or NaN.
std::optional<Role> role_of_flag(double vehicle_flag);

struct RaceSample {
  double track_flag = kUnset, vehicle_flag = kUnset;
  double lap = kUnset, station_m = kUnset;
  double course_m = kUnset;  // length of a lap; unset: only whole laps are counted
  double gap_ahead_m = kUnset, gap_behind_m = kUnset;
};

struct Attempt {
  double number = kUnset;  // from 1; unset: no attempt yet
  double laps = kUnset;    // driven in it
  AttemptState state = AttemptState::kNone;
};

class AttemptTracker {
 public:
  static constexpr Duration kEndsAfter = seconds(1), kByStation = seconds(2);
  static constexpr double kNear_m = 200.0;  // the opponent of a pass is nearer than this

  void receive(const RaceSample& sample, double attempt_laps, Instant at);
  Attempt attempt() const;

 private:
  void begin(Role role);
  void follow_laps(const RaceSample& sample, Instant at);
  double driven_laps(const RaceSample& sample, Instant at) const;
  bool passes(const RaceSample& sample);

  std::uint64_t number_ = 0;
  AttemptState state_ = AttemptState::kNone;
  Role role_ = Role::kNone;
  double laps_ = 0.0;
  bool was_behind_ = false;
  double lap_ = kUnset, station_m_ = kUnset;  // of the newest sample that had both or one
  Instant placed_{};
  std::optional<Instant> other_since_;  // since when a flag or role contradicts the attempt
};

}  // namespace pitwall::state
