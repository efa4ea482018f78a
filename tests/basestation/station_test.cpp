// SPDX-License-Identifier: Apache-2.0
#include "basestation/station.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/basestation/sender.hpp"

namespace pitwall::basestation {
namespace {

TEST(Station, ShowsWhatItTook) {
  const auto station = std::make_unique<Station>();
  Sender car;
  car.packet.age_of(telemetry::Group::kEgo) = {};
  car.packet.values[telemetry::field("ego.x")] = 321.0;
  station->take(car.bytes(1), {});
  EXPECT_NE(station->screen({}, false).find("321.00"), std::string::npos);
  EXPECT_NE(station->summary({}).find("\"packets\": 1,"), std::string::npos);
}

TEST(Station, AnOlderPacketDoesNotReplaceTheNewer) {
  const auto station = std::make_unique<Station>();
  Sender car;
  car.packet.age_of(telemetry::Group::kEgo) = {};
  const auto x = telemetry::field("ego.x");
  car.packet.values[x] = 1.0;
  const auto older = car.bytes(1);
  car.packet.values[x] = 2.0;
  station->take(car.bytes(2), {});
  station->take(older, {milliseconds(1).ns});
  EXPECT_EQ(station->picture().view(x, {}).value, 2.0);
}

TEST(Station, GarbageIsCountedOnly) {
  const auto station = std::make_unique<Station>();
  station->take(std::vector<std::uint8_t>(100, 0x55), {});
  EXPECT_EQ(station->counters().refused_total(), 1U);
  EXPECT_FALSE(station->picture().ever());
}

}  // namespace
}  // namespace pitwall::basestation
