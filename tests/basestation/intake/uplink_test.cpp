// SPDX-License-Identifier: Apache-2.0
#include "basestation/intake/uplink.hpp"

#include <gtest/gtest.h>

namespace pitwall::intake {
namespace {

constexpr Instant at_ms(std::int64_t ms) { return {milliseconds(ms).ns}; }

telemetry::StatePacket packet(std::uint32_t run, std::uint32_t sequence, Instant sent) {
  telemetry::StatePacket p;
  p.run = run;
  p.sequence = sequence;
  p.sent = sent;
  return p;
}

TEST(Uplink, IsSilentBeforeACarIsHeardAndAnswersTheFirstPacketAtOnce) {
  Uplink up{7};
  EXPECT_FALSE(up.due());
  EXPECT_TRUE(up.poll(at_ms(50)).empty());
  up.heard(packet(3, 40, at_ms(900)), at_ms(60));
  ASSERT_TRUE(up.due());
  EXPECT_EQ(*up.due(), at_ms(60));
  const auto heartbeat = telemetry::parse_heartbeat(up.poll(at_ms(62)));
  ASSERT_TRUE(heartbeat);
  EXPECT_EQ(heartbeat->run, 7U);
  EXPECT_EQ(heartbeat->sequence, 0U);
  EXPECT_EQ(heartbeat->sent, at_ms(62));
  EXPECT_EQ(heartbeat->heard_run, 3U);
  EXPECT_EQ(heartbeat->heard_sequence, 40U);
  EXPECT_EQ(heartbeat->heard_sent, at_ms(900));
  EXPECT_EQ(heartbeat->held, milliseconds(2));
}

// Whatever the times at which it is asked: ten a second, never two within a period.
TEST(Uplink, KeepsItsPeriodHoweverItIsPolled) {
  for (const std::int64_t step_ms : {1, 3, 7, 20, 33, 90}) {
    Uplink up{1};
    up.heard(packet(1, 0, {}), {});
    Instant last{-seconds(1).ns};
    int count = 0;
    for (std::int64_t ms = 0; ms <= 10'000; ms += step_ms) {
      if (up.poll(at_ms(ms)).empty()) continue;
      EXPECT_GE(at_ms(ms) - last, telemetry::kHeartbeatPeriod - milliseconds(step_ms));
      last = at_ms(ms);
      ++count;
    }
    EXPECT_NEAR(count, 101, 1) << step_ms;
  }
}

TEST(Uplink, MissedPeriodsAreNotMadeUpFor) {
  Uplink up{1};
  up.heard(packet(1, 0, {}), {});
  EXPECT_FALSE(up.poll(at_ms(0)).empty());
  EXPECT_FALSE(up.poll(at_ms(5'000)).empty());
  EXPECT_TRUE(up.poll(at_ms(5'099)).empty());
  EXPECT_FALSE(up.poll(at_ms(5'100)).empty());
}

TEST(Uplink, ASilentCarIsStillTold) {
  Uplink up{1};
  up.heard(packet(1, 9, {}), {});
  (void)up.poll({});
  const auto heartbeat = telemetry::parse_heartbeat(up.poll(at_ms(60'000)));
  ASSERT_TRUE(heartbeat);
  EXPECT_EQ(heartbeat->heard_sequence, 9U);
  EXPECT_EQ(heartbeat->held, seconds(60));
}

}  // namespace
}  // namespace pitwall::intake
