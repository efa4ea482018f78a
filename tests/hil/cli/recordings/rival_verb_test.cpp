// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/rival_verb.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/hil/bench/recorded/recorded_drive.hpp"
#include "tests/hil/cli/program_run.hpp"

namespace pitwall::cli {
namespace {

class RivalVerb : public ProgramRun {
 protected:
  std::string recording() const { return bench::recorded_folder(); }
};

TEST_F(RivalVerb, WrongUsageIsTold) {
  expect_refusal({"rival", recording()}, "OTHER");
  expect_refusal({"rival", recording(), "/nowhere"}, "/nowhere");
  expect_refusal({"rival", recording(), recording(), "--offset", "x"}, "--offset");
}

// A car beside itself: it stands, so a tenth of a second makes no difference.
TEST_F(RivalVerb, TellsGapsAsATableAndACsv) {
  const ProgramOutput ran =
      run({"rival", recording(), recording(), "--offset", "0.1", "--out", path("gap.csv")});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_NE(ran.out.find("positions of both"), std::string::npos) << ran.out;
  const std::string csv = text_of("gap.csv");
  EXPECT_EQ(csv.rfind("t_s,utc_ns,own_s_m,", 0), 0U) << csv;
  EXPECT_GT(std::ranges::count(csv, '\n'), 10);
}

TEST_F(RivalVerb, RecordingsOfOtherTimesAreToldApart) {
  const ProgramOutput ran = run({"rival", recording(), recording(), "--offset", "1000"});
  EXPECT_EQ(ran.code, 1) << ran.err;
  EXPECT_NE(ran.out.find("no position of both"), std::string::npos) << ran.out;
}

}  // namespace
}  // namespace pitwall::cli
