// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/long_gates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace pitwall::radio {
namespace {

// Too short for the tails of the ages to mean anything; every run is there and says its line.
TEST(LongGates, SayALineForEachRun) {
  std::vector<std::string> lines;
  const bool all = run_long_gates([&](const std::string& line) { lines.push_back(line); }, 0.01);
  const auto broken = std::count_if(lines.begin(), lines.end(), [](const std::string& line) {
    return line.starts_with("BROKEN");
  });
  EXPECT_EQ(lines.size(), 28U * 2 + 2 + 12);
  EXPECT_EQ(all, broken == 0);
  for (std::size_t i = 0; i < 58; ++i) EXPECT_TRUE(lines[i].starts_with("holds")) << lines[i];
}

}  // namespace
}  // namespace pitwall::radio
