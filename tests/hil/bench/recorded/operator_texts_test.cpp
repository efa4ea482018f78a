// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/operator_texts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "basestation/inputs/text_command.hpp"

namespace pitwall::bench {
namespace {

using world::OperatorCommandKind;

pipeline::Inputs no_inputs() {
  static const world::SensorInput none;
  return {.can = {}, .sensors = none, .requests = {}};
}

// Every kind that reaches a tick, as a text that a base station reads.
TEST(OperatorTexts, EveryCommandIsATextThatMeansItAgain) {
  constexpr std::array kKinds{
      std::pair{OperatorCommandKind::kArm, telemetry::CommandType::kArm},
      std::pair{OperatorCommandKind::kReset, telemetry::CommandType::kReset},
      std::pair{OperatorCommandKind::kSpeedLimit, telemetry::CommandType::kSpeedLimit},
      std::pair{OperatorCommandKind::kRaceLine, telemetry::CommandType::kRaceLine},
      std::pair{OperatorCommandKind::kRole, telemetry::CommandType::kRole},
      std::pair{OperatorCommandKind::kTrackFlag, telemetry::CommandType::kTrackFlag},
      std::pair{OperatorCommandKind::kSensorsExcluded, telemetry::CommandType::kSensorsExcluded},
      std::pair{OperatorCommandKind::kFuelEntered, telemetry::CommandType::kFuelEntered}};
  for (const auto& [kind, type] : kKinds) {
    OperatorTexts texts;
    const world::OperatorCommand command{.id = 1, .kind = kind, .argument = 1.0, .expires = {}};
    pipeline::Inputs in = no_inputs();
    in.commands = std::span{&command, 1};
    texts.add(in, seconds(3));
    const auto made = std::move(texts).take();
    ASSERT_EQ(made.size(), 1U);
    EXPECT_EQ(made[0].at, seconds(3));
    const auto read = inputs::parse_text_command(made[0].text);
    ASSERT_TRUE(read) << made[0].text << ": " << to_string(read.error());
    const auto* request = std::get_if<command::Request>(&*read);
    ASSERT_NE(request, nullptr) << made[0].text;
    const auto* issue = std::get_if<command::IssueCommand>(request);
    ASSERT_NE(issue, nullptr) << made[0].text;
    EXPECT_EQ(issue->type, type) << made[0].text;
    EXPECT_TRUE(issue->overriding) << "its day is over: gates do not bar it again";
  }
}

TEST(OperatorTexts, AStopIsSaidOnceAndItsEndIsARelease) {
  OperatorTexts texts;
  const auto at = [&](std::int64_t tick, world::StopRequest stop) {
    pipeline::Inputs in = no_inputs();
    in.operator_inputs.stop = stop;
    texts.add(in, milliseconds(10) * tick);
  };
  at(0, world::StopRequest::kNone);
  at(1, world::StopRequest::kControlled);
  at(2, world::StopRequest::kControlled);
  at(3, world::StopRequest::kEmergency);
  at(4, world::StopRequest::kNone);
  const auto made = std::move(texts).take();
  ASSERT_EQ(made.size(), 3U);
  EXPECT_EQ(made[0].text, "stop controlled");
  EXPECT_EQ(made[0].at, milliseconds(10));
  EXPECT_EQ(made[1].text, "stop emergency");
  EXPECT_EQ(made[2].text, "release because recorded");
  for (const auto& one : made) EXPECT_TRUE(inputs::parse_text_command(one.text)) << one.text;
}

TEST(OperatorTexts, AuthorityIsHeldFromTwoSecondsBeforeToOneAfter) {
  const auto texts =
      with_authority({{seconds(5), "command speed_limit 20"}, {seconds(7), "release"}});
  EXPECT_EQ(texts.front().text, "take 1");
  EXPECT_EQ(texts.front().at, seconds(3));
  EXPECT_EQ(texts.back().at, seconds(8));
  EXPECT_EQ(texts.size(), 2U + 11U);
  EXPECT_TRUE(std::ranges::is_sorted(texts, {}, &scenario::OperatorText::at));
  EXPECT_EQ(with_authority({{seconds(1), "release"}}).front().at, Duration{});
  EXPECT_TRUE(with_authority({}).empty());
}

}  // namespace
}  // namespace pitwall::bench
