// Comparison of our ROS 2 messages with Foxglove's decoders: definition, bytes and values must
// agree.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

#include "tests/support/oracle_node.hpp"

namespace pitwall::testing {

class RosOracle {
 public:
  // `output`: the message as JSON; a number that is NaN is the string "NaN".
  void add(std::string_view type, std::string text, std::span<const std::uint8_t> bytes,
           std::string_view output) {
    for (std::size_t at = 0; (at = text.find('\n', at)) != text.npos; at += 2)
      text.replace(at, 1, "\\n");
    lines_ += R"({"type":")" + std::string(type) + R"(","text":")" + text + R"(","bytes":")";
    for (const std::uint8_t byte : bytes) {
      lines_ += "0123456789abcdef"[byte / 16];
      lines_ += "0123456789abcdef"[byte % 16];
    }
    lines_ += R"(","said":)" + std::string(output) + "}\n";
    ++messages_;
  }

  void expect_agreement() const {
    const auto file = std::filesystem::temp_directory_path() /
                      ("pitwall-ros-" + std::to_string(getpid()) + ".jsonl");
    std::ofstream{file} << lines_;
    EXPECT_GT(messages_, 0U);
    EXPECT_EQ(node("check_ros.mjs", "'" + file.string() + "'"),
              std::to_string(messages_) + " messages agree\n");
    if (!::testing::Test::HasFailure()) std::filesystem::remove(file);
  }

 private:
  std::string lines_;
  std::size_t messages_ = 0;
};

}  // namespace pitwall::testing
