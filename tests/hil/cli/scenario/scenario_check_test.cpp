// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/scenario/scenario_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "hil/cli/scenario/new_scenario.hpp"
#include "tests/support/replaced.hpp"

namespace pitwall::cli {
namespace {

const std::string kGood = new_scenario_text({.name = "n"});
constexpr const char* kNoFaults = "faults: []";

struct Defect {
  const char* from;
  const char* to;
  const char* what;  // of the message, which begins with the place
};

TEST(ScenarioCheck, FindsWhatARunWouldStumbleOver) {
  EXPECT_FALSE(problem_in_text(kGood, "n.yaml"));
  const Defect rows[] = {
      {"seed: 1", "seeds: 1", "n.yaml:"},
      {"tracks/lvms.yaml", "tracks/monza.yaml", "monza.yaml"},
      {"cars/av21.yaml", "cars/av22.yaml", "av22.yaml"},
      {"faults:", "plant: nowhere.yaml\nfaults:", "nowhere.yaml"},
      {"signal: wall_gap_m", "signal: wall_gap", "unknown signal \"wall_gap\""},
      {"from_s: 9}", "from_s: 90}", "the run ends before this window begins"},
      {kNoFaults, "faults:\n  - {kind: goblins, at_s: 1}", "n.yaml:16:12: error: unknown fault"},
      {kNoFaults, "faults:\n  - {kind: gnss_unit_outage, unit: 7, at_s: 1}", "no such unit"},
      {kNoFaults,
       "faults:\n  - {kind: clock_skew, value: 1, at_s: 1}\n  - {kind: log_disk_full, at_s: 1}",
       "needs"},
      {kNoFaults, "lidars: rays\nfaults:\n  - {kind: dust, value: 1, at_s: 1}", "dust"},
      {kNoFaults, "operator:\n  - {at_s: 1, say: jump}", "operator: \"jump\": "},
  };
  for (const Defect& row : rows) {
    const auto problem = problem_in_text(testing::replaced(kGood, row.from, row.to), "n.yaml");
    ASSERT_TRUE(problem) << row.to;
    EXPECT_NE(to_string(*problem).find(row.what), std::string::npos) << to_string(*problem);
  }
}

TEST(ScenarioCheck, AMissingFileIsAProblem) {
  const auto problem = problem_in("/nowhere/s.yaml");
  ASSERT_TRUE(problem);
  EXPECT_NE(to_string(*problem).find("/nowhere/s.yaml"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::cli
