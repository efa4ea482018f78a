// Margins of each expectation over all cases of a sweep.
//   in     results
//   out    of each expectation, in the order of their texts: the finite margins, ascending; how
//          many cases failed it, and how many have no finite margin because it never came to be
//          judged
//   units  of a margin: those of its signal
//   cost   O(margins log margins)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "hil/sweep/case_result.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::sweep {

struct MarginSpread {
  std::string text{};            // of the expectation
  std::vector<double> all{};     // that are finite, ascending
  std::vector<double> failed{};  // those of them that failed, ascending
  std::size_t failures = 0;      // with those that are not finite
  std::size_t not_finite = 0;
  std::size_t least_in = 0;  // number of the case with the least margin

  // NaN where no margin is finite.
  double least() const { return at(0); }
  double one_in_twenty() const { return at(all.size() / 20); }
  double median() const { return at(all.size() / 2); }

 private:
  double at(std::size_t place) const { return all.empty() ? kUnset : all[place]; }
};

std::vector<MarginSpread> margin_spreads(std::span<const CaseResult> results);

}  // namespace pitwall::sweep
