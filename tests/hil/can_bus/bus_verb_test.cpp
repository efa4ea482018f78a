// Usage and answers that need no bus; `bus exec` itself is tested in tests/system/vcan.
// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/bus_verb.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "hil/can_bus/guest.hpp"
#include "protocol/transport/can/raw_can_socket.hpp"

namespace pitwall::can_bus {
namespace {

int bus(const std::vector<std::string>& words) { return bus_verb(words); }

TEST(BusVerb, CheckAnswersWithItsExitCode) {
  const bool works = transport::has_can() || !guest_obstacle();
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(bus({"check"}), works ? 0 : 2);
  const std::string output = ::testing::internal::GetCapturedStdout();
  EXPECT_EQ(output.starts_with("CAN: native"), transport::has_can()) << output;
}

TEST(BusVerb, WrongUsageIsTwoAndSaysWhy) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{},
                                                {"fly"},
                                                {"exec"},
                                                {"exec", "--"},
                                                {"hub"},
                                                {"hub", "/no/such/folder/bus"},
                                                {"line"},
                                                {"line", "1"},
                                                {"line", "x", "1"}}) {
    ::testing::internal::CaptureStderr();
    EXPECT_EQ(bus(words), 2);
    EXPECT_NE(::testing::internal::GetCapturedStderr().find("error: "), std::string::npos);
  }
}

TEST(BusVerb, HelpNamesEveryVerb) {
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(bus({"--help"}), 0);
  const std::string output = ::testing::internal::GetCapturedStdout();
  for (const char* verb :
       {"check", "up", "status", "down", "hub", "exec", "--line-udp", "--timeout", "--bitrate",
        "--restart-ms", "--listen-only", "--txqueuelen"})
    EXPECT_NE(output.find(verb), std::string::npos) << verb;
}

}  // namespace
}  // namespace pitwall::can_bus
