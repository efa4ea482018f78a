// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/messages/lap_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "protocol/json/json_value.hpp"

namespace pitwall::service {
namespace {

TEST(LapText, SaysOfEachLapWhatIsKnown) {
  state::LapLog log{1'000.0};
  telemetry::Snapshot state;
  telemetry::GroupSet groups;
  groups.add(telemetry::Group::kTrack);
  // 40 m/s from the station 500 on: a lap of 25 s begins after 12.5 s.
  for (int i = 0; i <= 450; ++i) {
    state.at(telemetry::Group::kTrack) = Instant{seconds(100).ns} + i * milliseconds(100);
    state.values[telemetry::field("track.station")] = std::fmod(500.0 + 4.0 * i, 1'000.0);
    state.values[telemetry::field("track.lap")] = 3.0;
    log.note(state, groups);
  }
  const std::string text = laps_text(log);
  const auto json = json::JsonValue::parse(text, "laps");
  ASSERT_TRUE(json);
  EXPECT_EQ(json->text("type"), "laps");
  EXPECT_EQ(json->number("length_m"), 1'000.0);
  EXPECT_EQ(json->number("step_m"), 5.0);
  EXPECT_EQ(json->number("best"), 2.0);
  const auto laps = json->items("laps");
  ASSERT_EQ(laps.size(), 3U);
  EXPECT_TRUE(laps[0].find("time_s")->is_null());
  EXPECT_EQ(laps[0].number("begin_ms"), 100'000.0);
  EXPECT_NEAR(laps[1].number("time_s"), 25.0, 1e-6);
  EXPECT_EQ(laps[1].number("number"), 3.0);
  EXPECT_TRUE(laps[2].find("end_ms")->is_null());
  EXPECT_NE(text.find("\"start_seen\": false"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::service
