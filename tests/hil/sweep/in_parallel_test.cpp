// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/in_parallel.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace pitwall::sweep {
namespace {

TEST(InParallel, EveryJobRunsOnce) {
  for (const std::size_t jobs : {0u, 1u, 2u, 1000u})
    for (const unsigned workers : {1u, 2u, 7u}) {
      std::vector<int> ran(jobs, 0);  // each entry belongs to one job
      in_parallel(jobs, workers, [&ran](std::size_t i) { ++ran[i]; });
      EXPECT_EQ(ran, std::vector<int>(jobs, 1)) << workers;
    }
}

}  // namespace
}  // namespace pitwall::sweep
