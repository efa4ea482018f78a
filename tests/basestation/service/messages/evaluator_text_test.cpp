// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/messages/evaluator_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pitwall::service {
namespace {

using alarms::AlarmAction;
using alarms::EvaluatorInput;
using alarms::LimitEdit;
using alarms::NoticeAction;
using state::BaseFigures;
using state::Expectations;
using state::LinkFigures;

constexpr Instant kOddTime{seconds(12'345).ns + 678'901'234};

// A text read back gives an input whose text is the same, so every member comes back to the bit.
void expect_back(const EvaluatorInput& input) {
  const std::string text = input_text(input, kOddTime);
  const auto back = read_input_text(text, kOddTime);
  ASSERT_TRUE(back) << text;
  EXPECT_EQ(back->index(), input.index()) << text;
  EXPECT_EQ(input_text(*back, kOddTime), text);
}

// Any double, now and then none.
struct Numbers {
  std::mt19937_64 random{20261122};
  double next() {
    if (random() % 4 == 0) return kUnset;
    return std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 80) - 70);
  }
};

TEST(JudgeText, FiguresComeBackToTheBit) {
  Numbers numbers;
  for (int i = 0; i < 200; ++i) {
    LinkFigures link{.received =
                         kOddTime - Duration{static_cast<std::int64_t>(numbers.random() >> 20U)}};
    if (i % 5 == 0) link.received.reset();
    for (double* value : {&link.down_loss, &link.up_loss, &link.round_trip_ms, &link.jitter_ms,
                          &link.loss_1s, &link.loss_30s, &link.packets_hz, &link.down_kbit_s,
                          &link.down_cap_kbit_s, &link.up_kbit_s, &link.threats}) {
      *value = numbers.next();
    }
    expect_back(link);
    const auto back = read_input_text(input_text(link, kOddTime), kOddTime);
    EXPECT_EQ(std::get<LinkFigures>(*back).received, link.received);
    EXPECT_EQ(std::isnan(std::get<LinkFigures>(*back).threats), std::isnan(link.threats));
    expect_back(BaseFigures{.disk_minutes = numbers.next(),
                            .recording = numbers.next(),
                            .recorder_lost = numbers.next(),
                            .recorder_kbyte_s = numbers.next(),
                            .clock_offset_ms = numbers.next(),
                            .joystick_lost = i % 2 == 0,
                            .authority_lost = i % 3 == 0,
                            .schema_differs = i % 5 == 0,
                            .settings_unreadable = i % 7 == 0});
    expect_back(Expectations{.round_speed_mps = numbers.next(), .track_flag = numbers.next()});
  }
}

TEST(JudgeText, ActsComeBack) {
  const AlarmAction act{.kind = AlarmAction::Kind::kShelve,
                        .alarm = 4'000'000'000U - 1,
                        .length = seconds(300),
                        .by = "A \"quoted\" name\n",
                        .reason = "known"};
  EXPECT_EQ(std::get<AlarmAction>(*read_input_text(input_text(act, kOddTime), kOddTime)), act);
  const NoticeAction notice{.notice = 7, .reported = true, .by = "B"};
  EXPECT_EQ(std::get<NoticeAction>(*read_input_text(input_text(notice, kOddTime), kOddTime)),
            notice);
  for (const auto kind :
       {AlarmAction::Kind::kAcknowledge, AlarmAction::Kind::kUnshelve, AlarmAction::Kind::kReset}) {
    const AlarmAction other{.kind = kind, .alarm = 3, .by = "C", .reason = {}};
    EXPECT_EQ(std::get<AlarmAction>(*read_input_text(input_text(other, kOddTime), kOddTime)),
              other);
  }
}

TEST(JudgeText, EditsComeBack) {
  const LimitEdit limit{.field = state::field_id("flags.track"),
                        .limit = {.warning_low = 0.1, .bad_values = ~std::uint64_t{0}},
                        .author = "A",
                        .reason = "short track"};
  const auto back = std::get<LimitEdit>(*read_input_text(input_text(limit, kOddTime), kOddTime));
  EXPECT_EQ(back.field, limit.field);
  EXPECT_EQ(back.author, limit.author);
  EXPECT_EQ(back.limit.bad_values, limit.limit.bad_values);
  expect_back(limit);
  const alarms::AlarmEdit alarm{.key = std::string{alarms::alarm_row(3).key},
                                .setting = {.priority = alarms::Priority::kHigh,
                                            .limit = 1.0 / 3.0,
                                            .deadband = 0.1,
                                            .on_delay = milliseconds(30),
                                            .off_delay = seconds(2)},
                                .author = "A",
                                .reason = ""};
  const auto alarm_back =
      std::get<alarms::AlarmEdit>(*read_input_text(input_text(alarm, kOddTime), kOddTime));
  EXPECT_EQ(alarm_back.key, alarm.key);
  EXPECT_EQ(alarm_back.setting, alarm.setting);
}

TEST(JudgeText, SettingsInForceComeBack) {
  alarms::Evaluator evaluator;
  alarms::AlarmSetting setting = alarms::default_setting(0);
  setting.limit = 0.7;
  setting.priority = alarms::Priority::kHigh;
  ASSERT_TRUE(evaluator.edit(alarms::AlarmEdit{.key = std::string{alarms::alarm_row(0).key},
                                               .setting = setting,
                                               .author = "A",
                                               .reason = "test"}));
  const auto back = read_judge_text(judge_text(evaluator, true, kOddTime));
  ASSERT_TRUE(back) << to_string(back.error());
  EXPECT_TRUE(back->begins);
  EXPECT_EQ(back->config.alarms.version(), evaluator.alarms().settings().version());
  EXPECT_FALSE(read_judge_text(judge_text(evaluator, false, kOddTime))->begins);
}

TEST(JudgeText, WhatIsNoInputIsRefused) {
  for (const char* text : {"", "{", "[]", "{}", R"({"what": "nothing"})",
                           R"({"what": "limit", "field": "no.such"})"}) {
    EXPECT_FALSE(read_input_text(text, kOddTime)) << text;
  }
  EXPECT_FALSE(read_judge_text(R"({"settings": "version: 2"})"));
}

}  // namespace
}  // namespace pitwall::service
