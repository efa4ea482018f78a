// SPDX-License-Identifier: Apache-2.0
#include "hil/faults/bench_fault.hpp"

#include <gtest/gtest.h>

#include <set>

#include "hil/faults/frame_fault.hpp"

namespace pitwall::faults {
namespace {

TEST(BenchFault, EveryKindHasOneRowAndAUniqueNameThatReadsBack) {
  std::set<std::string_view> names;
  for (std::size_t k = 0; k < kBenchFaultKinds; ++k) {
    const auto kind = static_cast<BenchFaultKind>(k);
    EXPECT_EQ(row_of(kind).kind, kind);
    EXPECT_EQ(bench_fault_kind(row_of(kind).name), kind);
    EXPECT_FALSE(frame_fault_kind(row_of(kind).name).has_value()) << "ambiguous in a scenario";
    names.insert(row_of(kind).name);
  }
  EXPECT_EQ(names.size(), kBenchFaultKinds);
  EXPECT_EQ(static_cast<std::size_t>(BenchFaultKind::kFlagsLate) + 1, kBenchFaultKinds);
  EXPECT_FALSE(bench_fault_kind("").has_value());
}

TEST(BenchFault, IsActiveFromItsStartToItsEnd) {
  BenchFault fault{.start = Instant{} + seconds(2), .duration = seconds(3)};
  const auto at = [&](std::int64_t ms) { return active(fault, Instant{} + milliseconds(ms)); };
  EXPECT_FALSE(at(1999));
  EXPECT_TRUE(at(2000));
  EXPECT_TRUE(at(4999));
  EXPECT_FALSE(at(5000));
  fault.duration.reset();
  EXPECT_TRUE(at(1'000'000));
}

}  // namespace
}  // namespace pitwall::faults
