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
  intake::StateIntake intake;
  const auto link = std::make_unique<intake::LinkStats>();
  picture::Picture picture;
  Sender car;
  car.packet.age_of(telemetry::Group::kEgo) = milliseconds(5);
  car.packet.values[field("ego.x")] = 10.0;
  for (std::uint32_t i = 0; i < 11; ++i) {
    if (i == 5) continue;
    const Instant at{milliseconds(100 * i).ns};
    const auto packet = intake.feed(car.bytes(i), at);
    ASSERT_TRUE(packet.has_value());
    link->note(*packet, at);
    picture.update(*packet, at);
  }
  const std::string json =
      json_summary(picture, intake.counters(), *link, {milliseconds(1'000).ns});
  for (const char* part :
       {"\"source\": \"car\"", "\"packets\": 10,", "\"lost\": 1,", "\"refused\": 0,",
        "\"rate_hz\": 9,", "\"max\": 205}",
        "\"ego.x\": {\"unit\": \"m\", \"quality\": \"fresh\", \"value\": 10, \"age_ms\": 5}",
        "\"ego.y\": {\"unit\": \"m\", \"quality\": \"never\", \"value\": null}"}) {
    EXPECT_NE(json.find(part), std::string::npos) << part << "\n" << json;
  }
  EXPECT_EQ(std::count(json.begin(), json.end(), '{'), std::count(json.begin(), json.end(), '}'));
}

TEST(Summary, OfNothingIsStillADocument) {
  const auto link = std::make_unique<intake::LinkStats>();
  const std::string json = json_summary({}, {}, *link, {});
  EXPECT_NE(json.find("\"source\": \"none\""), std::string::npos);
  EXPECT_NE(json.find("\"packets\": 0,"), std::string::npos);
  EXPECT_EQ(json.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::outlets
