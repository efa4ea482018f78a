// Report of a comparison of players: table, gates, JSON.
//   in     MatchFigures
//   out    text for people, one JSON object for programs, whether every gate held
//   invariants
//          a ratio that cannot be formed (a player without timing, a zero) is a missed gate
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tests/benchmarks/replay/player_match.hpp"

namespace pitwall::benchmarks {

struct MatchGate {
  std::string text;
  double value = 0.0, least = 0.0;  // ratios; NaN if it cannot be formed

  bool held() const { return value >= least; }
};

struct MatchReport {
  std::uint64_t frames = 0;
  double length_s = 0.0;
  std::string host_load;  // load averages of the host at the start
  MatchFigures figures;
};

// The first ones are about content and order, the others about time.
std::vector<MatchGate> gates_of(const MatchFigures& figures);
std::string to_text(const MatchReport& report);
std::string to_json(const MatchReport& report);

}  // namespace pitwall::benchmarks
