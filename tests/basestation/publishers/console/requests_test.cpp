// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/console/requests.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pitwall::publishers::console {
namespace {

template <class Ask>
Ask parsed(const std::string& text) {
  const auto request = parse_request(text);
  EXPECT_TRUE(request) << text << " " << (request ? "" : to_string(request.error()));
  const Ask* ask = nullptr;
  if constexpr (requires { command::Request{Ask{}}; }) {
    const auto* const of_car = request ? std::get_if<command::Request>(&*request) : nullptr;
    ask = of_car != nullptr ? std::get_if<Ask>(of_car) : nullptr;
  } else {
    ask = request ? std::get_if<Ask>(&*request) : nullptr;
  }
  EXPECT_NE(ask, nullptr) << text;
  return ask != nullptr ? *ask : Ask{};
}

std::string refused(const std::string& text) {
  const auto request = parse_request(text);
  EXPECT_FALSE(request) << text;
  return request ? "" : request.error().place;
}

TEST(Requests, AreReadAsTheProtocolHasThem) {
  const auto history =
      parsed<AskHistory>(R"({"type":"history","field":16384,"from_s":60,"to_s":0.5,"points":500})");
  EXPECT_EQ(history.field, 16384);
  EXPECT_EQ(history.to_s, 0.5);
  EXPECT_EQ(history.points, 500u);
  EXPECT_EQ(parsed<AskLap>(R"({"type":"lap","lap":12})").lap, 12U);
  EXPECT_EQ(parsed<command::AcknowledgeAlarms>(R"({"type":"ack","all":[1,2]})").alarms.size(), 2u);
  EXPECT_EQ(parsed<command::AcknowledgeAlarms>(R"({"type":"ack","alarm":7})").alarms[0], 7u);
  EXPECT_EQ(parsed<command::ShelveAlarm>(R"({"type":"shelve","alarm":7,"minutes":5,"reason":"x"})")
                .length,
            seconds(300));
  EXPECT_EQ(parsed<command::Stop>(R"({"type":"stop","kind":"emergency"})").level,
            telemetry::StopLevel::kEmergency);
  EXPECT_EQ(parsed<command::ClaimAuthority>(R"({"type":"authority","do":"grant"})").claim,
            command::Claim::kGrant);
  EXPECT_EQ(parsed<command::StageCommand>(R"({"type":"stage","name":"speed limit","argument":30})")
                .argument,
            30);
  const auto send = parsed<AskSend>(
      R"({"type":"send","ticket":3,"override":{"reason":"dry","token":"8f2c41d09b7a4d51"}})");
  EXPECT_TRUE(send.overrides);
  EXPECT_EQ(send.reason, "dry");
  EXPECT_FALSE(parsed<AskSend>(R"({"type":"send","ticket":3,"override":null})").overrides);
  EXPECT_TRUE(
      parsed<command::AnswerNotice>(R"({"type":"notice","id":1,"do":"reported"})").reported);
  parsed<command::ReleaseStop>(R"({"type":"release_stop"})");
  const auto release =
      parsed<command::Recover>(R"({"type":"recover","step":"release","challenge":4711})");
  EXPECT_EQ(release.step, command::RecoveryStep::kRelease);
  EXPECT_EQ(release.challenge, 4711.0);
  const auto arm = parsed<command::Recover>(R"({"type":"recover","step":"arm"})");
  EXPECT_EQ(arm.step, command::RecoveryStep::kArm);
  EXPECT_FALSE(arm.challenge);
  parsed<command::CancelTicket>(R"({"type":"cancel","ticket":1})");
  parsed<AskMark>(R"({"type":"mark","text":"here"})");
  EXPECT_EQ(parsed<AskPing>(R"({"type":"ping","at":1795309899172.4458})").at, 1795309899172.4458);
}

TEST(Requests, WhatPeopleSetIsReadWhole) {
  EXPECT_EQ(parsed<command::ExpectRoundSpeed>(R"({"type":"expect","round_speed":51.4})").speed_mps,
            51.4);
  EXPECT_FALSE(
      parsed<command::ExpectRoundSpeed>(R"({"type":"expect","round_speed":null})").speed_mps);
  EXPECT_EQ(parsed<command::ReportFuel>(R"({"type":"fuel_loaded","litres":40})").litres, 40.0);
  const auto alarm = parsed<command::EditAlarm>(
      R"({"type":"edit_alarm","key":"wheel_slip","priority":"high","limit":0.1,"deadband":0.02,)"
      R"("on_s":0.2,"off_s":1,"reason":"new tyres"})");
  EXPECT_EQ(alarm.edit.setting.on_delay, milliseconds(200));
  EXPECT_EQ(alarm.reason, "new tyres");
  const auto limit = parsed<command::EditLimit>(
      R"({"type":"edit_limit","field":"electric.battery","bad_low":11,"warning_low":null,)"
      R"("reason":"old one"})");
  EXPECT_EQ(limit.edit.limit.bad_low, 11.0);
  EXPECT_TRUE(std::isnan(limit.edit.limit.warning_low));
  EXPECT_FALSE(limit.warning_values || limit.bad_values);
  const auto sets = parsed<command::EditLimit>(
      R"({"type":"edit_limit","field":"mode.mode","warning_values":[],"bad_values":[3,4,63],)"
      R"("reason":"x"})");
  EXPECT_EQ(sets.warning_values, 0U);
  EXPECT_EQ(sets.bad_values, std::uint64_t{1} << 63 | 1U << 4 | 1U << 3);
  for (const std::string set : {R"("3")", "3", "{}", "true", "[64]", "[-1]", "[0.5]", R"(["3"])"}) {
    EXPECT_EQ(refused(R"({"type":"edit_limit","field":"mode.mode","bad_values":)" + set + "}"),
              "edit_limit.bad_values")
        << set;
  }
  EXPECT_EQ(parsed<command::EditBudget>(R"({"type":"edit_budget","up_kbit_s":128,"reason":"x"})")
                .up_kbit_s,
            128.0);
  EXPECT_EQ(refused(R"({"type":"expect","round_speed":-1})"), "expect.round_speed");
  EXPECT_EQ(refused(R"({"type":"expect","round_speed":"115"})"), "expect.round_speed");
  EXPECT_EQ(refused(R"({"type":"fuel_loaded"})"), "fuel_loaded.litres");
  EXPECT_EQ(refused(R"({"type":"edit_limit","field":"ego.z","reason":"x"})"), "edit_limit.field");
  EXPECT_EQ(refused(R"({"type":"edit_limit","field":"electric.battery","bad_low":"1"})"),
            "edit_limit.bad_low");
  EXPECT_EQ(refused(R"({"type":"edit_budget","up_kbit_s":128,"reason":""})"), "edit_budget.reason");
}

TEST(Requests, AWishForTheBench) {
  const auto start = parsed<AskBench>(
      R"({"type":"bench","do":"start","scenario":"faults/x","mode":"live","seed":7})");
  EXPECT_TRUE(start.run_request.start);
  EXPECT_EQ(start.run_request.scenario, "faults/x");
  EXPECT_TRUE(start.run_request.live);
  EXPECT_EQ(start.run_request.seed, 7U);
  EXPECT_FALSE(parsed<AskBench>(R"({"type":"bench","do":"start","scenario":"x","mode":"lockstep",
    "seed":null})")
                   .run_request.seed);
  EXPECT_FALSE(parsed<AskBench>(R"({"type":"bench","do":"stop"})").run_request.start);
  EXPECT_EQ(refused(R"({"type":"bench"})"), "bench.do");
  EXPECT_EQ(refused(R"({"type":"bench","do":"start","mode":"live"})"), "bench.scenario");
  EXPECT_EQ(refused(R"({"type":"bench","do":"start","scenario":"x"})"), "bench.mode");
  for (const char* seed : {"-1", "1.5", "\"7\"", "1000000001"})
    EXPECT_EQ(refused(std::string{R"({"type":"bench","do":"start","scenario":"x","mode":"live",)"} +
                      "\"seed\":" + seed + "}"),
              "bench.seed");
  EXPECT_EQ(role_for(AskBench{}), Role::kOperator);
}

