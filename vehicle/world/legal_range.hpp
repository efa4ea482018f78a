// A parameter with its legal range: how the check at start-up of every module reads.
//   out    the first parameter that is outside (NaN is outside), or nothing
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::world {

struct LegalRange {
  const char* name;
  double value, least, most;
};

inline std::optional<Problem> first_illegal(std::span<const LegalRange> ranges) {
  for (const LegalRange& r : ranges) {
    if (r.value >= r.least && r.value <= r.most) continue;
    return Problem{r.name, "is " + std::to_string(r.value) + ", must be within " +
                               std::to_string(r.least) + " and " + std::to_string(r.most)};
  }
  return std::nullopt;
}

}  // namespace pitwall::world
