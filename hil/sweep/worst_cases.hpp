// Cases of a sweep by how badly they went.
//   in     results
//   out    failed_cases(): those that did not pass, worst margin of a failed expectation first; one
//          that was not judged (refused, crashed, a margin that is not finite) before all others.
//          nearest_cases(): at most `most` of those that passed, first the least margin of some
//          expectation, then the next ones: by place, since margins differ in their units
//   law    the order depends on the results alone: of two alike the lower number stands first
//   cost   O(results log results)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "hil/sweep/case_result.hpp"

namespace pitwall::sweep {

std::vector<const CaseResult*> failed_cases(std::span<const CaseResult> results);
std::vector<const CaseResult*> nearest_cases(std::span<const CaseResult> results, std::size_t most);

// Why a case did not pass: its reason, or the expectation with the worst margin.
std::string failure_text(const CaseResult& result);

}  // namespace pitwall::sweep
