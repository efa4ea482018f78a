// Legal ranges of parameters: one table per parameter struct, for the car file, the check at
// start-up and the tests.
//   out    Problem of the first parameter outside its range (NaN is outside), or nullopt
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::world {

// Row of a table: key in the car file, and member of the struct.
template <class Params>
struct NamedRange {
  const char* name;
  double Params::*value;
  double least, most;
};

// The same for a duration; the range is in seconds.
template <class Params>
struct NamedTime {
  const char* name;
  Duration Params::*value;
  double least_s, most_s;
};

// Range of a geometry parameter that several modules share.
struct Range {
  double least, most;
};
inline constexpr Range kSteeringRatio{10.0, 25.0};  // motor angle : road-wheel angle

// A range that depends on other parameters.
struct LegalRange {
  const char* name;
  double value, least, most;
};

inline std::optional<Problem> first_illegal(std::span<const LegalRange> ranges,
                                            std::string_view place = {}) {
  for (const LegalRange& r : ranges) {
    if (r.value >= r.least && r.value <= r.most) continue;
    return Problem{std::string{place} + r.name, "is " + std::to_string(r.value) + ", allowed " +
                                                    std::to_string(r.least) + " to " +
                                                    std::to_string(r.most)};
  }
  return std::nullopt;
}

template <class Params, std::size_t N>
std::optional<Problem> first_illegal(const std::array<NamedRange<Params>, N>& ranges,
                                     const Params& params, std::string_view place = {}) {
  for (const NamedRange<Params>& r : ranges) {
    const std::array one{LegalRange{r.name, params.*r.value, r.least, r.most}};
    if (auto problem = first_illegal(one, place)) return problem;
  }
  return std::nullopt;
}

}  // namespace pitwall::world
