// Independent jobs on several cores. Each job is a function of its number alone, so the results do
// not depend on who runs it or on the order in which they end.
//   in     how many jobs, how many workers, what job i does; it must not throw
//   out    back when every job has run exactly once
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace pitwall::sweep {

void in_parallel(std::size_t jobs, unsigned workers, const std::function<void(std::size_t)>& job);

}  // namespace pitwall::sweep
