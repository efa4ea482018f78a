// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/arguments/clock_option.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

namespace pitwall::io {
namespace {

TEST(ClockOption, OnlyASimulationGoesByTheTimeOfABench) {
  EXPECT_NO_THROW(check_clock("wall", false));
  EXPECT_NO_THROW(check_clock("wall", true));
  EXPECT_NO_THROW(check_clock("/dev/shm/t", true));
  EXPECT_THROW(check_clock("/dev/shm/t", false), CLI::ValidationError);
}

TEST(ClockOption, IsReadAndKeptWhereNothingIsSaid) {
  std::string clock = "wall";
  CLI::App app{"test"};
  add_clock(app, clock);
  const char* const nothing[] = {"test"};
  app.parse(1, nothing);
  EXPECT_EQ(clock, "wall");
  const char* const words[] = {"test", "--clock", "/dev/shm/t"};
  app.parse(3, words);
  EXPECT_EQ(clock, "/dev/shm/t");
}

}  // namespace
}  // namespace pitwall::io
