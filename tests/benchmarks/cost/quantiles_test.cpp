// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/cost/quantiles.hpp"

#include <gtest/gtest.h>

namespace pitwall::benchmarks {
namespace {

TEST(Quantiles, AreThoseOfTheSortedList) {
  std::vector<double> list;
  for (int i = 100; i >= 0; --i) list.push_back(i);
  const Quantiles q = quantiles_of(list);
  EXPECT_EQ(q.p50_us, 50.0);
  EXPECT_EQ(q.p99_us, 99.0);
  EXPECT_EQ(q.worst_us, 100.0);
  EXPECT_EQ(q.count, 101u);
  EXPECT_EQ(quantiles_of({}).count, 0u);
}

}  // namespace
}  // namespace pitwall::benchmarks
