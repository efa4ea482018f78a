// The law of bench time with real processes: for whom it stands, and for whom it goes on. The
// lengths are of the wall clock, whose lateness only makes what is waited for longer.
// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/bench_clock/clock_keeper.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "protocol/transport/bench_clock/bench_clock.hpp"
#include "protocol/transport/bench_clock/bench_pause.hpp"
#include "protocol/transport/clock.hpp"
#include "tests/protocol/transport/bench_clock/clock_file.hpp"

namespace pitwall::transport {
namespace {

constexpr Duration kLong = milliseconds(60);

bool nap_on_wall(Duration span) {
  nap(span);
  return false;
}

// A program with one thread that takes turns; `act` is called with its clock, again and again.
Other taking_turns(const ClockFile& file, std::function<void(BenchClock&)> act) {
  return Other{[&file, act = std::move(act)] {
    BenchClock clock{*ClockMemory::open(file.path)};
    clock.take_turns();
    while (true) act(clock);
  }};
}

struct Kept {
  ClockFile file;
  ClockKeeper keeper = *ClockKeeper::keep(file.path);
  ClockMemory memory = *ClockMemory::open(file.path);

  // How far bench time goes while the wall clock goes `wall`.
  Duration over(Duration wall) {
    const Instant from = keeper.now(), end = wall_now() + wall;
    while (wall_now() < end) {
      keeper.advance();
      nap(microseconds(200));
    }
    return keeper.now() - from;
  }
  // Whether it goes that far at all; where it stands it does not within 20 s of the wall clock.
  bool goes_on(Duration span) {
    const Instant to = keeper.now() + span, give_up = wall_now() + seconds(20);
    while (keeper.now() < to && wall_now() < give_up) {
      keeper.advance();
      nap(microseconds(200));
    }
    return keeper.now() >= to;
  }
  void until_taken() const {
    while (memory.page().slots[0].process.load() == 0) nap(microseconds(100));
  }
  ClockSlot& slot() const { return memory.page().slots[0]; }
};

TEST(ClockKeeper, TimeFollowsTheWallClockWhileEverybodyKeepsUp) {
  Kept kept;
  kept.keeper.begin();
  Other car = taking_turns(kept.file, [](BenchClock& clock) {
    clock.wait_until(clock.now() + milliseconds(5), nap_on_wall);
  });
  kept.until_taken();
  const Instant wall = wall_now();
  const Duration went = kept.over(10 * kLong);
  EXPECT_LE(went, wall_now() - wall);
  EXPECT_GE(went + pause_of(kept.memory.page(), wall_now).total, 10 * kLong)
      << "what is missing was waited for, and is told";
}

TEST(ClockKeeper, TimeStandsWithoutItsKeeperAndGoesOnWithoutAJump) {
  Kept kept;
  kept.keeper.begin();
  const Instant from = kept.keeper.now();
  nap_on_wall(kLong);
  EXPECT_LE(kept.keeper.now() - from, ClockKeeper::kLead);
  const Instant stood = kept.keeper.now();
  kept.keeper.advance();
  EXPECT_LE(kept.keeper.now() - stood, kLong / 2);
  EXPECT_GE(kept.keeper.waits().longest, kLong - 2 * ClockKeeper::kLead);
  EXPECT_EQ(kept.keeper.waits().longest_for, "") << "it was the bench itself";
}

TEST(ClockKeeper, TimeStandsForOneThatIsDueAndDoesNotComeToRun) {
  Kept kept;
  kept.keeper.begin();
  // Due after a millisecond; its nap lasts longer, as where nobody lets it run.
  Other car = taking_turns(kept.file, [](BenchClock& clock) {
    clock.wait_until(clock.now() + milliseconds(1), [](Duration) { return nap_on_wall(kLong); });
  });
  kept.until_taken();
  const Duration went = kept.over(10 * kLong);
  EXPECT_LT(went, 3 * kLong) << "some five milliseconds for each sixty";
  EXPECT_GT(went, Duration{});
  EXPECT_GE(kept.keeper.waits().longest, kLong / 2);
  EXPECT_EQ(kept.keeper.waits().longest_for, "test_protocol_t") << "as ps names this test";
}

TEST(ClockKeeper, TimeStandsForAnotherThreadOfItsOwnProgramAndNeverForItself) {
  Kept kept;
  kept.keeper.begin();
  BenchClock clock{*ClockMemory::open(kept.file.path)};
  std::atomic<bool> has_ended = false;
  std::jthread other{[&](const std::stop_token& stop) {
    clock.take_turns();
    while (!stop.stop_requested())
      clock.wait_until(clock.now() + milliseconds(1), [](Duration) { return nap_on_wall(kLong); });
    has_ended = true;
  }};
  kept.until_taken();
  EXPECT_LT(kept.over(10 * kLong), 3 * kLong);
  other.request_stop();
  while (!has_ended) kept.over(kLong);  // it waits for a time that has to come
  other.join();
  std::jthread{[&] {
    EXPECT_TRUE(clock.take_turns());
    EXPECT_TRUE(kept.goes_on(kLong));
  }}.join();
}

// Who has just taken a place, and was held up before it could say which thread it is.
TEST(ClockKeeper, TimeStandsForOneThatIsJustComing) {
  Kept kept;
  kept.keeper.begin();
  kept.slot().due_ns.store(ClockSlot::kAtWork);
  kept.slot().process.store(::getpid());
  EXPECT_LE(kept.over(kLong), ClockKeeper::kLead);
  EXPECT_EQ(kept.slot().process.load(), ::getpid()) << "its place is kept";
  kept.slot().thread.store(::gettid());
  EXPECT_TRUE(kept.goes_on(kLong));
}

TEST(ClockKeeper, TimeGoesOnForOneThatIsStoppedWhileItComes) {
  Kept kept;
  kept.keeper.begin();
  const Other car{[] {
    while (true) ::pause();
  }};
  kept.slot().due_ns.store(ClockSlot::kAtWork);
  kept.slot().process.store(car.process());
  EXPECT_LE(kept.over(kLong), ClockKeeper::kLead);
  car.tell(SIGSTOP);
  EXPECT_TRUE(kept.goes_on(kLong));
  EXPECT_EQ(kept.slot().process.load(), car.process()) << "its place is kept";
}

TEST(ClockKeeper, TimeGoesOnForOneThatIsStoppedAndWaitsForItAgainLater) {
  Kept kept;
  kept.keeper.begin();
  Other car = taking_turns(kept.file, [](BenchClock& clock) {
    clock.wait_until(clock.now() + milliseconds(1), nap_on_wall);
  });
  kept.until_taken();
  car.tell(SIGSTOP);
  nap(microseconds(20'000));
  EXPECT_TRUE(kept.goes_on(5 * kLong));
  const std::uint64_t turns = kept.slot().turns.load();
  car.tell(SIGCONT);
  kept.over(kLong);
  EXPECT_GT(kept.slot().turns.load(), turns);
}

TEST(ClockKeeper, TimeGoesOnForOneThatBlocksByItsOwnDoing) {
  Kept kept;
  kept.keeper.begin();
  Other car = taking_turns(kept.file, [](BenchClock& clock) {
    clock.wait_until(clock.now() + milliseconds(1), nap_on_wall);
    nap_on_wall(10 * kLong);  // at work, and asleep
  });
  kept.until_taken();
  EXPECT_TRUE(kept.goes_on(5 * kLong));
}

TEST(ClockKeeper, TimeGoesAtThePaceOfOneThatComputes) {
  Kept kept;
  kept.keeper.begin();
  Other car = taking_turns(kept.file, [](BenchClock&) { compute(); });
  kept.until_taken();
  EXPECT_TRUE(kept.goes_on(5 * kLong)) << "it has all the time it works";
}

TEST(ClockKeeper, TimeGoesOnForOneThatDiedAndItsPlaceIsFree) {
  Kept kept;
  kept.keeper.begin();
  {
    Other car = taking_turns(kept.file, [](BenchClock& clock) {
      clock.wait_until(clock.now() + milliseconds(1), nap_on_wall);
    });
    kept.until_taken();
  }
  EXPECT_TRUE(kept.goes_on(3 * kLong));
  EXPECT_EQ(kept.slot().process.load(), 0);
}

TEST(ClockKeeper, NeverPassesALimitAndLeapsForwardAlone) {
  Kept kept;
  kept.keeper.begin();
  const Instant limit = kept.keeper.now() + milliseconds(10);
  const Instant give_up = wall_now() + seconds(20);
  while (kept.keeper.now() < limit && wall_now() < give_up) kept.keeper.advance(limit);
  nap(kLong / 10);
  EXPECT_FALSE(kept.keeper.advance(limit));
  EXPECT_EQ(kept.keeper.now(), limit);
  kept.keeper.leap(limit + seconds(1));
  EXPECT_GE(kept.keeper.now(), limit + seconds(1));
  const Instant after = kept.keeper.now();
  kept.keeper.leap(limit);
  EXPECT_GE(kept.keeper.now(), after);
}

TEST(ClockKeeper, ThereIsOneToAFileAndTimeIsFreeAfterIt) {
  const ClockFile file;
  {
    auto keeper = ClockKeeper::keep(file.path);
    ASSERT_TRUE(keeper);
    keeper->begin();
    EXPECT_FALSE(ClockKeeper::keep(file.path));
  }
  const auto memory = ClockMemory::open(file.path);
  EXPECT_EQ(memory->page().horizon_ns.load(), INT64_MAX);
  EXPECT_TRUE(ClockKeeper::keep(file.path));
}

}  // namespace
}  // namespace pitwall::transport
