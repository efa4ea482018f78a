// Table of many attempts: what each driver made of each round speed, and the gates.
//   in     runs on committed seeds, runs on the seeds of a commit
//   out    rows of text, the lost attempts of ours, the gates that are missed
//   gates  of ours with n attempts a bracket, for n = 20: 20 and 19 passed at 80 to 125 mph, 19 and
//          18 at 135, 18 and 17 at 150, by seeds; for another n the same number may fail, in
//          proportion rounded down. No contact and no flap anywhere; above 150 mph nothing but that
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tests/system/passing/attempt_run.hpp"

namespace pitwall::testing {

// kCommitted: the same at all times; kOfCommit: new with every change, so that nothing is tuned to
// them.
enum class Seeds : std::uint8_t { kCommitted, kOfCommit };
const char* text_of(Seeds seeds);

struct BracketGate {
  double round_mph = kUnset;
  std::array<std::size_t, 2> may_fail{};  // of kGateAttempts, by Seeds
  bool is_gated = true;
};
inline constexpr std::size_t kGateAttempts = 20;
inline constexpr std::array kBrackets{BracketGate{80.0, {0, 1}},     BracketGate{100.0, {0, 1}},
                                      BracketGate{115.0, {0, 1}},    BracketGate{125.0, {0, 1}},
                                      BracketGate{135.0, {1, 2}},    BracketGate{150.0, {2, 3}},
                                      BracketGate{160.0, {}, false}, BracketGate{170.0, {}, false}};

// The case of attempt i; the seeds of a commit follow from its name.
AttemptCase case_of(Seeds seeds, const std::string& commit, std::size_t i, double round_mph,
                    Driver driver);

struct AttemptCount {
  std::size_t runs = 0;
  std::array<std::size_t, 4> by_verdict{};  // in the order of Verdict
  std::size_t passes = 0, flaps = 0, reversals = 0, refusals = 0;

  std::size_t of(Verdict verdict) const { return by_verdict[static_cast<std::size_t>(verdict)]; }
};
AttemptCount count_of(const std::vector<AttemptRun>& runs, double round_mph, Driver driver);

// The gates of these brackets that the runs miss, one sentence each; empty: all hold.
std::vector<std::string> missed_gates(const std::vector<AttemptRun>& runs, Seeds seeds,
                                      std::span<const BracketGate> brackets = kBrackets);

std::string table_of(const std::vector<AttemptRun>& runs, Seeds seeds);
std::string row_of(const AttemptRun& run);

}  // namespace pitwall::testing
