// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/bench_clock/bench_clock.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <thread>

#include "protocol/transport/bench_clock/clock_keeper.hpp"
#include "protocol/transport/clock.hpp"
#include "tests/protocol/transport/bench_clock/clock_file.hpp"

namespace pitwall::transport {
namespace {

bool on_wall(Duration span) {
  nap(span);
  return false;
}

TEST(BenchClock, AWaitLastsUntilBenchTimeHasComeThere) {
  const ClockFile file;
  auto memory = ClockMemory::open(file.path);
  ASSERT_TRUE(memory && memory->lock()) << "a bench that lives";
  BenchClock clock{*ClockMemory::open(file.path)};
  const Instant from = clock.now();
  ClockPage& page = memory->page();
  page.horizon_ns = (from + milliseconds(5)).ns;
  const Instant wall = wall_now();
  std::thread bench{[&] {
    nap(microseconds(60'000));
    page.lost_ns += wall_now().ns - page.lost_ns.load() - page.horizon_ns.load();
    page.horizon_ns = (from + milliseconds(100)).ns;
  }};
  clock.wait_until(from + milliseconds(10), on_wall);
  EXPECT_GE(clock.now(), from + milliseconds(10));
  EXPECT_GE(wall_now() - wall, milliseconds(60)) << "it stood for as long";
  bench.join();
}

TEST(BenchClock, SomethingElseThanTimeEndsAWait) {
  const ClockFile file;
  BenchClock clock{*ClockMemory::open(file.path)};
  int naps = 0;
  clock.wait_until(Instant::max(), [&](Duration) { return ++naps == 1; });
  EXPECT_EQ(naps, 1);
  clock.wait_until(Instant{}, [&](Duration span) {
    EXPECT_EQ(span, Duration{}) << "what is past is only looked at";
    return ++naps == 0;
  });
  EXPECT_EQ(naps, 2);
}

TEST(BenchClock, TellsTheKeeperWhetherAThreadWaitsOrWorks) {
  const ClockFile file;
  BenchClock clock{*ClockMemory::open(file.path)};
  const auto memory = ClockMemory::open(file.path);
  ClockSlot& slot = memory->page().slots[0];
  std::thread worker{[&] {
    ASSERT_TRUE(clock.take_turns());
    ASSERT_TRUE(clock.take_turns()) << "asked twice it keeps its place";
    EXPECT_EQ(slot.process.load(), ::getpid());
    EXPECT_EQ(slot.thread.load(), ::gettid());
    EXPECT_EQ(slot.turns.load() % 2, 1U);
    const Instant due = clock.now() + seconds(1'000);
    clock.wait_until(due, [&](Duration) {
      EXPECT_EQ(slot.turns.load() % 2, 0U);
      EXPECT_EQ(slot.due_ns.load(), due.ns);
      return true;
    });
    EXPECT_EQ(slot.turns.load() % 2, 1U);
    EXPECT_EQ(slot.due_ns.load(), ClockSlot::kAtWork);
  }};
  worker.join();
  EXPECT_EQ(slot.process.load(), 0) << "free when its thread has ended";
  EXPECT_EQ(memory->page().slots[1].process.load(), 0);
}

TEST(BenchClock, HasRoomForSoManyAndRefusesTheNext) {
  const ClockFile file;
  BenchClock clock{*ClockMemory::open(file.path)};
  const auto memory = ClockMemory::open(file.path);
  for (ClockSlot& slot : memory->page().slots) slot.process = 1;
  std::thread late{[&] { EXPECT_FALSE(clock.take_turns()); }};
  late.join();
}

std::int64_t sleeps_of_this_thread() {
  rusage used{};
  EXPECT_EQ(::getrusage(RUSAGE_THREAD, &used), 0);
  return used.ru_nvcsw;
}

TEST(BenchClock, AThreadThatTakesTurnsSleepsOnceHoweverLongTimeStands) {
  constexpr int kTurns = 20;
  const ClockFile file;
  auto keeper = ClockKeeper::keep(file.path);
  ASSERT_TRUE(keeper);
  keeper->begin();
  BenchClock clock{*ClockMemory::open(file.path)};
  std::atomic<int> turns = 0;
  std::int64_t sleeps = 0;
  std::thread car{[&] {
    ASSERT_TRUE(clock.take_turns());
    const std::int64_t before = sleeps_of_this_thread();
    Instant due = clock.now();
    for (; turns < kTurns; ++turns) {
      due += milliseconds(5);
      clock.sleep_until(due);
      EXPECT_GE(clock.now(), due);
    }
    sleeps = sleeps_of_this_thread() - before;
  }};
  while (turns < kTurns) {
    nap(milliseconds(10));  // time stands for most of it
    keeper->advance();
  }
  car.join();
  EXPECT_LE(sleeps, 3 * kTurns)
      << "one until the bench wakes it, one to its deadline, one to spare";
}

TEST(BenchClock, ABenchThatDiedLetsAThreadThatTakesTurnsGoOn) {
  const ClockFile file;
  BenchClock clock{*ClockMemory::open(file.path)};
  const auto memory = ClockMemory::open(file.path);
  std::thread car{[&] {
    ASSERT_TRUE(clock.take_turns());
    const Instant from = clock.now();
    memory->page().horizon_ns = from.ns;  // and nobody holds the lock
    clock.sleep_until(from + milliseconds(20));
    EXPECT_GE(clock.now(), from + milliseconds(20));
  }};
  car.join();
}

TEST(BenchClock, ABenchThatDiedLetsTimeGoOn) {
  const ClockFile file;
  BenchClock clock{*ClockMemory::open(file.path)};
  const auto memory = ClockMemory::open(file.path);
  const Instant from = clock.now();
  memory->page().horizon_ns = from.ns;  // and nobody holds the lock
  clock.wait_until(from + milliseconds(20), on_wall);
  EXPECT_GE(clock.now(), from + milliseconds(20));
  EXPECT_EQ(memory->page().horizon_ns.load(), INT64_MAX);
}

}  // namespace
}  // namespace pitwall::transport
