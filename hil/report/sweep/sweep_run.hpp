// What the page of a sweep shows.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "hil/sweep/baseline.hpp"
#include "hil/sweep/case_result.hpp"
#include "hil/sweep/cases.hpp"

namespace pitwall::report {

using CaseResults = std::span<const sweep::CaseResult>;  // in the order of their numbers

// An earlier sweep of the same plan.
struct Baseline {
  CaseResults results;
  sweep::Difference difference;  // to it
};

struct SweepRun {
  const sweep::Cases& cases;
  CaseResults results;
  std::string command;                         // that makes the same sweep again
  std::map<std::size_t, std::string> pages{};  // of a case: address beside the page of the sweep
  std::optional<Baseline> baseline{};
};

}  // namespace pitwall::report
