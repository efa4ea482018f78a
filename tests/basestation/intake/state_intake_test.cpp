// SPDX-License-Identifier: Apache-2.0
#include "basestation/intake/state_intake.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/basestation/sender.hpp"

namespace pitwall::intake {
namespace {

struct Random {
  std::uint64_t state;
  std::uint64_t next() {
    state ^= state << 13U, state ^= state >> 7U, state ^= state << 17U;
    return state;
  }
};

TEST(StateIntake, InOrderNothingIsLost) {
  Sender car;
  StateIntake intake;
  for (std::uint32_t i = 0; i < 100; ++i) EXPECT_TRUE(intake.feed(car.bytes(500 + i), {}));
  EXPECT_EQ(intake.counters().accepted, 100U);
  EXPECT_EQ(intake.counters().lost, 0U);
  EXPECT_EQ(intake.counters().runs, 1U);
}

TEST(StateIntake, ADuplicateIsTakenOnce) {
  Sender car;
  StateIntake intake;
  EXPECT_TRUE(intake.feed(car.bytes(7), {}));
  EXPECT_FALSE(intake.feed(car.bytes(7), {}));
  EXPECT_TRUE(intake.feed(car.bytes(8), {}));
  EXPECT_FALSE(intake.feed(car.bytes(7), {}));
  EXPECT_EQ(intake.counters().duplicates, 2U);
  EXPECT_EQ(intake.counters().lost, 0U);
}

TEST(StateIntake, ALatePacketIsDroppedAndTakenOffTheLoss) {
  Sender car;
  StateIntake intake;
  intake.feed(car.bytes(1), {});
  intake.feed(car.bytes(4), {});
  EXPECT_EQ(intake.counters().lost, 2U);
  EXPECT_FALSE(intake.feed(car.bytes(2), {}));
  EXPECT_EQ(intake.counters().lost, 1U);
  EXPECT_EQ(intake.counters().late, 1U);
  EXPECT_FALSE(intake.feed(car.bytes(2), {}));
  EXPECT_EQ(intake.counters().duplicates, 1U);
}

TEST(StateIntake, TheNumbersMayWrap) {
  Sender car;
  StateIntake intake;
  for (std::uint32_t i = 0xFFFF'FFF0U; i != 0x10U; ++i) EXPECT_TRUE(intake.feed(car.bytes(i), {}));
  EXPECT_EQ(intake.counters().lost, 0U);
}

// Oracle: sets of numbers.
TEST(StateIntake, AnyNetworkIsCountedRight) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Random random{seed * 0x9E3779B97F4A7C15ULL};
    std::vector<std::uint32_t> arrivals;
    for (std::uint32_t sequence = 0; sequence < 300; ++sequence) {
      if (sequence != 0 && sequence != 299 && random.next() % 5 == 0) continue;  // lost
      const std::size_t back = sequence == 299 ? 0 : random.next() % 8;          // reordered
      const std::size_t at = arrivals.size() - std::min(arrivals.size(), back);
      arrivals.insert(arrivals.begin() + static_cast<std::ptrdiff_t>(
                                             sequence == 0 ? 0 : std::max(at, std::size_t{1})),
                      sequence);
      if (random.next() % 6 == 0 && sequence != 0) arrivals.push_back(sequence);  // duplicated
    }
    Sender car;
    StateIntake intake;
    std::set<std::uint32_t> seen;
    std::uint64_t accepted = 0, duplicates = 0, late = 0;
    std::int64_t newest = -1;
    for (const std::uint32_t sequence : arrivals) {
      const bool first = seen.insert(sequence).second;
      const bool ahead = std::int64_t{sequence} > newest;
      ++(ahead ? accepted : first ? late : duplicates);
      newest = std::max(newest, std::int64_t{sequence});
      const auto packet = intake.feed(car.bytes(sequence), {});
      EXPECT_EQ(packet.has_value(), ahead) << "seed " << seed;
      if (packet) {
        EXPECT_EQ(packet->sequence, sequence);
      }
    }
    EXPECT_EQ(intake.counters().accepted, accepted);
    EXPECT_EQ(intake.counters().duplicates, duplicates);
    EXPECT_EQ(intake.counters().late, late);
    EXPECT_EQ(intake.counters().lost, 300 - seen.size()) << "seed " << seed;
  }
}

TEST(StateIntake, EveryDatagramIsCountedExactlyOnce) {
  Random random{99};
  Sender car;
  StateIntake intake;
  std::uint64_t fed = 0;
  for (; fed < 3'000; ++fed) {
    auto bytes = car.bytes(static_cast<std::uint32_t>(random.next() % 500));
    if (random.next() % 3 == 0) bytes[random.next() % bytes.size()] ^= 0x10U;
    if (random.next() % 5 == 0) bytes.resize(random.next() % bytes.size());
    intake.feed(bytes, {});
  }
  const IntakeCounters& c = intake.counters();
  EXPECT_EQ(c.received, fed);
  EXPECT_EQ(c.accepted + c.duplicates + c.late + c.other_run + c.refused_total(), fed);
  EXPECT_GT(c.refused_total(), 0U);
}

TEST(StateIntake, ARefusedPacketChangesNothing) {
  Sender car;
  StateIntake intake;
  intake.feed(car.bytes(10), {});
  auto damaged = car.bytes(1'000'000);
  damaged[30] ^= 1U;
  EXPECT_FALSE(intake.feed(damaged, {}));
  EXPECT_TRUE(intake.feed(car.bytes(11), {}));
  EXPECT_EQ(intake.counters().lost, 0U);
}

TEST(StateIntake, ARestartOfTheCarBeginsAfresh) {
  Sender car;
  StateIntake intake;
  intake.feed(car.bytes(5'000), {});
  ++car.packet.run;
  EXPECT_TRUE(intake.feed(car.bytes(1), {}));
  EXPECT_EQ(intake.counters().lost, 0U);
  EXPECT_EQ(intake.counters().runs, 2U);
  --car.packet.run;
  EXPECT_FALSE(intake.feed(car.bytes(5'001), {}));
  EXPECT_EQ(intake.counters().other_run, 1U);
}

TEST(StateIntake, AnOlderRunIsHeardAfterASilence) {
  Sender car;
  StateIntake intake;
  car.packet.run = 10;
  intake.feed(car.bytes(1), {seconds(1).ns});
  car.packet.run = 9;
  EXPECT_FALSE(intake.feed(car.bytes(1), {(seconds(1) + StateIntake::kSilence).ns - 1}));
  EXPECT_TRUE(intake.feed(car.bytes(2), {(seconds(1) + StateIntake::kSilence).ns}));
}

TEST(StateIntake, LossIsAFractionOfWhatWasSent) {
  Sender car;
  StateIntake intake;
  EXPECT_EQ(intake.counters().loss(), 0.0);
  for (std::uint32_t i = 0; i <= 100; i += 2) intake.feed(car.bytes(i), {});
  EXPECT_NEAR(intake.counters().loss(), 50.0 / 101.0, 1e-12);
}

}  // namespace
}  // namespace pitwall::intake
