// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/arguments/receiver_link.hpp"

#include <gtest/gtest.h>

namespace pitwall::io {
namespace {

TEST(ReceiverLink, WhatWasReadIsWrittenTheSame) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"udp:23501", "udp:127.0.0.1:23501"},
      {"udp:0.0.0.0:23501", "udp:0.0.0.0:23501"},
      {"tcp:192.168.1.20:3001", "tcp:192.168.1.20:3001"},
      {"serial:/dev/ttyUSB0", "serial:/dev/ttyUSB0:460800"},
      {"serial:/dev/serial/by-id/usb-0:1.2:921600", "serial:/dev/serial/by-id/usb-0:1.2:921600"}};
  for (const auto& [text, whole] : cases) {
    const auto link = parse_receiver_link(text);
    ASSERT_TRUE(link) << text << " " << to_string(link.error());
    EXPECT_EQ(to_string(*link), whole);
    const auto again = parse_receiver_link(whole);
    ASSERT_TRUE(again) << whole;
    EXPECT_EQ(to_string(*again), whole);
  }
}

TEST(ReceiverLink, WhatMakesNoSenseIsQuoted) {
  for (const char* text :
       {"", "udp", "udp:", "tcp:", "udp:x", "udp:70000", "udp:0", "tcp:1.2.3:4", "tcp:a.b:4",
        "serial:", "serial:ttyS0", "serial:/dev/ttyS0:", "serial:/dev/ttyS0:9601", "UDP:1"}) {
    const auto link = parse_receiver_link(text);
    ASSERT_FALSE(link) << text;
    EXPECT_EQ(link.error().place, text);
    EXPECT_FALSE(link.error().what.empty());
  }
}

}  // namespace
}  // namespace pitwall::io
