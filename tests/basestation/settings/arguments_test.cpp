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
             "128", "--judgement", "wall.yaml", "--joystick", "/dev/x", "--stamp-file", "s"});
  const auto* const arguments = std::get_if<Arguments>(&parsed);
  ASSERT_NE(arguments, nullptr);
  EXPECT_EQ(arguments->listen.size(), 2u);
  EXPECT_EQ(arguments->web_port, 0);
  EXPECT_EQ(arguments->budget_kbit, 128.0);
  EXPECT_EQ(arguments->judgement_file, "wall.yaml");
  EXPECT_EQ(arguments->joystick, "/dev/x");
  EXPECT_EQ(arguments->stamp_file, "s");
}

TEST(Arguments, NothingIsNothing) {
  const auto parsed = parse({});
  const auto* const arguments = std::get_if<Arguments>(&parsed);
  ASSERT_NE(arguments, nullptr);
  EXPECT_FALSE(arguments->web_port);
  EXPECT_TRUE(arguments->keys.empty());
  EXPECT_TRUE(arguments->stamp_file.empty());
}

TEST(Arguments, KeysAreForABenchOnlyWhereThatIsAskedFor) {
  for (const bool bench : {false, true}) {
    std::vector<const char*> words{"keygen", "--out", "keys"};
    if (bench) words.push_back("--bench");
    const auto parsed = parse(words);
    const auto* const arguments = std::get_if<Arguments>(&parsed);
    ASSERT_NE(arguments, nullptr);
    EXPECT_EQ(arguments->keygen_folder, "keys");
    EXPECT_EQ(arguments->keygen_bench, bench);
  }
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
                                                {"--cars", "c", "--stamp-file", "s"},
                                                {"--record", "r", "--cars", "c"},
                                                {"--cars", "c", "--replay", "r"}}) {
    const auto parsed = parse(words);
    const auto* const leave = std::get_if<Leave>(&parsed);
    ASSERT_NE(leave, nullptr) << words.front();
    EXPECT_EQ(leave->code, 2) << words.front();
    EXPECT_FALSE(leave->message.empty()) << words.front();
  }
}

TEST(Arguments, HelpIsNoMistake) {
  testing::internal::CaptureStdout();
  const auto parsed = parse({"--help"});
  EXPECT_NE(testing::internal::GetCapturedStdout().find("--judgement"), std::string::npos);
  const auto* const leave = std::get_if<Leave>(&parsed);
  ASSERT_NE(leave, nullptr);
  EXPECT_EQ(leave->code, 0);
  EXPECT_TRUE(leave->message.empty());
}

TEST(Arguments, OfRosHaveDefaultsAndBounds) {
  const auto plain = parse({"--ros"});
  const auto* const a = std::get_if<Arguments>(&plain);
  ASSERT_NE(a, nullptr);
  EXPECT_TRUE(a->ros);
  EXPECT_EQ(a->ros_domain, 0);
  EXPECT_EQ(a->ros_distribution, "jazzy");
  EXPECT_EQ(a->ros_interface, "127.0.0.1") << "nobody else is reached without being asked for";
  const auto all = parse({"--ros", "--ros-domain", "42", "--ros-distro", "humble",
                          "--ros-interface", "10.0.0.5", "--ros-peer", "10.0.0.7"});
  const auto* const b = std::get_if<Arguments>(&all);
  ASSERT_NE(b, nullptr);
  EXPECT_EQ(b->ros_domain, 42);
  EXPECT_EQ(b->ros_distribution, "humble");
  EXPECT_EQ(b->ros_interface, "10.0.0.5");
  EXPECT_EQ(b->ros_peers, std::vector<std::string>{"10.0.0.7"});
  for (const std::vector<const char*>& wrong : {std::vector{"--ros-domain", "102"},
                                                {"--ros-distro", "noetic"},
                                                {"--ros-interface", "wlan0"},
                                                {"--ros-peer", "car7"},
                                                {"--ros", "--replay", "folder"}})
    EXPECT_TRUE(std::holds_alternative<Leave>(parse(wrong))) << wrong[0];
  const auto package = parse({"export", "ros", "--out", "folder"});
  ASSERT_TRUE(std::holds_alternative<Arguments>(package));
  EXPECT_EQ(std::get<Arguments>(package).export_kind, "ros");
  EXPECT_EQ(std::get<Arguments>(package).export_folder, "folder");
  EXPECT_TRUE(export_kinds().ends_with(", ros"));
}

}  // namespace
}  // namespace pitwall::settings
