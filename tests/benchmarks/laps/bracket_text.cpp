// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/laps/bracket_text.hpp"

#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::laps {

std::string bracket_name(const grading::Bracket& bracket) {
  return bracket.to_mps > 1e6 ? formatted(">%.0f", bracket.from_mps)
                              : formatted("%.0f-%.0f", bracket.from_mps, bracket.to_mps);
}

std::string brackets_json(const grading::CrossTrack& cross_track) {
  json::Array brackets;
  for (std::size_t i = 0; i < grading::kBrackets.size(); ++i) {
    const grading::ErrorStatistics& s = cross_track.by_bracket[i];
    brackets.json(json::Object{}
                      .number("from_mps", grading::kBrackets[i].from_mps)
                      .number("samples", s.samples)
                      .number("mean_m", s.mean_m())
                      .number("max_m", s.max_m)
                      .str());
  }
  return brackets.str();
}

}  // namespace pitwall::laps
