// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/planner_cost.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "hil/bench/lockstep/lockstep.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/vocabulary/text.hpp"
#include "tests/benchmarks/control/control_cost.hpp"
#include "tests/benchmarks/cost/quantiles.hpp"
#include "tests/benchmarks/cost/reference_cost.hpp"
#include "tests/support/allocation_guard.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::control_bench {
namespace {

constexpr double kPlannerLimit_us = 1'000.0;
constexpr int kPlannerUnits = 20;

// What planning was given in a tick.
struct PlannerTick {
  planning::State state;
  world::EgoState ego;
  world::RaceControl race_control;
  world::Opponents cars;
  steering::Learned learned;
  double operator_mps = kUnset, tyre_c = kUnset;
  Instant now{};
};

Result<std::vector<PlannerTick>, Problem> planned(const bench::Loaded& loaded) {
  std::vector<PlannerTick> ticks;
  bench::LockstepOptions options;
  options.step = [&ticks](const pipeline::Setup& setup, pipeline::Car& car,
                          const pipeline::Inputs& in) {
    const planning::State before = car.plan.output.next;
    pipeline::Outputs out = pipeline::step(setup, car, in);
    if (car.plan.at == in.now && before.started)
      ticks.push_back({before, out.ego, out.race_control, out.opponents, car.learned,
                       out.speed_limit_mps,
                       world::coldest_c(out.received.signals.tyre_temperature_c, in.now), in.now});
    return out;
  };
  const auto result = bench::run_lockstep(loaded, options);
  if (!result) return Unexpected{result.error()};
  return ticks;
}

double planner_block_us(const pipeline::Setup& setup, const std::vector<PlannerTick>& ticks,
                        PlannerCost& out) {
  std::vector<double> took_us;
  took_us.reserve(ticks.size());
  for (const PlannerTick& tick : ticks) {
    const steering::AngleBudget angles{.limits = setup.angles,
                                       .car = setup.params.control.steering.bicycle,
                                       .learning = setup.params.control.steering.learning,
                                       .learned = tick.learned,
                                       .share = setup.params.planning.steer_share};
    const Duration before = transport::thread_time();
    out.allocations += testing::allocations_of([&] {
      static_cast<void>(planning::step(setup.params.planning, setup.line, setup.track, tick.state,
                                       {.ego = tick.ego,
                                        .race_control = tick.race_control,
                                        .operator_speed_limit_mps = tick.operator_mps,
                                        .followed = planning::Followed::kDrive,
                                        .tyre_c = tick.tyre_c,
                                        .steering = &angles,
                                        .other_lines = setup.other_lines,
                                        .cars = &tick.cars},
                                       tick.now));
    });
    took_us.push_back(cost::microseconds_of(transport::thread_time() - before));
  }
  return benchmarks::quantiles_of(std::move(took_us)).p99_us;
}

bool looks_for_a_pass(const PlannerTick& tick) {
  const bool may = tick.race_control.track == world::TrackFlag::kWavingGreen &&
                   tick.race_control.vehicle == world::VehicleFlag::kAttacker;
  return may && tick.state.pass.phase != planning::PassPhase::kFree;
}

}  // namespace

Result<PlannerCost, Problem> measure_planner(const bench::Loaded& loaded) {
  const auto ticks = planned(loaded);
  if (!ticks) return Unexpected{ticks.error()};
  PlannerCost out{
      .ticks = ticks->size(),
      .passing = static_cast<std::size_t>(std::ranges::count_if(*ticks, looks_for_a_pass)),
      .tick_p99_us = HUGE_VAL};
  cost::ReferenceCost reference;
  for (int block = 0; block < kCostBlocks; ++block) {
    out.tick_p99_us = std::min(out.tick_p99_us, planner_block_us(loaded.setup, *ticks, out));
    for (int unit = 0; unit < kPlannerUnits; ++unit) reference.take();
  }
  out.unit_us = reference.unit_us();
  return out;
}

cost::CostGates gates_of(const PlannerCost& measured) {
  cost::CostGates gates;
  gates.at_most(
      {"planning among cars, p99", measured.tick_p99_us, measured.unit_us, kPlannerLimit_us});
  gates.count("no allocation in " + std::to_string(measured.ticks) + " ticks of planning",
              measured.allocations == 0 && measured.passing > 0);
  return gates;
}

std::string to_text(const PlannerCost& measured) {
  return formatted(
      "planning among cars, p99 of %zu ticks of a match (%zu in a pass or before one): %.0f us\n",
      measured.ticks, measured.passing, measured.tick_p99_us);
}

}  // namespace pitwall::control_bench
