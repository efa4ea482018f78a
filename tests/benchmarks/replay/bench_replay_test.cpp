// Bad input is told before anything is started; playing is tested in tests/system/vcan.
// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/replay/bench_replay.hpp"

#include <gtest/gtest.h>

#include "tests/hil/cli/program_run.hpp"

namespace pitwall::benchmarks {

using cli::ProgramOutput;
using cli::ProgramRun;
namespace {

class BenchReplay : public ProgramRun {};

TEST_F(BenchReplay, ALogThatCannotBePlayedIsNamed) {
  expect_refusal({"replay", "--log", path("none.log")}, path("none.log"));
  ASSERT_TRUE(transport::write_file(path("bad.log"), "(1.0) can0 123#11\n(1.1) can0 12#\n"));
  expect_refusal({"replay", "--log", path("bad.log")}, path("bad.log") + ":2:14: error: ");
  ASSERT_TRUE(transport::write_file(path("empty.log"), ""));
  expect_refusal({"replay", "--log", path("empty.log")}, "holds no frames");
  ASSERT_TRUE(transport::write_file(path("long.log"), "(1.0) c 123#\n(700.0) c 123#\n"));
  expect_refusal({"replay", "--log", path("long.log")}, "longer than ten minutes");
}

TEST_F(BenchReplay, WrongUsageIsTold) {
  expect_refusal({"replay", "--runs", "0"}, "--runs");
  expect_refusal({"replay", "--length", "-1"}, "--length");
  expect_refusal({"replay", "--no-such-flag"}, "--no-such-flag");
}

}  // namespace
}  // namespace pitwall::benchmarks
