// Match of two cars: which car attacks, at which round speed, and who has won.
//   in     the match before, the ending of the attempt that it assigned
//   out    the next assignment, or the result
//   rounds in each round both cars attack once at the same speed; roles swap after every attempt
//          that counts. Both pass: the next round, at a higher speed; one passes: it wins; none,
//          or both in the last round: a draw. A contact ends the match: who caused it alone
//          loses, else it is a draw
//   repeats
//          an attempt that was stopped, or that the defender spoiled, is repeated with the same
//          roles. After the last repeat it counts: as passed if the defender spoiled it, else as
//          failed
//   invariants
//          a match ends after at most kAttemptsMax attempts, whatever their endings. Cars
//          exchanged, the result is exchanged
//   source as passing_rules.hpp; the rule for a contact and for repeats is ours
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocol/rules/attempt.hpp"
#include "protocol/rules/passing_rules.hpp"

namespace pitwall::rules {

inline constexpr std::uint8_t kRepeatsMax = 3;
inline constexpr std::size_t kAttemptsMax = kRoundsMax * kCars * (1 + kRepeatsMax);

enum class Result : std::uint8_t { kOpen, kWon, kDraw };

struct Match {
  std::uint8_t attacker = 0;  // car of the attempt that is due: 0 or 1
  std::uint8_t round = 0;     // of the rules' round speeds
  bool second = false;        // the second attempt of the round is due
  bool first_passed = false;  // the first one was a pass
  std::uint8_t repeats = 0;   // of the attempt that is due
  Result result = Result::kOpen;
  std::uint8_t winner = 0;  // kWon

  bool operator==(const Match&) const = default;
};

// The car that attacks first.
Match begin_match(std::uint8_t first_attacker);

struct Assignment {
  std::uint8_t attacker = 0, defender = 1;  // cars
  double round_speed_mph = kUnset;
  std::uint8_t round = 0, repeats = 0;

  bool operator==(const Assignment&) const = default;
};

// None after the end.
std::optional<Assignment> due(const PassingRules& rules, const Match& match);

// How an ending counts, after so many repeats.
enum class Score : std::uint8_t { kPassed, kFailed, kRepeated, kMatchOver };
Score score_of(const PassingRules& rules, Ending ending, std::uint8_t repeats);

// Of a match that is open.
Match record(const PassingRules& rules, const Match& match, Ending ending);

const char* name_of(Score score);

}  // namespace pitwall::rules
