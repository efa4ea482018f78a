// Difference of a sweep to an earlier one of the same plan and scenario: what another build of the
// car made of the same cases.
//   in     results of both, by number
//   out    cases that passed before and do not now, those that do now and did not, and of each
//          expectation the case whose margin fell most; cases whose event log is the same
//   units  of a margin: those of its signal
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "hil/sweep/case_result.hpp"

namespace pitwall::sweep {

struct MarginFall {
  std::size_t number = 0;
  double before = kUnset, now = kUnset;
};

struct Difference {
  std::size_t compared = 0, unchanged = 0;  // unchanged: the same event log
  std::vector<std::size_t> worse, better;   // numbers of cases whose verdict changed
  std::map<std::string, MarginFall> falls;  // by expectation; those that fell nowhere are left out
};

Difference difference(std::span<const CaseResult> before, std::span<const CaseResult> now);

std::string to_text(const Difference& difference);

}  // namespace pitwall::sweep
