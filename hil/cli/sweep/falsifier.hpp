// Search for values at which the scenario of a plan misses an expectation.
//   in     plan and scenario; parameters with a range are searched, of those with values the first
//          one stands; the scenario's own seed, unless the plan has another
//   out    the first case, in the order of the search, that failed or ended in a contact; what
//          every batch came to is printed
//   law    what is found does not depend on the number of threads
//   errors none: values that the bench does not take are passed over
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "hil/cli/sweep/sweep_case.hpp"

namespace pitwall::cli {

struct FalsifyOptions {
  std::size_t runs = 200;  // at most
  unsigned threads = 1;
  bench::StepFunction step = pipeline::step;  // the car; a test may put another there
};

bool is_searched(const sweep::Parameter& parameter);

std::optional<sweep::Case> falsify(const SweepInputs& inputs, const FalsifyOptions& options);

}  // namespace pitwall::cli
