// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/report/radio_summary.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/yaml/strict_map.hpp"

namespace pitwall::io {
namespace {

telemetry::LinkReport some_report() {
  telemetry::LinkReport report;
  report.sessions = 1;
  report.association.opened = 2;
  for (std::size_t i = 0; i < telemetry::kRefusals; ++i) report.association.refused[i] = 100 + i;
  report.bad_bodies.fill(3);
  report.bad_records = 4;
  report.slots = 5, report.slots_skipped = 6;
  report.events.events = 7, report.events.dropped = 8;
  report.bulk.delivered = 9;
  report.round_trip = microseconds(10'011);
  report.ledger.received = 12;
  for (std::size_t i = 0; i < telemetry::kOutcomes; ++i) report.ledger.decided[i] = 200 + i;
  for (std::size_t i = 0; i < telemetry::kPaths; ++i) {
    report.paths[i].received = {.received = 20 + i, .lost = 30 + i, .late = 40 + i};
    report.paths[i].received.delay_p99 = microseconds(static_cast<std::int64_t>(50 + i));
    report.paths[i].spent = {.bytes = 60 + i, .packets = 70 + i, .refused = 80 + i};
  }
  return report;
}

// Read by the strict reader, to the last key.
TEST(RadioSummary, IsReadBackWithEveryFigure) {
  for (const std::size_t paths : {std::size_t{1}, telemetry::kPaths}) {
    const auto document = yaml::load_text(radio_json(some_report(), paths), "radio");
    ASSERT_TRUE(document) << to_string(document.error());
    const auto all = yaml::read(*document, [&](yaml::StrictMap& map) {
      const auto is = [](yaml::StrictMap& of, const std::string& key, std::size_t value) {
        EXPECT_EQ(of.integer(key, 0, 1'000'000), static_cast<std::int64_t>(value)) << key;
      };
      is(map, "sessions", 1);
      is(map, "opened", 2);
      is(map, "bad_bodies", 3 * telemetry::kBodyErrors + 4);
      is(map, "slots", 5);
      is(map, "slots_skipped", 6);
      is(map, "events", 7);
      is(map, "events_dropped", 8);
      is(map, "bulk_delivered", 9);
      is(map, "round_trip_us", 10'011);
      yaml::StrictMap refused = map.map("refused"), commands = map.map("commands");
      for (std::size_t i = 0; i < telemetry::kRefusals; ++i)
        is(refused, telemetry::text_of(static_cast<telemetry::Refusal>(i)), 100 + i);
      is(commands, "received", 12);
      for (std::size_t i = 0; i < telemetry::kOutcomes; ++i)
        is(commands, std::string(telemetry::text_of(static_cast<telemetry::Outcome>(i))), 200 + i);
      std::vector<yaml::StrictMap> lanes = map.maps("paths");
      EXPECT_EQ(lanes.size(), paths);
      for (std::size_t i = 0; i < lanes.size(); ++i) {
        is(lanes[i], "received", 20 + i);
        is(lanes[i], "lost", 30 + i);
        is(lanes[i], "late", 40 + i);
        is(lanes[i], "delay_p99_us", 50 + i);
        is(lanes[i], "sent_bytes", 60 + i);
        is(lanes[i], "sent", 70 + i);
        is(lanes[i], "budget_refused", 80 + i);
      }
      return true;
    });
    EXPECT_TRUE(all) << (all ? "" : to_string(all.error()));
  }
}

TEST(RadioSummary, WhatIsNotKnownIsNoTime) {
  telemetry::LinkReport report;
  report.paths[0].received.delay_p99 = microseconds(-3);  // clocks not compared yet
  const std::string text = radio_json(report, 1);
  EXPECT_NE(text.find("\"delay_p99_us\": 0"), std::string::npos) << text;
  EXPECT_NE(text.find("\"round_trip_us\": 0"), std::string::npos) << text;
}

}  // namespace
}  // namespace pitwall::io
