// Runner of the independent readers and writers in tests/support/oracles.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

namespace pitwall::testing {

inline const std::filesystem::path kOracles =
    std::filesystem::path{PITWALL_SOURCE_DIR} / "tests/support/oracles";

#define NEEDS_ORACLES()                                                                          \
  ASSERT_TRUE(std::filesystem::exists(::pitwall::testing::kOracles / "node_modules/@mcap/core")) \
      << "the npm packages in " << ::pitwall::testing::kOracles                                  \
      << " are not installed (./pitwall setup)"

// Standard output of a program; a failure of the program fails the test.
inline std::string output_of(const std::string& command) {
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  EXPECT_NE(pipe, nullptr);
  std::array<char, 4096> piece{};
  for (std::size_t got; (got = std::fread(piece.data(), 1, piece.size(), pipe)) > 0;) {
    text.append(piece.data(), got);
  }
  EXPECT_EQ(pclose(pipe), 0) << command;
  return text;
}

inline std::string node(const std::string& script, const std::string& arguments) {
  return output_of("'" + (kOracles / "node_modules/.bin/node").string() + "' '" +
                   (kOracles / script).string() + "' " + arguments);
}

}  // namespace pitwall::testing
