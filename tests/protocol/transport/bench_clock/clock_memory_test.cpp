// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/bench_clock/clock_memory.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/clock.hpp"
#include "tests/protocol/transport/bench_clock/clock_file.hpp"

namespace pitwall::transport {
namespace {

TEST(ClockMemory, AllWhoOpenAFileSeeOnePage) {
  const ClockFile file;
  const auto one = ClockMemory::open(file.path), other = ClockMemory::open(file.path);
  ASSERT_TRUE(one && other);
  EXPECT_EQ(one->page().horizon_ns.load(), INT64_MAX) << "free before a bench comes";
  one->page().lost_ns = 17;
  EXPECT_EQ(other->page().lost_ns.load(), 17);
}

TEST(ClockMemory, RefusesWhatIsNoFileOfBenchTime) {
  const ClockFile file;
  EXPECT_FALSE(ClockMemory::open(file.folder.path() + "/none/clock"));
  EXPECT_FALSE(ClockMemory::open(file.folder.path())) << "a folder";
  EXPECT_FALSE(ClockMemory::open("/dev/null"));
  ASSERT_TRUE(write_file(file.path, "a text"));
  EXPECT_FALSE(ClockMemory::open(file.path)) << "another length";
  ASSERT_TRUE(write_file(file.path, std::string(sizeof(ClockPage), 'x')));
  const auto refused = ClockMemory::open(file.path);
  ASSERT_FALSE(refused) << "another beginning";
  EXPECT_EQ(refused.error().place, file.path);
}

TEST(ClockMemory, ALockEndsWithItsProcess) {
  const ClockFile file;
  auto memory = ClockMemory::open(file.path);
  ASSERT_TRUE(memory);
  EXPECT_FALSE(memory->is_locked());
  {
    Other bench{[&] {
      auto own = ClockMemory::open(file.path);
      own->lock();
      own->page().lost_ns = 1;
      ::pause();
    }};
    while (memory->page().lost_ns.load() == 0) nap(microseconds(100));
    EXPECT_TRUE(memory->is_locked());
    EXPECT_FALSE(memory->lock());
    memory->page().horizon_ns = 500;
    memory->resume(Instant{2'000});
    EXPECT_EQ(memory->page().horizon_ns.load(), 500) << "its bench lives";
  }
  EXPECT_FALSE(memory->is_locked());
  memory->resume(Instant{2'000});
  EXPECT_EQ(memory->page().horizon_ns.load(), INT64_MAX);
  EXPECT_EQ(memory->page().lost_ns.load(), 1'500) << "from where it stood";
  EXPECT_TRUE(memory->lock());
}

}  // namespace
}  // namespace pitwall::transport
