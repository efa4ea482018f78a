// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/station_endpoint.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/endpoint_pair.hpp"

namespace pitwall::telemetry {
namespace {

using pitwall::testing::EndpointPair;
using pitwall::testing::WireDatagram;

constexpr FieldIndex kX = field("ego.x");

TEST(StationEndpoint, ShowsValuesWithTheTimeOfTheirSample) {
  EndpointPair pair;
  pair.snapshot.values[kX] = 12.0;
  EXPECT_FALSE(pair.base->state().ever(Group::kEgo));
  pair.run(seconds(1));
  EXPECT_TRUE(pair.base->clock_known());
  EXPECT_DOUBLE_EQ(pair.base->state().values[kX], 12.0);
  const Instant sampled = pair.base->state().at(Group::kEgo);
  EXPECT_LE(sampled, pair.now);
  EXPECT_GE(sampled, pair.now - milliseconds(100));
}

// Packets that overtake each other: the newest sample stays.
TEST(StationEndpoint, AValueNeverGoesBackInTime) {
  EndpointPair pair;
  pair.run(seconds(1));
  std::vector<WireDatagram> held;
  pair.gate = [&](const WireDatagram& datagram) {
    if (!datagram.down) return true;
    held.push_back(datagram);
    return false;
  };
  for (int i = 1; i <= 10; ++i) {
    pair.snapshot.values[kX] = i;
    pair.run(milliseconds(20));
  }
  ASSERT_GE(held.size(), 9u);
  double shown = 0.0;
  for (const std::size_t which : {3U, 1U, 7U, 0U, 2U, 6U, 8U, 5U, 4U}) {
    pair.feed(held[which]);
    EXPECT_GE(pair.base->state().values[kX], shown) << which;
    shown = pair.base->state().values[kX];
  }
  EXPECT_GE(shown, 5.0);
}

TEST(StationEndpoint, AfterARestartOfTheCarItsOldStateIsNotShown) {
  EndpointPair pair;
  pair.run(seconds(1));
  ASSERT_TRUE(pair.base->state().ever(Group::kTyres));
  SeededRandomness other(5);
  pair.car = std::make_unique<CarEndpoint>(pair.config(true), other);
  // The new process never samples tyres.
  pair.gate = [&](const WireDatagram&) { return true; };
  for (int ms = 0; ms < 500; ++ms) pair.step();
  const LinkReport report = pair.base->report(pair.now);
  EXPECT_EQ(report.sessions, 2u);
  EXPECT_GE(pair.base->state().at(Group::kMode), pair.now - milliseconds(100));
}

// Counts what leaves the base, and holds it against the packets of its budget.
struct Departures {
  explicit Departures(EndpointPair& of) : pair(of) {
    pair.gate = [this](const WireDatagram& datagram) {
      if (!datagram.down) at.push_back(pair.now);
      return true;
    };
  }
  void expect_lawful() const {
    constexpr std::size_t kInTenth = 11;  // of 100 a second
    for (std::size_t i = kInTenth; i < at.size(); ++i) {
      EXPECT_GT(at[i] - at[i - kInTenth], milliseconds(99)) << "more than the budget has";
    }
  }
  EndpointPair& pair;
  std::vector<Instant> at;
};

// With any phase to the slots of the base. What is left of the wait is the budget's: it spaces its
// packets, by half of 10 ms at least.
TEST(StationEndpoint, AStopDoesNotWaitForItsSlot) {
  for (const std::uint8_t paths : {std::uint8_t{1}, std::uint8_t{2}}) {
    for (std::int64_t phase = 0; phase < 20; ++phase) {
      EndpointPair pair(paths, 3);
      pair.run(seconds(1) + milliseconds(phase));
      Departures left(pair);
      pair.base->stop().demand(StopLevel::kEmergency, StopReason::kOperator);
      EXPECT_LE(pair.base->due(), pair.now) << "the loop must not sleep over it";
      const Instant pressed = pair.now;
      pair.run(milliseconds(6));
      ASSERT_GE(left.at.size(), paths) << "phase " << phase;
      EXPECT_LE(left.at[paths - 1U] - pressed, milliseconds(5)) << "phase " << phase;
      pair.run(milliseconds(20));
      EXPECT_EQ(pair.car->view(pair.now).stop, StopLevel::kEmergency);
    }
  }
}

// The worst operator: each press is another stop, and each packet of it comes from the budget.
TEST(StationEndpoint, StopsComeOutOfTheBudget) {
  EndpointPair pair;
  pair.run(seconds(1));
  Departures left(pair);
  StopTransmitter& transmitter = pair.base->stop();
  for (std::uint32_t n = 0; n < 200; ++n) {
    transmitter.demand(StopLevel::kControlled, StopReason::kOperator);
    transmitter.demand(StopLevel::kEmergency, StopReason::kOperator);
    pair.run(milliseconds(static_cast<std::int64_t>(n * 7 % 13)));
    transmitter.release_asked(CommandId{n});
    transmitter.released(CommandId{n});
  }
  left.expect_lawful();
  EXPECT_GT(left.at.size(), 60U);
}

// Nobody listens: no packet, and no loop that spins for one.
TEST(StationEndpoint, AStopBeforeTheCarIsThereWaitsInPeace) {
  EndpointPair pair;
  pair.gate = [](const WireDatagram&) { return false; };
  pair.run(milliseconds(200));
  pair.base->stop().demand(StopLevel::kControlled, StopReason::kOperator);
  EXPECT_FALSE(pair.base->poll(pair.now));
  EXPECT_GE(pair.base->due(), pair.now + milliseconds(1));
  pair.gate = [](const WireDatagram&) { return true; };
  pair.run(seconds(1));
  EXPECT_EQ(pair.car->view(pair.now).stop, StopLevel::kControlled);
}

TEST(StationEndpoint, OneTruthAboutACommandAtBothEnds) {
  EndpointPair pair;
  pair.run(seconds(1));
  EXPECT_FALSE(pair.base->issue({CommandType::kSpeedLimit, 1e9, 1}, pair.now));
  pair.base->authority().take(1, pair.now);
  const auto id = pair.base->issue({CommandType::kSpeedLimit, 30.0, 1}, pair.now);
  ASSERT_TRUE(id);
  EXPECT_FALSE(pair.base->progress(*id)->outcome);
  for (int ms = 0; ms < 100; ++ms) {
    pair.step();
    while (const auto due = pair.car->next_command(pair.now)) {
      EXPECT_NEAR(due->command.argument, 30.0, 0.06);
      pair.car->decide(due->id, Outcome::kRefused, pair.now);
    }
  }
  EXPECT_EQ(pair.base->progress(*id)->outcome, Outcome::kRefused);
}

}  // namespace
}  // namespace pitwall::telemetry
