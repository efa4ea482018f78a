// SPDX-License-Identifier: Apache-2.0
#include "basestation/intake/link_stats.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace pitwall::intake {
namespace {

Instant at_ms(std::int64_t ms) { return {milliseconds(ms).ns}; }

TEST(LinkStats, CountsTheRateOfTheLastSecond) {
  const auto link = std::make_unique<LinkStats>();
  for (int i = 0; i < 100; ++i) link->note({}, at_ms(20 * i));
  EXPECT_NEAR(link->rate_hz(at_ms(1'980)), 50.0, 1.0);
  EXPECT_NEAR(link->mean_rate_hz(), 50.0, 1e-9);
  EXPECT_EQ(link->rate_hz(at_ms(10'000)), 0.0);
}

TEST(LinkStats, AgeIsTheSamplesAgePlusTheTimeSinceReception) {
  const auto link = std::make_unique<LinkStats>();
  telemetry::StatePacket packet;
  packet.age_of(telemetry::Group::kEgo) = milliseconds(10);
  for (int i = 0; i < 100; ++i) link->note(packet, at_ms(20 * i));
  // Grows from 10 to 30 ms again and again.
  EXPECT_NEAR(link->ages().quantile(0.5).milliseconds(), 20.0, 1.1);
  EXPECT_NEAR(link->ages().quantile(0.99).milliseconds(), 30.0, 1.1);
  EXPECT_EQ(link->ages().largest(), milliseconds(30));
}

TEST(LinkStats, SilenceCountsWhileItLasts) {
  const auto link = std::make_unique<LinkStats>();
  link->note({}, at_ms(0));
  link->advance(at_ms(400));
  link->advance(at_ms(1'000));
  EXPECT_EQ(link->ages().largest(), seconds(1));
  EXPECT_NEAR(link->ages().quantile(0.5).milliseconds(), 500.0, 1.1);
  link->note({}, at_ms(1'000));
  EXPECT_EQ(link->ages().largest(), seconds(1));
}

TEST(LinkStats, KnowsNothingAtFirst) {
  const auto link = std::make_unique<LinkStats>();
  link->advance(at_ms(5));
  EXPECT_FALSE(link->ever());
  EXPECT_EQ(link->mean_rate_hz(), 0.0);
  EXPECT_EQ(link->rate_hz(at_ms(5)), 0.0);
}

}  // namespace
}  // namespace pitwall::intake
