// The benchmark itself runs on real vcan, in tests/system/gateway.
// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/gateway/bench_gateway.hpp"

#include <gtest/gtest.h>

#include "tests/hil/cli/program_run.hpp"

namespace pitwall::benchmarks {

using cli::ProgramOutput;
using cli::ProgramRun;
namespace {

class BenchGateway : public ProgramRun {};

TEST_F(BenchGateway, WrongUsageIsTold) {
  expect_refusal({"gateway", "--seconds", "1"}, "--seconds");
  expect_refusal({"gateway", "--omissions", "-1"}, "--omissions");
  expect_refusal({"gateway", "--figures", path("figures")}, "--start");
  expect_refusal({"gateway", "--no-such-flag"}, "--no-such-flag");
}

TEST_F(BenchGateway, AnInterfaceThatIsNotThereIsTold) {
  expect_refusal({"gateway", "--here", "--interface", "nocan0"}, "nocan0");
}

}  // namespace
}  // namespace pitwall::benchmarks
