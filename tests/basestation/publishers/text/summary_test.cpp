// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/text/summary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "protocol/telemetry/delivery/event_content.hpp"
#include "tests/basestation/radio_rig.hpp"

namespace pitwall::publishers {
namespace {

using telemetry::field;

std::string summary(RadioRig& rig) { return json_summary(*rig.base, rig.now); }

TEST(Summary, SaysWhatWasHeardAndSaid) {
  RadioRig rig;
  rig.set(field("mode.stop_latch"), 0.0);
  rig.set(field("ego.x"), 10.0);
  rig.set(field("track.station"), 450.0);
  rig.run(seconds(3));
  ASSERT_TRUE(rig.execute("take 1"));
  rig.run(milliseconds(100));
  ASSERT_TRUE(rig.execute("command arm arm because of a test"));
  rig.car->log(telemetry::make_event(telemetry::TextEvent{"a \"quote\""}, rig.now));
  rig.run(milliseconds(100));
  const std::string json = summary(rig);
  for (const char* part :
       {"\"source\": \"car\"", "\"car\": \"received\"", "\"lost\": 0,", "\"refused\": 0,",
        "\"forged\": 0", "\"sessions\": 1,", "\"clock\": {\"known\": true, \"round_trip_ms\": ",
        "\"health\": {\"p50\": null,", "\"motion\": {\"p50\": ", "\"command\": \"arm \\\"arm\\\"\"",
        "\"fate\": null", "\"event\": \"a \\\"quote\\\"\"", "\"loss_by_place_m\": {\"400\": 0}",
        "\"ego.x\": {\"unit\": \"m\", \"quality\": \"fresh\", \"value\": 10, \"age_ms\": ",
        "\"ego.y\": {\"unit\": \"m\", \"quality\": \"never\", \"value\": null}"}) {
    EXPECT_NE(json.find(part), std::string::npos) << part << "\n" << json.substr(0, 6'000);
  }
  EXPECT_EQ(json.find("stop.level"), std::string::npos) << "what goes up is no field of the car";
  rig.now += seconds(2);
  EXPECT_NE(summary(rig).find("\"car\": \"lost\""), std::string::npos);
  EXPECT_EQ(std::count(json.begin(), json.end(), '{'), std::count(json.begin(), json.end(), '}'));
}

TEST(Summary, SaysForHowLongBenchTimeStood) {
  RadioRig rig;
  EXPECT_NE(summary(rig).find("\"bench_time\": null,"), std::string::npos);
  const transport::BenchPause pause{.now = {}, .total = milliseconds(1'250)};
  EXPECT_NE(json_summary(*rig.base, rig.now, pause).find("\"bench_time\": {\"stood_s\": 1.25},"),
            std::string::npos);
}

TEST(Summary, OfNothingIsStillADocument) {
  RadioRig rig;
  const std::string json = summary(rig);
  EXPECT_NE(json.find("\"car\": \"not received yet\""), std::string::npos);
  EXPECT_NE(json.find("\"source\": \"none\""), std::string::npos);
  EXPECT_NE(json.find("\"packets\": 0,"), std::string::npos);
  EXPECT_NE(json.find("\"round_trip_ms\": null"), std::string::npos);
  EXPECT_EQ(json.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::publishers
