// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/bench_clock/bench_pause.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "protocol/transport/bench_clock/bench_clock.hpp"
#include "protocol/transport/bench_clock/clock_keeper.hpp"
#include "protocol/transport/bench_clock/wall_clock.hpp"

namespace pitwall::transport {
namespace {

constexpr Duration ms(std::int64_t n) { return milliseconds(n); }

TEST(BenchPause, GrowsByTheWallClockAndIsOverWhenTimeGoesOn) {
  ClockPage page;
  Instant wall{ms(1'000).ns};
  const auto pause = [&] { return pause_of(page, [&] { return wall; }); };
  EXPECT_EQ(pause(), BenchPause{}) << "no bench: the wall clock";
  page.horizon_ns.store(ms(1'010).ns);
  wall += ms(10);
  EXPECT_EQ(pause(), BenchPause{}) << "just there";
  wall += ms(20);
  EXPECT_EQ(pause(), (BenchPause{.now = ms(20), .total = ms(20)}));
  page.lost_ns.store(ms(20).ns);
  page.horizon_ns.store(ms(1'012).ns);
  EXPECT_EQ(pause(), (BenchPause{.now = {}, .total = ms(20)}));
  wall += ms(5);
  EXPECT_EQ(pause(), (BenchPause{.now = ms(3), .total = ms(23)}));
}

TEST(BenchPause, IsToldFromWhatPeopleNotice) {
  EXPECT_FALSE((BenchPause{.now = ms(149), .total = seconds(9)}.is_long()));
  EXPECT_TRUE((BenchPause{.now = ms(150), .total = ms(150)}.is_long()));
}

// A file of bench time with its bench, and a program that goes by it.
class PausesOfAProgram : public ::testing::Test {
 protected:
  static std::string file() {
    return ::testing::TempDir() + "/pitwall-pause-" + std::to_string(::getpid());
  }
  void TearDown() override { std::filesystem::remove(file()); }

  static void wait(Duration span) {
    for (const Instant end = wall_now() + span; wall_now() < end;) continue;
  }
};

TEST_F(PausesOfAProgram, AreCountedFromItsOwnBeginning) {
  auto keeper = ClockKeeper::keep(file());
  ASSERT_TRUE(keeper);
  keeper->begin();
  wait(ms(50));
  ASSERT_TRUE(keeper->advance());
  auto memory = ClockMemory::open(file());
  ASSERT_TRUE(memory);
  const BenchClock clock{*std::move(memory)};
  EXPECT_LT(clock.pause().total, ms(40)) << "of before";
  wait(ms(60));
  const BenchPause pause = clock.pause();
  EXPECT_GE(pause.now, ms(50));
  EXPECT_GE(pause.total, pause.now);
  ASSERT_TRUE(keeper->advance());
  EXPECT_LT(clock.pause().now, ms(40));
  EXPECT_GE(clock.pause().total, pause.total);
}

// A host that follows a guest is leapt forward to it: it was behind, and stood for no time.
TEST_F(PausesOfAProgram, TheTotalIsACounterAndDoesNotShrinkAtALeap) {
  auto keeper = ClockKeeper::keep(file());
  ASSERT_TRUE(keeper);
  auto memory = ClockMemory::open(file());
  ASSERT_TRUE(memory);
  const BenchClock clock{*std::move(memory)};
  keeper->begin();
  wait(ms(60));
  const Duration stood = clock.pause().total;
  keeper->leap(keeper->now() + ms(40));
  EXPECT_LT(pause_of(ClockMemory::open(file())->page(), wall_now).total, stood);
  EXPECT_GE(clock.pause().total, stood);
}

// Who is woken again and again must find out, too, that nobody keeps time any more.
TEST_F(PausesOfAProgram, EndWithTheirBenchHoweverOftenTheWaitIsBroken) {
  auto memory = ClockMemory::open(file());
  ASSERT_TRUE(memory);
  memory->page().horizon_ns.store(wall_now().ns + ms(2).ns);  // and no lock: its bench is dead
  BenchClock clock{*std::move(memory)};
  const Instant deadline = clock.now() + ms(20);
  const Instant give_up = wall_now() + seconds(20);
  while (clock.now() < deadline && wall_now() < give_up) {
    int naps = 0;
    clock.wait_until(deadline, [&](Duration /*span*/) {
      wait(ms(1));
      return ++naps == 5;
    });
  }
  EXPECT_GE(clock.now(), deadline);
}

}  // namespace
}  // namespace pitwall::transport
