// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/in_parallel.hpp"

#include <atomic>
#include <thread>
#include <vector>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::sweep {

void in_parallel(std::size_t jobs, unsigned workers, const std::function<void(std::size_t)>& job) {
  CHECK(workers > 0);
  std::atomic<std::size_t> next = 0;
  std::vector<std::jthread> at_work;
  for (unsigned k = 0; k < workers; ++k)
    at_work.emplace_back([&] {
      for (std::size_t i = next++; i < jobs; i = next++) job(i);
    });
}

}  // namespace pitwall::sweep
