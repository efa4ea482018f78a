// SPDX-License-Identifier: Apache-2.0
// The reference unit (tests/benchmarks/cost) beside programs that are measured from outside:
// wakes each 100 ms, takes some, the first of which find the caches of others, and prints what the
// cheapest cost and what one costs on the reference machine, in us. Ends when nobody reads that.
#include <algorithm>
#include <cstdio>

#include "protocol/transport/clock.hpp"
#include "tests/benchmarks/cost/cost_gates.hpp"
#include "tests/benchmarks/cost/reference_cost.hpp"

int main() {
  using namespace pitwall;
  constexpr int kAtOnce = 5;
  cost::ReferenceCost reference;
  transport::Ticker ticker(milliseconds(100));
  for (;;) {
    ticker.next();
    double least_us = reference.take();
    for (int i = 1; i < kAtOnce; ++i) least_us = std::min(least_us, reference.take());
    std::printf("%.3f %.3f\n", least_us, cost::kReferenceUnit_us);
    if (std::fflush(stdout) != 0) return 0;
  }
}
