// SPDX-License-Identifier: Apache-2.0
#include "basestation/intake/station.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/basestation/sender.hpp"

namespace pitwall::intake {
namespace {

constexpr auto kX = telemetry::field("ego.x");

struct Car : Sender {
  Car() { packet.age_of(telemetry::Group::kEgo) = {}; }
  std::vector<std::uint8_t> at(double x_m, std::uint32_t sequence) {
    packet.values[kX] = x_m;
    return bytes(sequence);
  }
};

TEST(Station, KnowsWhatItTook) {
  const auto station = std::make_unique<Station>(1);
  Car car;
  station->take(car.at(321.0, 1), {});
  EXPECT_EQ(station->picture().view(kX, {}).value, 321.0);
  EXPECT_TRUE(station->link().ever());
  station->advance({milliseconds(70).ns});
  EXPECT_EQ(station->link().ages().largest(), milliseconds(70));
}

TEST(Station, AnOlderPacketDoesNotReplaceTheNewer) {
  const auto station = std::make_unique<Station>(1);
  Car car;
  const auto older = car.at(1.0, 1);
  station->take(car.at(2.0, 2), {});
  station->take(older, {milliseconds(1).ns});
  EXPECT_EQ(station->picture().view(kX, {}).value, 2.0);
}

TEST(Station, GarbageIsCountedOnly) {
  const auto station = std::make_unique<Station>(1);
  station->take(std::vector<std::uint8_t>(100, 0x55), {});
  EXPECT_EQ(station->counters().refused_total(), 1U);
  EXPECT_FALSE(station->picture().ever());
  EXPECT_FALSE(station->link().ever());
}

}  // namespace
}  // namespace pitwall::intake
