// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/compare_verb.hpp"

#include <gtest/gtest.h>

#include "tests/hil/bench/recorded/recorded_drive.hpp"
#include "tests/hil/cli/program_run.hpp"

namespace pitwall::cli {
namespace {

class CompareVerb : public ProgramRun {
 protected:
  std::string recording() const { return bench::recorded_folder(); }
};

TEST_F(CompareVerb, WrongUsageIsTold) {
  expect_refusal({"compare"}, "RECORDING");
  expect_refusal({"compare", "/nowhere"}, "/nowhere");
  expect_refusal({"compare", recording(), "--tolerance", "ego.vx"}, "expected SIGNAL=VALUE");
  expect_refusal({"compare", recording(), "--tolerance", "ego.vx=-1"}, "expected SIGNAL=VALUE");
  expect_refusal({"compare", recording(), "--car", "/nowhere.yaml"}, "/nowhere.yaml");
}

TEST_F(CompareVerb, ARunDrivenAgainByTheSameBuildDiffersInNothing) {
  const ProgramOutput output = run({"compare", recording(), "--json", path("same.json")});
  EXPECT_EQ(output.code, 0) << output.err;
  EXPECT_NE(output.out.find("300 ticks driven again, "), std::string::npos) << output.out;
  EXPECT_NE(output.out.find(": 0 signals differ"), std::string::npos) << output.out;
  EXPECT_NE(output.out.find("fields that the process measures of itself"), std::string::npos);
  EXPECT_NE(text_of("same.json").find(R"("differences": [])"), std::string::npos)
      << text_of("same.json");
}

TEST_F(CompareVerb, SaysHowFarItIsWhereThatIsAskedFor) {
  const ProgramOutput output = run({"compare", recording(), "--progress"});
  EXPECT_EQ(output.code, 0) << output.err;
  EXPECT_NE(output.err.find("driving " + recording() + " again: "), std::string::npos)
      << output.err;
  EXPECT_EQ(run({"compare", recording()}).err, "");
}

TEST_F(CompareVerb, WithAnotherTrackItDiffersAndSaysWhere) {
  const ProgramOutput output =
      run({"compare", recording(), "--track", "vehicle/config/tracks/ims.yaml", "--json",
           path("other.json")});
  EXPECT_EQ(output.code, 1) << output.err;
  EXPECT_NE(output.err.find("ims.yaml: not the file that the run was driven with"),
            std::string::npos)
      << output.err;
  EXPECT_NE(output.out.find("values differ"), std::string::npos) << output.out;
  EXPECT_NE(output.out.find("  first "), std::string::npos) << output.out;
  EXPECT_NE(text_of("other.json").find(R"("signal": )"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::cli
