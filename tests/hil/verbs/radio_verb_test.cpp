// SPDX-License-Identifier: Apache-2.0
#include "hil/verbs/radio_verb.hpp"

#include <gtest/gtest.h>

#include "hil/verbs/exit_code.hpp"
#include "tests/hil/verbs/program_run.hpp"

namespace pitwall::verbs {
namespace {

using RadioVerb = ProgramRun;

TEST_F(RadioVerb, RefusesWhatItCannotUse) {
  EXPECT_EQ(run({"radio"}).code, kExitUnusable);
  EXPECT_EQ(run({"radio", "gaets"}).code, kExitUnusable);
  EXPECT_EQ(run({"radio", "gates", "--hours", "0"}).code, kExitUnusable);
  EXPECT_EQ(run({"radio", "--help"}).code, kExitPass);
}

}  // namespace
}  // namespace pitwall::verbs
