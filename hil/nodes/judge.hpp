// Judge of a match of two cars, and what it has race control show each of them.
//   in     JudgeParams, the true state of both cars at every tick, a contact of the two
//   out    flags and round speed for each car; a record of every attempt
//   stages kWaiting  until the match begins, race control plays its script
//          kForming  the attacker falls back under yellow of its own until it is behind
//          kAttempt  green and roles; waving green once the attacker has trailed a defender that
//                    keeps to its rule for a while
//          kOver     chequered; black for a car that caused a contact
//   invariants
//          the rules are those of protocol/rules; the judge only says what it sees
//          the same cars in the other order give the same records with the cars exchanged
//   units  stations and gaps along the track's reference line [m]; a lane is the half of the track
//   errors a car without a known place, or that stands, stops the attempt
//   cost   O(1), no allocation; the state is a plain value
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "hil/nodes/flag_encoding.hpp"
#include "hil/nodes/race_control.hpp"
#include "protocol/rules/match.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::race {

struct JudgeParams {
  rules::PassingRules rules;
  double track_length_m = kUnset;
  Instant begins{};
  std::uint8_t first_attacker = 0;
  double start_gap_m = 15.0;        // least gap behind the defender when green is shown
  double trail_m = 60.0;            // largest gap of an attacker that trails
  double trails_mps = 3.0;          // fastest that it still closes up, or falls back
  Duration trails = seconds(3);     // so long before waving green
  Duration forming = seconds(180);  // an attacker that is not behind by then stops the attempt
  double stands_mps = 2.0;          // a car that is no faster for so long stops it, too
  Duration stands = seconds(5);
};

struct JudgedCar {
  double station_m = kUnset, speed_mps = kUnset;
  double length_m = kUnset;
  bool inside = false;    // in the inside lane
  bool declines = false;  // the attempt that it has to make
};

struct JudgedContact {
  std::array<bool, rules::kCars> caused{};  // by each car
};

struct JudgeView {
  std::array<JudgedCar, rules::kCars> cars{};
  std::optional<JudgedContact> contact{};
};

struct AttemptRecord {
  rules::Assignment assignment;
  Instant formed{}, green{}, waving{}, clear{}, ended{};  // zero: not reached
  double laps_used = 0.0;  // of the attacker from waving green to the gap of 30 m, or to the end
  double most_lead_m = kUnset;                                     // of the attacker's centre
  double defender_least_mps = kUnset, defender_most_mps = kUnset;  // under waving green
  rules::Ending ending = rules::Ending::kStopped;
  rules::Score score = rules::Score::kFailed;
};

// What race control shows a car.
struct Shown {
  Flags flags;
  double round_speed_mph = 0.0;

  bool operator==(const Shown&) const = default;
};

enum class Stage : std::uint8_t { kWaiting, kForming, kAttempt, kOver };

struct JudgeState {
  Stage stage = Stage::kWaiting;
  rules::Match match;
  rules::AttemptState attempt;
  AttemptRecord current;  // of the attempt that is due
  FixedVector<AttemptRecord, rules::kAttemptsMax> attempts;
  std::array<double, rules::kCars> travelled_m{}, station_m{kUnset, kUnset};
  double lead_m = kUnset;  // of the attacker, not wrapped, in an attempt
  std::optional<Instant> trails_since;
  std::array<std::optional<Instant>, rules::kCars> stands_since{};
  std::array<bool, rules::kCars> is_black{};
};

JudgeState begin_judging(const JudgeParams& params);

// Call at every tick.
JudgeState step(const JudgeParams& params, const JudgeState& state, const JudgeView& view,
                Instant now);

// None before the match begins.
std::optional<Shown> shown_to(const JudgeState& state, std::uint8_t car);

// What changes for a car from one state to the next.
std::optional<Call> call_between(const JudgeState& before, const JudgeState& after,
                                 std::uint8_t car, Instant now);

}  // namespace pitwall::race
