// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/bus_options.hpp"

#include <gtest/gtest.h>

namespace pitwall::can_bus {
namespace {

using Words = std::vector<std::string>;

TEST(BusOptions, EveryOptionIsUnderstood) {
  const Words words{"--guest",    "--interface", "vcan0", "--interface", "can_b.1", "--timeout",
                    "2.5",        "--memory",    "256",   "--line-udp",  "1:2:3:4", "--clock",
                    "/dev/shm/t", "--",          "cmd",   "--guest",     "--"};
  const auto options = parse_bus_exec(words);
  ASSERT_TRUE(options.has_value()) << to_string(options.error());
  EXPECT_EQ(options->place, BusPlace::kGuest);
  EXPECT_EQ(options->interfaces, (Words{"vcan0", "can_b.1"}));
  EXPECT_EQ(options->timeout, milliseconds(2'500));
  EXPECT_EQ(options->memory_mib, 256);
  ASSERT_TRUE(options->line.has_value());
  EXPECT_EQ(options->line->guest_destination, 4);
  EXPECT_EQ(options->clock, "/dev/shm/t");
  EXPECT_EQ(options->command, (Words{"cmd", "--guest", "--"}));  // the rest is the command's own
}

TEST(BusOptions, DefaultsAreVcan0WithoutLimit) {
  const auto options = parse_bus_exec(Words{"--", "true"});
  ASSERT_TRUE(options.has_value());
  EXPECT_EQ(options->place, BusPlace::kAuto);
  EXPECT_EQ(options->interfaces, Words{"vcan0"});
  EXPECT_FALSE(options->timeout.has_value());
  EXPECT_FALSE(options->line.has_value());
}

TEST(BusOptions, WhatDoesNotFitIsNamed) {
  const std::vector<std::pair<Words, std::string>> cases{
      {{}, "bus exec"},
      {{"--"}, "bus exec"},
      {{"true"}, "true"},
      {{"--what", "1", "--", "true"}, "--what"},
      {{"--timeout", "--", "true"}, "--timeout"},
      {{"--timeout", "0", "--", "true"}, "0"},
      {{"--timeout", "-3", "--", "true"}, "-3"},
      {{"--timeout", "nan", "--", "true"}, "nan"},
      {{"--timeout", "5s", "--", "true"}, "5s"},
      {{"--memory", "1", "--", "true"}, "1"},
      {{"--interface", "a b", "--", "true"}, "a b"},
      {{"--interface", "$(id)", "--", "true"}, "$(id)"},
      {{"--interface", "-x", "--", "true"}, "-x"},
      {{"--interface", "sixteen_letters_", "--", "true"}, "sixteen_letters_"},
      {{"--clock", "", "--", "true"}, "--clock"},
      {{"--line-udp", "1:2", "--", "true"}, "1:2"}};
  for (const auto& [words, place] : cases) {
    const auto options = parse_bus_exec(words);
    ASSERT_FALSE(options.has_value()) << place;
    EXPECT_EQ(options.error().place, place);
  }
}

TEST(BusUpOptions, AreReadEachOnItsOwn) {
  const auto plain = parse_bus_up({});
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->interfaces, std::vector<std::string>{"vcan0"});
  EXPECT_FALSE(plain->settings);
  const std::vector<std::string> words{"can0", "--bitrate",    "500000", "--restart-ms", "0",
                                       "can1", "--txqueuelen", "20",     "--listen-only"};
  const auto all = parse_bus_up(words);
  ASSERT_TRUE(all && all->settings);
  EXPECT_EQ(all->interfaces, (std::vector<std::string>{"can0", "can1"}));
  EXPECT_EQ(all->settings->bitrate, 500'000u);
  EXPECT_EQ(all->settings->restart_ms, 0u);
  EXPECT_EQ(all->settings->tx_queue_frames, 20u);
  EXPECT_EQ(all->settings->listen_only, true);
  EXPECT_TRUE(all->settings->up);
}

TEST(BusUpOptions, WhatIsWrongIsNamed) {
  const std::vector<std::vector<std::string>> wrong{
      {"can0", "--bitrate"},       {"can0", "--bitrate", "0"},       {"can0", "--bitrate", "1e6"},
      {"can0", "--bitrate", "-1"}, {"can0", "--restart-ms", "x"},    {"can0", "--txqueuelen", "0"},
      {"can0", "--fly", "1"},      {"--bitrate", "500000"},          {"can0/..", "--listen-only"},
      {"can0", "--restart-ms"},    {"can0", "--restart-ms", "60001"}};
  for (const auto& words : wrong) EXPECT_FALSE(parse_bus_up(words)) << words.back();
}

TEST(BusOptions, AHubTakesAPathWithOrWithoutThePrefix) {
  for (const char* path : {"/tmp/bus", "unix:/tmp/bus"}) {
    const auto options = parse_bus_hub(Words{path, "--seconds", "2.5"});
    ASSERT_TRUE(options) << to_string(options.error());
    EXPECT_EQ(options->bus, "unix:/tmp/bus");
    EXPECT_EQ(options->length, milliseconds(2'500));
  }
  EXPECT_FALSE(parse_bus_hub(Words{"bus"})->length.has_value());
  EXPECT_EQ(parse_bus_hub(Words{"bus"})->clock, "wall");
  EXPECT_EQ(parse_bus_hub(Words{"bus", "--clock", "/dev/shm/t"})->clock, "/dev/shm/t");
  const std::vector<std::pair<Words, std::string>> cases{{{}, "bus hub"},
                                                         {{"--seconds", "1"}, "bus hub"},
                                                         {{"a", "b"}, "b"},
                                                         {{"a", "--what"}, "--what"},
                                                         {{"a", "--seconds"}, "--seconds"},
                                                         {{"a", "--seconds", "0"}, "0"},
                                                         {{"a", "--clock"}, "--clock"},
                                                         {{"a", "--clock", ""}, "--clock"},
                                                         {{"a", "--seconds", "x"}, "x"}};
  for (const auto& [words, place] : cases) {
    const auto options = parse_bus_hub(words);
    ASSERT_FALSE(options);
    EXPECT_EQ(options.error().place, place);
  }
}

}  // namespace
}  // namespace pitwall::can_bus
