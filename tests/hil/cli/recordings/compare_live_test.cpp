// A run that is really played is in tests/system/recorded.
// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/compare_live.hpp"

#include <gtest/gtest.h>

#include "tests/hil/bench/recorded/recorded_drive.hpp"
#include "tests/hil/cli/program_run.hpp"

namespace pitwall::cli {
namespace {

class CompareLive : public ProgramRun {};

TEST_F(CompareLive, WrongUsageIsTold) {
  expect_refusal({"compare", "/nowhere", "--live"}, "/nowhere");
  expect_refusal({"compare", "/nowhere", "--interface", "vcan0"}, "--live");
  expect_refusal({"compare", "/nowhere", "--live", "--ignore", "radio"}, "--ignore");
  expect_refusal({"compare", "/nowhere", "--live", "--tolerance", "ego.vx=1"}, "--tolerance");
}

TEST_F(CompareLive, WhatCannotBePlayedIsToldAndABusThatIsNotThereRefused) {
  const ProgramOutput ran = run({"compare", bench::recorded_folder(), "--live", "--interface",
                                 "nocan0", "--out", path("live")});
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("nocan0"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("not played: the guardian drove, or had stopped the car: 10 ticks"),
            std::string::npos)
      << ran.err;
  EXPECT_NE(ran.err.find("not played: the joystick: 40 ticks"), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace pitwall::cli
