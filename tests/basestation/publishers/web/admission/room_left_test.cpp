// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/admission/room_left.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <vector>

namespace pitwall::publishers::web {
namespace {

TEST(RoomLeft, TheBoundThatIsNearIsNamed) {
  const std::vector<MemoryUse> uses{{"RLIMIT_DATA", 50'000'000, 100'000'000},
                                    {"memory.max", 95'000'000, 100'000'000}};
  EXPECT_EQ(short_of_memory(uses, kMemoryToAccept), "memory: 95 of 100 MB used (memory.max)");
  EXPECT_EQ(short_of_memory(uses, kMemoryToKeep), "");
  EXPECT_EQ(short_of_memory({}, kMemoryToAccept), "");
}

TEST(RoomLeft, ALimitThatIsSetLaterIsSeen) {
  const auto data_of = [] {
    for (const MemoryUse& use : memory_use())
      if (use.bound == "RLIMIT_DATA") return use;
    return MemoryUse{};
  };
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_DATA, &before), 0);
  rlimit lower = before;
  lower.rlim_cur = rlim_t{4} << 30;
  ASSERT_EQ(::setrlimit(RLIMIT_DATA, &lower), 0);
  const MemoryUse small = data_of();
  EXPECT_EQ(small.allowed, lower.rlim_cur);
  constexpr std::size_t kMore = 64'000'000;
  const std::vector<char> more(kMore, 'x');
  EXPECT_GE(data_of().used, small.used + kMore - 1'000'000) << more.back();
  ASSERT_EQ(::setrlimit(RLIMIT_DATA, &before), 0);
}

TEST(RoomLeft, TheLastDescriptorsAreKept) {
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
  const int last = static_cast<int>(limit.rlim_cur) - kKeptDescriptors;
  EXPECT_EQ(short_of_descriptors(last - 1), "");
  EXPECT_NE(short_of_descriptors(last).find(std::to_string(limit.rlim_cur)), std::string::npos);
}

}  // namespace
}  // namespace pitwall::publishers::web
