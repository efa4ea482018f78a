// Execution of independent jobs on several cores. A job depends on its number only, so the results
// do not depend on the worker or on the order in which the jobs end.
//   in     number of jobs, number of workers, a function that runs job i and does not throw
//   out    returns when every job has run exactly once
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace pitwall::sweep {

void in_parallel(std::size_t jobs, unsigned workers, const std::function<void(std::size_t)>& job);

}  // namespace pitwall::sweep
