// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/summary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "tests/basestation/sender.hpp"

namespace pitwall::outlets {
namespace {

using telemetry::field;

TEST(Summary, SaysWhatWasHeard) {
  const auto station = std::make_unique<intake::Station>(1);
  Sender car;
  car.packet.age_of(telemetry::Group::kEgo) = milliseconds(5);
  car.packet.values[field("ego.x")] = 10.0;
  for (std::uint32_t i = 0; i < 11; ++i) {
    if (i == 5) continue;
    ASSERT_TRUE(station->take(car.bytes(i), {milliseconds(100 * i).ns}));
  }
  for (const bool sent : {true, true, false}) station->uplink().note(sent);
  const std::string json = json_summary(*station, {milliseconds(1'000).ns});
  for (const char* part :
       {"\"source\": \"car\"", "\"car\": \"heard\"", "\"heartbeats_sent\": 2,",
        "\"heartbeats_not_sent\": 1,", "\"packets\": 10,", "\"lost\": 1,", "\"refused\": 0,",
        "\"rate_hz\": 9,", "\"max\": 205}",
        "\"ego.x\": {\"unit\": \"m\", \"quality\": \"fresh\", \"value\": 10, \"age_ms\": 5}",
        "\"ego.y\": {\"unit\": \"m\", \"quality\": \"never\", \"value\": null}"}) {
    EXPECT_NE(json.find(part), std::string::npos) << part << "\n" << json;
  }
  EXPECT_NE(json_summary(*station, {milliseconds(2'001).ns}).find("\"car\": \"lost\""),
            std::string::npos);
  EXPECT_EQ(std::count(json.begin(), json.end(), '{'), std::count(json.begin(), json.end(), '}'));
}

TEST(Summary, OfNothingIsStillADocument) {
  const auto station = std::make_unique<intake::Station>(1);
  const std::string json = json_summary(*station, {});
  EXPECT_NE(json.find("\"car\": \"never heard\""), std::string::npos);
  EXPECT_NE(json.find("\"source\": \"none\""), std::string::npos);
  EXPECT_NE(json.find("\"packets\": 0,"), std::string::npos);
  EXPECT_EQ(json.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::outlets
