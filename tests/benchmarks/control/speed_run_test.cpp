// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/speed_run.hpp"

#include <gtest/gtest.h>

#include "tests/benchmarks/control/speed_table.hpp"
#include "tests/benchmarks/laps/shipped_scenario.hpp"

namespace pitwall::speed_bench {
namespace {

SpeedRow drive(const std::string& track, const control_bench::World& car,
               void (*change)(control::Params&) = nullptr) {
  const bench::Loaded on = laps::shipped_scenario(track);
  Plan plan = plan_of(on.scenario, on.setup.params.planning);
  control_bench::World here = car;
  if (!here.plant_file.empty()) here.plant_file = PITWALL_SOURCE_DIR "/" + here.plant_file;
  plan.scenario = control_bench::in_world(plan.scenario, here).value();
  pipeline::Setup setup = on.setup;
  setup.params.control.controller = control::controller_named(control_bench::kOurs);
  if (change != nullptr) change(setup.params.control);
  SpeedRow row = run_speed(plan, setup).value();
  row.law = control_bench::kOurs, row.world = car.name;
  return row;
}

// The acceptance of the longitudinal law, on one oval; `pitwall bench speed` drives three.
TEST(SpeedRun, OursHoldsEveryBoundInEachCar) {
  std::vector<SpeedRow> rows;
  for (const control_bench::World& car : cars()) rows.push_back(drive("lvms_flying_lap", car));
  for (const Gate& gate : gates_of(rows)) EXPECT_TRUE(gate.held) << gate.name << ": " << gate.worst;
  EXPECT_GT(rows[0].steady.ticks, 8000U);
  EXPECT_EQ(rows[0].crossings, 9U);  // 2 3 2 3 4 5 4 3 2
}

// The gates can fail: a final drive of half the ratio asks for twice the torque.
TEST(SpeedRun, AModelThatIsWrongMissesTheSpeed) {
  const SpeedRow row = drive("lvms_flying_lap", cars().front(), [](control::Params& p) {
    p.speed.car.engine.final_drive *= 0.5;
    p.speed.ki_per_s2 = 0.0;
    p.speed.kp_per_s = 0.3;
  });
  EXPECT_EQ(row.end, "");
  EXPECT_GT(row.steady.rms_mps(), kSteadyRms_mps);
  EXPECT_FALSE(all_held({row}));
}

}  // namespace
}  // namespace pitwall::speed_bench