TEST(Requests, AMistakeIsNamedByItsMember) {
  EXPECT_EQ(refused("{"), "text:byte 1");
  EXPECT_EQ(refused("[]"), "type");
  EXPECT_EQ(refused(R"({"type":"fly"})"), "type");
  EXPECT_EQ(refused(R"({"type":"stop"})"), "stop.kind");
  EXPECT_EQ(refused(R"({"type":"stop","kind":"gently"})"), "stop.kind");
  EXPECT_EQ(refused(R"({"type":"lap","lap":-1})"), "lap.lap");
  EXPECT_EQ(refused(R"({"type":"history","field":1.5,"from_s":1,"to_s":0,"points":1})"),
            "history.field");
  EXPECT_EQ(refused(R"({"type":"history","field":1,"from_s":1,"to_s":2,"points":1})"),
            "history.to_s");
  EXPECT_EQ(refused(R"({"type":"history","field":1,"from_s":1,"to_s":0,"points":20001})"),
            "history.points");
  EXPECT_EQ(refused(R"({"type":"history","field":-1,"from_s":1,"to_s":0,"points":1})"),
            "history.field");
  EXPECT_EQ(refused(R"({"type":"shelve","alarm":7,"minutes":11,"reason":"x"})"), "shelve.minutes");
  EXPECT_EQ(refused(R"({"type":"shelve","alarm":7,"minutes":1,"reason":""})"), "shelve.reason");
  EXPECT_EQ(refused(R"({"type":"ack","all":[1,"2"]})"), "ack.all");
  EXPECT_EQ(refused(R"({"type":"stage","name":"arm","argument":"1"})"), "stage.argument");
  EXPECT_EQ(refused(R"({"type":"stage","name":"arm","argument":1e300})"), "stage.argument");
  EXPECT_EQ(refused(R"({"type":"authority","do":"steal"})"), "authority.do");
  EXPECT_EQ(refused(R"({"type":"stage","name":"fly","argument":1})"), "stage.name");
  EXPECT_EQ(refused(R"({"type":"send","ticket":1,"override":{"reason":""}})"),
            "send.override.reason");
}

