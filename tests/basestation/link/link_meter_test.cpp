// SPDX-License-Identifier: Apache-2.0
#include "basestation/link/link_meter.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::link {
namespace {

constexpr Instant kBegin{seconds(500).ns};

// 50 a second, of which each tenth is lost until 10 s, none afterwards.
LinkMeter after(int seconds_run) {
  LinkMeter meter;
  LinkCount count;
  for (int i = 0; i <= seconds_run * 10; ++i) {
    meter.note(count, kBegin + i * LinkMeter::kEvery);
    count.packets += 5;
    count.paths[0].received += 5;
    count.paths[0].up_bytes += 125;  // 10 kbit/s
    if (i < 100 && i % 2 == 0) ++count.missing, ++count.paths[0].lost;
  }
  return meter;
}

TEST(LinkMeter, LossIsThatOfItsWindow) {
  const LinkMeter meter = after(12);
  EXPECT_EQ(meter.loss(seconds(1)), 0.0);
  EXPECT_NEAR(meter.loss(seconds(5)), 15.0 / 265.0, 0.01);
  EXPECT_NEAR(meter.loss(seconds(30)), 50.0 / 650.0, 0.01) << "as long as there is";
  EXPECT_EQ(meter.path(0, seconds(1)).loss, 0.0);
  EXPECT_NEAR(meter.path(0, seconds(5)).up_kbit_s, 10.0, 1e-9);
}

TEST(LinkMeter, TheLongestRoundTripOfTheWindowCounts) {
  LinkMeter meter;
  EXPECT_TRUE(std::isnan(meter.round_trip_ms(seconds(30))));
  for (int i = 0; i < 100; ++i) {
    meter.note({}, kBegin + i * LinkMeter::kEvery, i == 60 ? 80.0 : 20.0);
  }
  EXPECT_EQ(meter.round_trip_ms(seconds(1)), 20.0);
  EXPECT_EQ(meter.round_trip_ms(seconds(5)), 80.0);
}

// A car that calls what comes a quarter of what it may: four times that is its cap.
TEST(LinkMeter, TheCapIsWhatComesOverItsShare) {
  LinkMeter meter;
  EXPECT_TRUE(std::isnan(meter.down_cap_kbit_s(0)));
  meter.note_use(0, 10.0, 0.01);
  EXPECT_TRUE(std::isnan(meter.down_cap_kbit_s(0))) << "too small a share to tell";
  for (int i = 0; i < 200; ++i) meter.note_use(0, i % 2 == 0 ? 240.0 : 260.0, 0.25);
  EXPECT_NEAR(meter.down_cap_kbit_s(0), 1'000.0, 25.0);
  EXPECT_TRUE(std::isnan(meter.down_cap_kbit_s(1)));
}

TEST(LinkMeter, NothingSentIsNoLoss) {
  LinkMeter meter;
  EXPECT_TRUE(std::isnan(meter.loss(seconds(1))));
  meter.note({}, kBegin);
  meter.note({}, kBegin + seconds(1));
  EXPECT_TRUE(std::isnan(meter.loss(seconds(1))));
}

TEST(LinkMeter, ANewSessionBeginsAnew) {
  LinkMeter meter = after(12);
  meter.note({.packets = 1}, kBegin + seconds(20));
  meter.note({.packets = 10}, kBegin + seconds(21));
  EXPECT_EQ(meter.loss(seconds(30)), 0.0);
}

TEST(LinkMeter, AGroupTakesWhatItsBitsAndItsRateMake) {
  LinkMeter meter;
  telemetry::GroupSet groups;
  groups.add(telemetry::Group::kEgo);
  for (int i = 0; i < 200; ++i) meter.packet(groups, kBegin + milliseconds(20) * i);
  EXPECT_NEAR(meter.group_kbit_s(telemetry::Group::kEgo),
              0.05 * static_cast<double>(telemetry::group_bits(telemetry::Group::kEgo)), 1e-9);
  EXPECT_EQ(meter.group_kbit_s(telemetry::Group::kFuel), 0.0);
}

}  // namespace
}  // namespace pitwall::link
