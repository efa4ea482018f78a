// A replay by bench time, in processes of their own: a program has one clock.
// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/replay_clock.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <new>
#include <optional>
#include <thread>
#include <vector>

#include "hil/replay/replay_verb.hpp"
#include "protocol/transport/bench_clock/bench_clock.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/yaml/strict_map.hpp"
#include "tests/hil/replay/recordings/recording_samples.hpp"
#include "tests/protocol/transport/bench_clock/clock_file.hpp"

namespace pitwall::replay {
namespace {

constexpr std::uint32_t kSteps = 50;  // a datagram every 10 ms
constexpr std::size_t kSome = 10;
constexpr Duration kHold = milliseconds(400), kSettle = milliseconds(200);
constexpr Duration kLength = milliseconds(500);
constexpr std::int64_t kMaxLate_us = 10'000;  // lead and grace of bench time, and a wake-up

class ReplayByBenchTime : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(transport::write_file(box_, traffic::testing::black_box(kSteps)));
    port_ = *transport::UdpSocket::bind({});
  }

  std::size_t came() {
    std::vector<transport::UdpDatagram> some(16);
    while (const std::size_t n = port_->receive(some)) came_ += n;
    return came_;
  }

  // In a thread; `meanwhile` is called until it has ended. The exit code of the verb.
  template <class Meanwhile>
  int play(Meanwhile&& meanwhile) {
    std::atomic<int> code = -1;
    std::thread replay{[&] {
      code = replay_verb(std::vector<std::string>{box_, "--receiver",
                                                  "/gnss/0=" + to_string(port_->local()), "--clock",
                                                  clock_, "--json", json_});
    }};
    while (code < 0) meanwhile();
    replay.join();
    return code;
  }

  transport::TemporaryFolder folder_ = *transport::TemporaryFolder::create("pitwall-replay-");
  std::string box_ = folder_.path() + "/box.mcap", clock_ = folder_.path() + "/clock",
              json_ = folder_.path() + "/replay.json";
  std::optional<transport::UdpSocket> port_;
  std::size_t came_ = 0;
};

TEST_F(ReplayByBenchTime, WaitsWhileTheTimeStandsThatAnotherKeeps) {
  const auto run = [this] {
    auto keeper = transport::ClockKeeper::keep(clock_);
    if (!keeper) return 2;
    keeper->begin();
    bool held = false, silent = false;
    const int code = play([&] {
      keeper->advance();
      transport::nap(microseconds(200));
      if (held || came() < kSome) return;
      held = true;
      transport::nap(kSettle);  // until what was due has been sent
      const std::size_t before = came();
      transport::nap(kHold);
      silent = came() == before && before < kSteps;
    });
    if (code != 0 || came() != kSteps) return 3;
    return silent ? 0 : 4;
  };
  EXPECT_EXIT(::_exit(run()), ::testing::ExitedWithCode(0), "");
  const auto json = yaml::load_file(json_);
  ASSERT_TRUE(json) << to_string(json.error());
  yaml::StrictMap report = json->root();
  EXPECT_LT(report.integer("took_us", 0, 1'000'000'000), (kLength + kHold).ns / 1'000);
  EXPECT_LT(report.map("late_us").integer("max", 0, 1'000'000'000), kMaxLate_us);
  EXPECT_GE(report.map("bench_time").number("stood_s", 0.0, 1e3), (kSettle + kHold / 2).seconds());
}

// A program that takes turns until it is told to be held up: once, for long, while it is due.
class Car {
 public:
  enum Stage : int { kDrives, kToBeHeld, kHeld, kEnded };

  explicit Car(const std::string& clock)
      : stage_(*new (::mmap(nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE,
                            MAP_SHARED | MAP_ANONYMOUS, -1, 0)) std::atomic<int>{kDrives}),
        process_([&] { drive(clock); }) {}

  std::atomic<int>& stage() { return stage_; }

 private:
  void drive(const std::string& clock) {
    transport::BenchClock time{*transport::ClockMemory::open(clock)};
    time.take_turns();
    while (stage_ == kDrives)
      time.wait_until(time.now() + milliseconds(5), [](Duration span) {
        transport::nap(span);
        return false;
      });
    time.wait_until(time.now() + milliseconds(1), [this](Duration) {
      stage_ = kHeld;
      transport::nap(kSettle + 2 * kHold);
      return true;
    });
    stage_ = kEnded;
  }

  std::atomic<int>& stage_;  // in memory that both processes have
  transport::Other process_;
};

TEST_F(ReplayByBenchTime, KeepsATimeThatNobodyKeepsAndWaitsForTheProgramsThatTakeTurns) {
  const auto run = [this] {
    Car car{clock_};
    bool silent = false;
    const int code = play([&] {
      transport::nap(microseconds(200));
      if (car.stage() == Car::kDrives && came() >= kSome) car.stage() = Car::kToBeHeld;
      if (car.stage() != Car::kHeld) return;
      transport::nap(kSettle);  // until what was due has been sent
      const std::size_t before = came();
      transport::nap(kHold);
      silent = car.stage() == Car::kHeld && came() == before && before < kSteps;
      while (car.stage() == Car::kHeld) transport::nap(milliseconds(1));
    });
    if (code != 0 || came() != kSteps) return 3;
    return silent ? 0 : 4;
  };
  EXPECT_EXIT(::_exit(run()), ::testing::ExitedWithCode(0), "");
  const auto json = yaml::load_file(json_);
  ASSERT_TRUE(json) << to_string(json.error());
  yaml::StrictMap report = json->root();
  EXPECT_LT(report.map("late_us").integer("max", 0, 1'000'000'000), kMaxLate_us);
  yaml::StrictMap stood = report.map("bench_time");
  EXPECT_GE(stood.number("longest_ms", 0.0, 1e6), kHold.milliseconds());
  EXPECT_GE(stood.number("longest_at_s", 0.0, 1e3), 0.09) << "after ten datagrams";
  EXPECT_LE(stood.number("longest_at_s", 0.0, 1e3), kLength.seconds());
  EXPECT_EQ(stood.text("longest_for").substr(0, 8), "test_hil") << "as ps names this test";
}

TEST(ReplayClock, TheWallClockHasNothingToTell) {
  auto clock = ReplayClock::open("wall");
  ASSERT_TRUE(clock);
  EXPECT_TRUE(clock->is_wall());
  EXPECT_TRUE(clock->begin());
  EXPECT_FALSE(clock->end());
  EXPECT_FALSE(transport::has_bench_time());
}

TEST(ReplayClock, AFileThatCannotBeIsNamed) {
  const auto clock = ReplayClock::open("/no/such/folder/time");
  ASSERT_FALSE(clock);
  EXPECT_EQ(clock.error().place, "/no/such/folder/time");
}

TEST(ReplayClock, SaysForHowLongAndForWhom) {
  transport::ClockWaits waits;
  waits.total = milliseconds(250);
  EXPECT_EQ(to_text(waits), "bench time stood for 0.25 s in all\n")
      << "another process runs the clock";
  EXPECT_EQ(to_json(waits), "{\"stood_s\": 0.25}");
  waits.count = 3;
  waits.longest = milliseconds(79);
  waits.longest_at = Instant{} + milliseconds(13'670);
  EXPECT_NE(to_text(waits).find("at 13.67 s for the replay\n"), std::string::npos);
  waits.longest_for = "pitwall-vehicle";
  EXPECT_EQ(to_text(waits),
            "bench time stood 3 times, 0.25 s in all, at the longest 79 ms at 13.67 s for "
            "pitwall-vehicle\n");
}

}  // namespace
}  // namespace pitwall::replay