TEST(Requests, OnlyLookingTakesNoOperator) {
  EXPECT_EQ(role_for(AskHistory{}), Role::kViewer);
  EXPECT_EQ(role_for(AskPing{}), Role::kViewer);
  EXPECT_EQ(role_for(AskMark{}), Role::kViewer);
  EXPECT_EQ(role_for(command::Request{command::Stop{}}), Role::kOperator);
  EXPECT_EQ(role_for(command::Request{command::ClaimAuthority{}}), Role::kOperator);
  EXPECT_EQ(role_for(command::Request{command::AnswerNotice{}}), Role::kOperator);
  EXPECT_EQ(role_for(command::Request{command::ReportFuel{}}), Role::kOperator);
  EXPECT_EQ(role_for(command::Request{command::EditLimit{}}), Role::kOperator);
}

// Whatever comes, there is an answer; what was changed by one byte is rarely still a request.
TEST(Requests, DamagedTextsAreAnswered) {
  std::mt19937 random(11);
  const std::string good = R"({"type":"history","field":3,"from_s":60,"to_s":0,"points":500})";
  for (int round = 0; round < 20'000; ++round) {
    std::string text = good;
    for (auto changes = 1 + random() % 3; changes > 0; --changes) {
      text[random() % text.size()] = static_cast<char>(random() % 256);
    }
    if (random() % 4 == 0) text.resize(random() % text.size());
    const auto request = parse_request(text);
    if (!request) {
      EXPECT_FALSE(request.error().what.empty());
    } else if (const auto* ask = std::get_if<AskHistory>(&*request)) {
      EXPECT_LE(ask->points, kPointsMax);
      EXPECT_LE(ask->to_s, ask->from_s);
    }
  }
}

}  // namespace
}  // namespace pitwall::publishers::console
