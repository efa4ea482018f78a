// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/radio_gates.hpp"

#include <gtest/gtest.h>

#include "tests/hil/cli/program_run.hpp"

namespace pitwall::benchmarks {

using cli::ProgramOutput;
using cli::ProgramRun;
namespace {

using RadioGates = ProgramRun;

TEST_F(RadioGates, RefusesWhatItCannotUse) {
  expect_refusal({"radio-gates", "gaets"}, "gaets");
  expect_refusal({"radio-gates", "--hours", "0"}, "--hours");
  EXPECT_EQ(run({"radio-gates", "--help"}).code, 0);
}

}  // namespace
}  // namespace pitwall::benchmarks
