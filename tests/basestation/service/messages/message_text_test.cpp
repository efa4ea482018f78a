// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/messages/message_text.hpp"

#include <gtest/gtest.h>

#include "protocol/telemetry/delivery/event_content.hpp"
#include "tests/basestation/publishers/console/json_of.hpp"
#include "tests/basestation/radio_rig.hpp"

namespace pitwall::service {
namespace {

using publishers::console::json_of;

constexpr Instant kNow{seconds(500).ns};

TEST(MessageText, ATicketHasItsGatesItsStepsAndItsReason) {
  command::Ticket ticket;
  ticket.id = 4;
  ticket.command = {.type = telemetry::CommandType::kSpeedLimit, .argument = 40.0, .issuer = 16};
  ticket.by = {.console = 16, .name = "Anna"};
  ticket.step = command::Step::kGated;
  ticket.at[0] = kNow;
  ticket.gates.push_back({.kind = command::GateKind::kTyres,
                          .ok = false,
                          .value = 29.0,
                          .age = milliseconds(120),
                          .known = true,
                          .text = "cold"});
  ticket.gates.push_back({.kind = command::GateKind::kFuel, .text = "not received yet"});
  const auto json = json_of(ticket_text(ticket));
  EXPECT_EQ(json.text("type"), "command");
  EXPECT_EQ(json.text("name"), "speed limit");
  EXPECT_EQ(json.text("step"), "gated");
  EXPECT_EQ(json.items("gates")[0].number("age_ms"), 120.0);
  EXPECT_EQ(json.items("gates")[1].find("age_ms")->text(), "");
  EXPECT_EQ(json.find("times_ms")->number("staged"), 500'000.0);
  EXPECT_EQ(json.find("override")->is_object(), false);
}

TEST(MessageText, AuthorityIsNobodysOrSomebodysWithAnEnd) {
  telemetry::AuthorityRegister authority;
  command::Audit audit;
  command::AuthorityHandover talk(authority, audit);
  EXPECT_EQ(json_of(authority_text(talk, authority, kNow)).number("holder"), 0.0);
  ASSERT_TRUE(talk.take({.console = 16, .name = "Anna"}, kNow));
  ASSERT_TRUE(talk.request({.console = 17, .name = "Bo"}, kNow));
  const auto json = json_of(authority_text(talk, authority, kNow + seconds(1)));
  EXPECT_EQ(json.text("holder_name"), "Anna");
  EXPECT_NEAR(json.number("expires_ms"), 503'000.0, 1.0);
  EXPECT_EQ(json.find("request")->text("name"), "Bo");
  EXPECT_EQ(json.find("request")->number("until_ms"), 505'000.0);
}

TEST(MessageText, AnEventOfTheCarIsAText) {
  const auto json =
      json_of(event_text(telemetry::make_event(telemetry::TextEvent{"a\xFF\"b"}, kNow)));
  EXPECT_EQ(json.text("type"), "event");
  EXPECT_NE(json.text("text").find("\"b"), std::string::npos) << json.text("text");
  EXPECT_EQ(json.text("severity"), "info");
  const auto fault =
      telemetry::make_event(telemetry::FaultEvent{.cause = 3, .begins = true, .value = 1}, kNow);
  EXPECT_EQ(json_of(event_text(fault)).text("severity"), "warning");
  for (const bool begins : {true, false}) {
    const auto threat = telemetry::make_event(telemetry::ThreatEvent{.begins = begins}, kNow);
    EXPECT_EQ(json_of(event_text(threat)).text("severity"), begins ? "warning" : "info");
  }
}

TEST(MessageText, AlarmsFuelAuditNoticesAndMarks) {
  const alarms::Engine engine;
  const auto list = json_of(alarms_text(engine));
  EXPECT_TRUE(list.items("active").empty());
  EXPECT_FALSE(list.find("kpi")->flag("flood"));
  EXPECT_EQ(json_of(alarm_event_text({.number = 1, .at = kNow, .key = "x", .by = {}, .reason = {}}))
                .text("key"),
            "x");
  EXPECT_EQ(
      json_of(audit_text({.number = 1, .at = kNow, .who = "Anna", .what = "y", .result = "z"}))
          .text("who"),
      "Anna");
  EXPECT_EQ(json_of(fuel_text({})).text("text"), "unknown");
  EXPECT_EQ(json_of(mark_text("here", "Anna", kNow)).number("time_ms"), 500'000.0);
  const auto notice =
      json_of(notice_text({.id = 1, .at = kNow, .text = "t", .evidence = "e", .by = ""}));
  EXPECT_EQ(notice.text("kind"), "degraded");
  EXPECT_EQ(notice.text("state"), "draft");
}

TEST(MessageText, AStopHasItsCauseAndTheWayBack) {
  EXPECT_FALSE(json_of(stop_text(std::nullopt)).flag("stopped"));
  command::StoppedCar stopped{.level = "controlled stop", .mode = "halted", .cause = "too long"};
  stopped.by = "Ada";
  stopped.latched = true;
  stopped.challenge = 4711.0;
  stopped.steps[1].possible = true;
  stopped.steps[2].why = "release the stop first";
  auto json = json_of(stop_text(stopped));
  EXPECT_TRUE(json.flag("stopped"));
  EXPECT_EQ(json.text("cause"), "too long");
  EXPECT_EQ(json.number("challenge"), 4711.0);
  EXPECT_EQ(json.find("value")->text(), "") << "no value is no number";
  EXPECT_EQ(json.find("since_ms")->text(), "");
  ASSERT_EQ(json.items("steps").size(), 4u);
  EXPECT_EQ(json.items("steps")[0].text("step"), "release");
  EXPECT_TRUE(json.items("steps")[1].flag("possible"));
  EXPECT_EQ(json.items("steps")[2].text("why"), "release the stop first");
  stopped.since = kNow;
  stopped.value = 1.6;
  json = json_of(stop_text(stopped));
  EXPECT_EQ(json.number("since_ms"), 500'000.0);
  EXPECT_EQ(json.number("value"), 1.6);
}

TEST(MessageText, TheLinkHasBothDirectionsAndEveryGroupOfTheCar) {
  RadioRig rig;
  rig.set(telemetry::field("mode.mode"), 2.0);
  link::LinkMeter meter;
  for (int i = 0; i < 20; ++i) {
    rig.run(milliseconds(100));
    const auto report = rig.station->report(rig.now);
    meter.note(link::count_of(report, rig.station->rate().packets(), rig.station->lost_packets()),
               rig.now, report.round_trip ? report.round_trip->milliseconds() : kUnset);
  }
  const auto report = rig.station->report(rig.now);
  const auto json = json_of(link_text({.report = report,
                                       .meter = meter,
                                       .vehicle = rig.base->vehicle(),
                                       .state = state::LinkState::kGood,
                                       .since = kNow,
                                       .paths = 1},
                                      rig.now));
  EXPECT_EQ(json.text("state"), "good");
  ASSERT_EQ(json.items("paths").size(), 2u);
  const auto& down = json.items("paths")[0].items("windows");
  ASSERT_EQ(down.size(), 3u);
  EXPECT_EQ(down[0].number("loss"), 0.0);
  EXPECT_NEAR(down[0].number("rtt_ms"), 20.0, 3.0);
  EXPECT_GT(json.items("paths")[1].items("windows")[0].number("kbit_s"), 1.0);
  EXPECT_EQ(json.items("groups").size(), telemetry::groups_of(telemetry::Direction::kDown).count());
}

}  // namespace
}  // namespace pitwall::service
