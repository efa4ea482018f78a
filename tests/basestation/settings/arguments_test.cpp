// SPDX-License-Identifier: Apache-2.0
#include "basestation/settings/arguments.hpp"

#include <gtest/gtest.h>

namespace pitwall::settings {
namespace {

std::variant<Arguments, Leave> parse(std::vector<const char*> words) {
  words.insert(words.begin(), "pitwall-base");
  return parse_arguments(static_cast<int>(words.size()), words.data());
}

TEST(Arguments, WhatIsAskedForIsHad) {
  const auto parsed =
      parse({"--keys", "k", "--listen", "127.0.0.1:1", "127.0.0.1:2", "--web", "0", "--budget",
             "128", "--judgement", "wall.yaml", "--joystick", "/dev/x"});
  const auto* const arguments = std::get_if<Arguments>(&parsed);
  ASSERT_NE(arguments, nullptr);
  EXPECT_EQ(arguments->listen.size(), 2u);
  EXPECT_EQ(arguments->web_port, 0);
  EXPECT_EQ(arguments->budget_kbit, 128.0);
  EXPECT_EQ(arguments->judgement_file, "wall.yaml");
  EXPECT_EQ(arguments->joystick, "/dev/x");
}

TEST(Arguments, NothingIsNothing) {
  const auto parsed = parse({});
  const auto* const arguments = std::get_if<Arguments>(&parsed);
  ASSERT_NE(arguments, nullptr);
  EXPECT_FALSE(arguments->web_port);
  EXPECT_TRUE(arguments->keys.empty());
}

TEST(Arguments, MistakesAreTheCallersExitCode) {
  for (const std::vector<const char*>& words : {std::vector{"--fly"},
                                                {"--web", "65536"},
                                                {"--web", "-1"},
                                                {"--budget", "63"},
                                                {"--refresh", "0"},
                                                {"--duration", "nan"},
                                                {"--default-role", "king"},
                                                {"--car", "256"},
                                                {"--cars", "c", "--keys", "k"},
                                                {"--record", "r", "--cars", "c"},
                                                {"--cars", "c", "--replay", "r"}}) {
    const auto parsed = parse(words);
    const auto* const leave = std::get_if<Leave>(&parsed);
    ASSERT_NE(leave, nullptr) << words.front();
    EXPECT_EQ(leave->code, 2) << words.front();
    EXPECT_FALSE(leave->said.empty()) << words.front();
  }
}

TEST(Arguments, HelpIsNoMistake) {
  testing::internal::CaptureStdout();
  const auto parsed = parse({"--help"});
  EXPECT_NE(testing::internal::GetCapturedStdout().find("--judgement"), std::string::npos);
  const auto* const leave = std::get_if<Leave>(&parsed);
  ASSERT_NE(leave, nullptr);
  EXPECT_EQ(leave->code, 0);
  EXPECT_TRUE(leave->said.empty());
}

}  // namespace
}  // namespace pitwall::settings
