// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/scenario/scenario_table.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace pitwall::cli {
namespace {

TEST(ScenarioTable, HasARowForEachScenarioInColumns) {
  const std::vector<bench_server::Listed> rows{
      {.file = "a/long_one.yaml",
       .name = "long",
       .track = "config/tracks/lvms.yaml",
       .car = "av21.yaml",
       .duration_s = 12.5,
       .faults = {"gnss_outage"},
       .expect = {"one", "two"}},
      {.file = "b.yaml", .name = "b", .track = "t", .car = "c", .duration_s = 7'200.0}};
  EXPECT_EQ(scenario_table(rows),
            "file             name  duration  track  car   faults  expectations\n"
            "a/long_one.yaml  long  12.5 s    lvms   av21  1       2\n"
            "b.yaml           b     7200 s    t      c     0       0\n");
  EXPECT_EQ(scenario_table({}), "file  name  duration  track  car  faults  expectations\n");
}

}  // namespace
}  // namespace pitwall::cli
