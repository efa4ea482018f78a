// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/car_endpoint.hpp"

#include <gtest/gtest.h>

#include "tests/support/allocation_guard.hpp"
#include "tests/support/endpoint_pair.hpp"

namespace pitwall::telemetry {
namespace {

using pitwall::testing::EndpointPair;

constexpr HolderId kOperator = 1;

TEST(CarEndpoint, BeforeASessionNobodyWantsAnything) {
  EndpointPair pair;
  const OperatorView view = pair.car->view(pair.now);
  EXPECT_EQ(view.stop, StopLevel::kNone);
  EXPECT_FALSE(view.joystick);
  EXPECT_EQ(view.authority, 0);
  EXPECT_FALSE(view.alive_at);
  EXPECT_FALSE(pair.car->schema_agrees());
  EXPECT_FALSE(pair.car->next_command(pair.now));
}

TEST(CarEndpoint, HearsWhatTheOperatorWants) {
  EndpointPair pair;
  pair.run(seconds(1));
  pair.base->authority().take(kOperator, pair.now);
  pair.base->stop().demand(StopLevel::kControlled, StopReason::kRaceControl);
  pair.base->joystick().sample({0.25, 0.5}, pair.now);
  pair.run(milliseconds(60));
  const OperatorView view = pair.car->view(pair.now);
  EXPECT_EQ(view.stop, StopLevel::kControlled);
  EXPECT_EQ(view.stop_reason, StopReason::kRaceControl);
  EXPECT_NE(view.stop_challenge, 0);
  ASSERT_TRUE(view.joystick);
  EXPECT_NEAR(view.joystick->throttle_cap, 0.25, 0.01);
  EXPECT_EQ(view.authority, kOperator);
  ASSERT_TRUE(view.alive_at);
  EXPECT_LE(*view.alive_at, pair.now);
  EXPECT_TRUE(pair.car->schema_agrees());
}

TEST(CarEndpoint, AReleaseOpensTheLatchOnlyAtStandstillAndIsNoBusinessOfTheConsumer) {
  EndpointPair pair;
  pair.run(seconds(1));
  pair.base->stop().demand(StopLevel::kEmergency, StopReason::kOperator);
  pair.base->authority().take(kOperator, pair.now);
  pair.run(milliseconds(100));
  for (const bool stands : {false, true}) {
    pair.car->standstill(stands);
    const double challenge = pair.car->view(pair.now).stop_challenge;
    const auto id = pair.base->issue({CommandType::kReleaseStop, challenge, kOperator}, pair.now);
    ASSERT_TRUE(id);
    for (int ms = 0; ms < 200; ++ms) {
      pair.step();
      EXPECT_FALSE(pair.car->next_command(pair.now));
    }
    EXPECT_EQ(pair.base->progress(*id)->outcome, stands ? Outcome::kApplied : Outcome::kRefused);
    const StopLevel level = pair.car->view(pair.now).stop;
    EXPECT_EQ(level, stands ? StopLevel::kNone : StopLevel::kEmergency);
  }
}

TEST(CarEndpoint, ADoubleClickOnReleaseIsOneRelease) {
  EndpointPair pair;
  pair.run(seconds(1));
  pair.base->stop().demand(StopLevel::kEmergency, StopReason::kOperator);
  pair.base->authority().take(kOperator, pair.now);
  pair.run(milliseconds(100));
  pair.car->standstill(true);
  const double challenge = pair.car->view(pair.now).stop_challenge;
  const Command release{CommandType::kReleaseStop, challenge, kOperator};
  EXPECT_TRUE(pair.base->issue(release, pair.now));
  EXPECT_FALSE(pair.base->issue(release, pair.now));
  for (int ms = 0; ms < 500; ++ms) {
    pair.step();
    EXPECT_FALSE(pair.car->next_command(pair.now));
  }
  EXPECT_EQ(pair.base->stop().state().level, StopLevel::kNone);
  EXPECT_EQ(pair.car->view(pair.now).stop, StopLevel::kNone);
}

TEST(CarEndpoint, APressDuringAReleaseWins) {
  EndpointPair pair;
  pair.run(seconds(1));
  pair.base->stop().demand(StopLevel::kEmergency, StopReason::kOperator);
  pair.base->authority().take(kOperator, pair.now);
  pair.run(milliseconds(100));
  pair.car->standstill(true);
  const double challenge = pair.car->view(pair.now).stop_challenge;
  ASSERT_TRUE(pair.base->issue({CommandType::kReleaseStop, challenge, kOperator}, pair.now));
  pair.base->stop().demand(StopLevel::kEmergency, StopReason::kOperator);
  for (int ms = 0; ms < 500; ++ms) {
    pair.step();
    EXPECT_FALSE(pair.car->next_command(pair.now));
  }
  EXPECT_EQ(pair.car->view(pair.now).stop, StopLevel::kEmergency);
}

TEST(CarEndpoint, EventsAndBulkArriveOnce) {
  EndpointPair pair;
  pair.run(seconds(1));
  Event event;
  event.kind = EventKind::kText;
  event.at = pair.now;
  EXPECT_TRUE(event.payload.push('x'));
  EXPECT_TRUE(pair.car->log(event));
  const std::vector<std::uint8_t> path(3'000, 7);
  EXPECT_TRUE(pair.car->offer(BulkKind::kPath, path));
  pair.run(seconds(2));
  const auto received = pair.base->next_event();
  ASSERT_TRUE(received);
  EXPECT_EQ(received->kind, EventKind::kText);
  EXPECT_FALSE(pair.base->next_event());
  const auto object = pair.base->next_bulk();
  ASSERT_TRUE(object);
  EXPECT_TRUE(std::equal(path.begin(), path.end(), object->bytes.begin(), object->bytes.end()));
  EXPECT_FALSE(pair.base->next_bulk());
}

TEST(CarEndpoint, NothingAllocatesOnceItIsBuilt) {
  if (!pitwall::testing::kAllocationsCounted) GTEST_SKIP() << "AddressSanitizer has its own heap";
  EndpointPair pair(2);
  const std::vector<std::uint8_t> path(20'000, 7);
  const std::size_t count = pitwall::testing::allocations_of([&] {
    for (int ms = 0; ms < 5'000; ++ms) {
      if (ms == 1'000) pair.car->offer(BulkKind::kPath, path);
      if (ms % 500 == 0) pair.base->authority().take(kOperator, pair.now);
      if (ms % 300 == 0) {
        (void)pair.base->issue({CommandType::kSpeedLimit, 20.0, kOperator}, pair.now);
      }
      pair.step();
      while (const auto due = pair.car->next_command(pair.now)) {
        pair.car->decide(due->id, Outcome::kApplied, pair.now);
      }
      while (pair.base->next_bulk()) {
      }
    }
  });
  EXPECT_EQ(count, 0u);
  EXPECT_GT(pair.car->report(pair.now).ledger.applied, 5u);
  EXPECT_EQ(pair.car->report(pair.now).bulk.delivered, 1u);
}

}  // namespace
}  // namespace pitwall::telemetry
