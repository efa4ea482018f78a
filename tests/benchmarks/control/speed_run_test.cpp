// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/speed_run.hpp"

#include <gtest/gtest.h>

#include "tests/benchmarks/control/speed_table.hpp"
#include "tests/benchmarks/laps/shipped_scenario.hpp"

namespace pitwall::speed_bench {
namespace {

SpeedRow drive(const std::string& track, const control_bench::World& car, const char* law) {
  const bench::Loaded on = laps::shipped_scenario(track);
  Plan plan = plan_of(on.scenario, on.setup.params.planning);
  control_bench::World here = car;
  if (!here.plant_file.empty()) here.plant_file = PITWALL_SOURCE_DIR "/" + here.plant_file;
  plan.scenario = control_bench::in_world(plan.scenario, here).value();
  pipeline::Setup setup = on.setup;
  setup.params.control.controller = control::controller_named(law);
  SpeedRow row = run_speed(plan, setup).value();
  row.law = law, row.world = car.name;
  return row;
}

// The acceptance of the longitudinal law, on one oval; `pitwall bench speed` drives three.
TEST(SpeedRun, OursHoldsEveryBoundInEachCar) {
  std::vector<SpeedRow> rows;
  for (const control_bench::World& car : cars())
    rows.push_back(drive("lvms_flying_lap", car, control_bench::kOurs));
  for (const Gate& gate : gates_of(rows)) EXPECT_TRUE(gate.held) << gate.name << ": " << gate.worst;
  EXPECT_GT(rows[0].steady.ticks, 8000U);
  EXPECT_GT(rows[0].shifts, 10U);
}

// The gates can fail: the paper's law misses them.
TEST(SpeedRun, ThePapersLawIsFurtherFromItsReference) {
  SpeedRow row = drive("lvms_flying_lap", cars().front(), control_bench::kPaper);
  EXPECT_EQ(row.end, "");
  row.law = control_bench::kOurs;
  EXPECT_FALSE(all_held({row}));
}

}  // namespace
}  // namespace pitwall::speed_bench
