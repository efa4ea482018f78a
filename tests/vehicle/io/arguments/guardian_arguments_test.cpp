// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/arguments/guardian_arguments.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace pitwall::io {
namespace {

using Words = std::vector<std::string>;

std::variant<GuardianArguments, int> parse_guardian(const Words& words) {
  std::vector<const char*> argv{"pitwall-guardian"};
  for (const std::string& word : words) argv.push_back(word.c_str());
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  auto parsed = parse_guardian_arguments(static_cast<int>(argv.size()), argv.data());
  ::testing::internal::GetCapturedStdout();
  ::testing::internal::GetCapturedStderr();
  return parsed;
}

const Words kAll{"--car",        "a.yaml",  "--can",       "can0",      "--guardian",
                 "pitwall-can0", "--gnss",  "23503,23504", "--summary", "s.json",
                 "--simulation", "--clock", "/dev/shm/t"};

TEST(GuardianArguments, EveryOptionArrives) {
  const auto parsed = parse_guardian(kAll);
  ASSERT_TRUE(std::holds_alternative<GuardianArguments>(parsed));
  const auto& args = std::get<GuardianArguments>(parsed);
  EXPECT_EQ(args.car_file, "a.yaml");
  EXPECT_EQ(args.can_interface, "can0");
  EXPECT_EQ(args.guardian, "pitwall-can0");
  EXPECT_EQ(to_string(args.receivers[0]), "udp:127.0.0.1:23503");
  EXPECT_EQ(to_string(args.receivers[1]), "udp:127.0.0.1:23504");
  EXPECT_EQ(args.summary_file, "s.json");
  EXPECT_EQ(args.clock, "/dev/shm/t");
  EXPECT_TRUE(args.simulation);
}

TEST(GuardianArguments, WhatItCannotDoWithoutIsRequired) {
  for (std::size_t missing = 0; missing < 8; missing += 2) {
    Words words = kAll;
    words.erase(words.begin() + static_cast<std::ptrdiff_t>(missing),
                words.begin() + static_cast<std::ptrdiff_t>(missing) + 2);
    const auto parsed = parse_guardian(words);
    ASSERT_TRUE(std::holds_alternative<int>(parsed)) << kAll[missing];
    EXPECT_EQ(std::get<int>(parsed), 2);
  }
}

TEST(GuardianArguments, OnePortForTwoReceiversIsRefused) {
  Words words = kAll;
  words[7] = "23503,23503";
  EXPECT_TRUE(std::holds_alternative<int>(parse_guardian(words)));
}

}  // namespace
}  // namespace pitwall::io
