// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/perception/sweep_gatherer.hpp"

#include <gtest/gtest.h>

namespace pitwall::io {
namespace {

constexpr Duration kPeriod = milliseconds(50);

Instant ms(std::int64_t since) { return Instant{1'000'000'000} + milliseconds(since); }

// All sensors send once, so that they are alive.
SweepGatherer with_all_alive(std::size_t sensors) {
  SweepGatherer gatherer{sensors};
  for (std::size_t i = 0; i < sensors; ++i) gatherer.arrived(i, ms(-110), ms(-50));
  EXPECT_TRUE(gatherer.take());
  return gatherer;
}

TEST(SweepGatherer, AFrameIsDueWhenEverySensorThatIsAliveIsInIt) {
  SweepGatherer gatherer = with_all_alive(3);
  gatherer.arrived(1, ms(-58), ms(0));
  EXPECT_FALSE(gatherer.is_due(ms(3)));
  gatherer.arrived(0, ms(-60), ms(3));
  EXPECT_FALSE(gatherer.is_due(ms(5)));
  gatherer.arrived(2, ms(-59), ms(5));
  EXPECT_TRUE(gatherer.is_due(ms(5)));
  const auto frame = gatherer.take();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->begun, ms(-60)) << "of the sweep that began first";
  EXPECT_EQ(frame->sensors, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(gatherer.begun(1), ms(-58));
  EXPECT_FALSE(gatherer.is_due(ms(5)));
  EXPECT_FALSE(gatherer.take()) << "no sweep is in two frames";
}

TEST(SweepGatherer, ALateSensorIsNotWaitedFor) {
  SweepGatherer gatherer = with_all_alive(2);
  gatherer.arrived(0, ms(-60), ms(0));
  EXPECT_FALSE(gatherer.is_due(ms(11)));
  EXPECT_TRUE(gatherer.is_due(ms(12)));
  EXPECT_EQ(gatherer.take()->sensors, (std::vector<std::size_t>{0}));
  gatherer.arrived(1, ms(-60), ms(20));
  EXPECT_TRUE(gatherer.must_take_before(1));
  gatherer.arrived(0, ms(-10), ms(50));
  EXPECT_TRUE(gatherer.is_due(ms(50)));
}

TEST(SweepGatherer, ADeadSensorIsWaitedForNoLonger) {
  SweepGatherer gatherer = with_all_alive(2);
  Instant now = ms(0);
  for (int sweep = 0; sweep < 10; ++sweep, now += kPeriod) {
    gatherer.arrived(0, now - milliseconds(60), now);
    const bool is_alive = now - ms(-50) <= SweepGatherer::kAlive;
    EXPECT_EQ(gatherer.is_due(now), !is_alive) << sweep;
    ASSERT_TRUE(gatherer.take());
  }
}

TEST(SweepGatherer, WithoutASweepThereIsNoFrame) {
  SweepGatherer gatherer{3};
  EXPECT_FALSE(gatherer.is_due(ms(0)));
  EXPECT_FALSE(gatherer.take());
  gatherer.arrived(2, ms(-60), ms(0));
  EXPECT_TRUE(gatherer.is_due(ms(0))) << "the others were never alive";
}

TEST(SweepGatherer, InThePublishedWayAllAreWaitedForTogether) {
  SweepGatherer gatherer{2, Gathering::kAll};
  gatherer.arrived(0, ms(-60), ms(0));
  EXPECT_FALSE(gatherer.is_due(ms(1'000))) << "however long that takes";
  EXPECT_FALSE(gatherer.must_take_before(0));
  gatherer.arrived(0, ms(-10), ms(50));
  gatherer.arrived(1, ms(-60), ms(52));
  EXPECT_FALSE(gatherer.is_due(ms(52))) << "they are of two sweeps";
  gatherer.arrived(1, ms(-12), ms(55));
  EXPECT_TRUE(gatherer.is_due(ms(55)));
  EXPECT_EQ(gatherer.take()->begun, ms(-12));
  EXPECT_FALSE(gatherer.is_due(ms(1'000)));
}

}  // namespace
}  // namespace pitwall::io
