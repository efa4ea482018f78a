// Every scenario of a fault: noticed within its deadline, and the car ends well. And no fault of
// the catalogue without a scenario.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/cli/fault_coverage/catalogue.hpp"
#include "hil/cli/fault_coverage/fault_matrix.hpp"

namespace pitwall::fault_coverage {
namespace {

const std::string kRoot = PITWALL_SOURCE_DIR;
const std::string kFolder = kRoot + "/hil/scenarios/faults";

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder))
    all.push_back(entry.path().stem().string());
  std::ranges::sort(all);
  return all;
}

Result<bench::Loaded, Problem> loaded(const std::string& name) {
  return bench::load(kFolder + "/" + name + ".yaml", kRoot);
}

class Fault : public ::testing::TestWithParam<std::string> {};

TEST_P(Fault, IsNoticedInTimeAndEndsWell) {
  const auto scenario = loaded(GetParam());
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  EXPECT_EQ(scenario->scenario.name, GetParam()) << "a scenario is called as its file";
  const auto row = run_fault(*scenario, {});
  ASSERT_TRUE(row) << to_string(row.error());
  EXPECT_TRUE(row->passed()) << to_text(std::vector{*row});
}

INSTANTIATE_TEST_SUITE_P(All, Fault, ::testing::ValuesIn(names()),
                         [](const auto& name) { return name.param; });

TEST(FaultMatrix, EveryFaultOfTheCatalogueHasAScenarioThatDetects) {
  std::set<std::string> filled;
  for (const std::string& name : names()) {
    const auto scenario = loaded(name);
    ASSERT_TRUE(scenario) << to_string(scenario.error());
    if (std::ranges::any_of(scenario->scenario.expect, [](const grading::Expectation& e) {
          return e.kind == grading::Kind::kDetects;
        }))
      filled.insert(id_of(name));
  }
  for (const CatalogueRow& row : kCatalogue)
    EXPECT_TRUE(filled.contains(std::string(row.id))) << row.id << ": " << row.fault;
}

// From the green flag through two turns at speed no monitor sees anything.
TEST(FaultMatrix, HealthyDrivingAlarmsNobody) {
  auto scenario = loaded("f01_frames_lost");
  ASSERT_TRUE(scenario);
  scenario->scenario.faults.clear();
  scenario->scenario.expect.clear();
  scenario->scenario.duration = seconds(45);
  std::map<std::string, int> alarms;  // ticks
  int ticks = 0;
  const auto watch = [&](const pipeline::Outputs& out, const bench::Rig&, Instant now) {
    if (now < Instant{} + seconds(12)) return;
    ++ticks;
    for (std::size_t m = 0; m < world::kMonitors; ++m)
      if (out.seen.has(static_cast<world::Monitor>(m)))
        ++alarms[std::string(world::kMonitorNames[m])];
  };
  bench::LockstepOptions options;
  options.watch = watch;
  ASSERT_TRUE(bench::run_lockstep(scenario->scenario, scenario->setup, options));
  EXPECT_GT(ticks, 3000);
  for (const auto& [monitor, count] : alarms) ADD_FAILURE() << monitor << ": " << count << " ticks";
}

}  // namespace
}  // namespace pitwall::fault_coverage
