// SPDX-License-Identifier: Apache-2.0
#include "tests/support/allocation_guard.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <thread>
#include <vector>

namespace pitwall::testing {
namespace {

// Kept where the compiler cannot see that nobody reads it.
void* volatile kept = nullptr;

void* keep(void* block) {
  kept = block;  // so that no allocation is optimised away
  return block;
}

class AllocationCount : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!kAllocationsCounted) GTEST_SKIP() << "the sanitizer has a heap of its own";
  }
};

TEST_F(AllocationCount, EveryWayToTheHeapCounts) {
  EXPECT_EQ(allocations_of([] {}), 0u);
  EXPECT_EQ(allocations_of([] { std::free(keep(std::malloc(10))); }), 1u);
  EXPECT_EQ(allocations_of([] { std::free(keep(std::calloc(3, 10))); }), 1u);
  EXPECT_EQ(allocations_of([] { std::free(keep(std::realloc(nullptr, 10))); }), 1u);
  EXPECT_EQ(allocations_of([] { std::free(keep(std::aligned_alloc(64, 64))); }), 1u);
  EXPECT_EQ(allocations_of([] {
              auto* number = new int(3);
              kept = number;
              delete number;
            }),
            1u);
  EXPECT_EQ(allocations_of([] { kept = std::vector<int>(100).data(); }), 1u);
}

TEST_F(AllocationCount, WhatAnotherThreadTakesIsItsOwn) {
  std::size_t others = 0;
  std::thread other([&] {
    others = allocations_of([] {
      for (int i = 0; i < 1'000; ++i) std::free(keep(std::malloc(8)));
    });
  });
  const std::size_t here = allocations_of([&] { other.join(); });
  EXPECT_EQ(others, 1'000u);
  EXPECT_LT(here, 10u);
}

}  // namespace
}  // namespace pitwall::testing
