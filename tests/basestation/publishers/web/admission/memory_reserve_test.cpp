// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/admission/memory_reserve.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <memory>
#include <new>
#include <vector>

#include "basestation/publishers/web/admission/room_left.hpp"

namespace pitwall::publishers::web {
namespace {

// Their own allocators end the program where the system gives nothing.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kHasItsOwnAllocator = true;
#else
constexpr bool kHasItsOwnAllocator = false;
#endif

// As many bytes more as this process may take from now on, until it goes out of scope.
class Room {
 public:
  explicit Room(std::size_t bytes) {
    if (::getrlimit(RLIMIT_DATA, &before_) != 0) return;
    rlimit limit = before_;
    limit.rlim_cur = rlim_t{1} << 40;
    if (::setrlimit(RLIMIT_DATA, &limit) != 0) return;
    for (const MemoryUse& use : memory_use())
      if (use.bound == "RLIMIT_DATA") limit.rlim_cur = use.used + bytes;
    is_set_ = ::setrlimit(RLIMIT_DATA, &limit) == 0;
  }
  ~Room() { ::setrlimit(RLIMIT_DATA, &before_); }
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;
  bool is_set() const { return is_set_; }

 private:
  rlimit before_{};
  bool is_set_ = false;
};

// Above what malloc takes from memory that it has already.
constexpr std::size_t kBlock = 500'000;

std::size_t blocks_until_none_is_left(std::size_t most) {
  std::vector<std::unique_ptr<char[]>> blocks;
  blocks.reserve(most);
  try {
    while (blocks.size() < most) blocks.emplace_back(new char[kBlock]);
  } catch (const std::bad_alloc&) {
  }
  return blocks.size();
}

TEST(MemoryReserve, IsGivenUpBeforeAnAllocationFailsAndCanBeTakenAgain) {
  if (kHasItsOwnAllocator) GTEST_SKIP() << "a sanitizer's allocator does not call the handler";
  ASSERT_TRUE(hold_reserve());
  EXPECT_TRUE(hold_reserve()) << "held already";
  std::size_t taken = 0;
  bool was_held = true;
  {
    const Room room{kBlock / 2};
    ASSERT_TRUE(room.is_set());
    EXPECT_TRUE(reserve_is_held());
    taken = blocks_until_none_is_left(100);
    was_held = reserve_is_held();
  }
  EXPECT_FALSE(was_held);
  EXPECT_GE(taken, kReserve / kBlock - 1) << "the reserve served them";
  EXPECT_LT(taken, 100U) << "nothing is left after it";
  EXPECT_TRUE(hold_reserve());
  EXPECT_TRUE(reserve_is_held());
}

TEST(MemoryReserve, IsRefusedWhereThereIsNotSoMuch) {
  if (kHasItsOwnAllocator) GTEST_SKIP() << "a sanitizer's allocator does not call the handler";
  ASSERT_TRUE(hold_reserve());
  const Room room{0};
  ASSERT_TRUE(room.is_set());
  blocks_until_none_is_left(100);
  ASSERT_FALSE(reserve_is_held());
  {
    const Room none{0};
    EXPECT_FALSE(hold_reserve());
  }
}

}  // namespace
}  // namespace pitwall::publishers::web
