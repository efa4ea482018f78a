// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/control_cost.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hil/bench/lockstep/lockstep.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/text.hpp"
#include "tests/benchmarks/cost/quantiles.hpp"
#include "tests/benchmarks/cost/reference_cost.hpp"
#include "tests/support/allocation_guard.hpp"
#include "vehicle/envelope/lap_profile.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::control_bench {
namespace {

constexpr double kTickLimit_us = 20.0, kRiccatiLimit_us = 1'000.0, kProfileLimit_us = 2'000.0;
constexpr int kUnitsPerBlock = 20;
constexpr Duration kTick = milliseconds(10);

// What control was given in a tick.
struct Tick {
  world::EgoState ego;
  std::size_t trajectory = 0;  // in the list
  steering::Learned learned;
  double angle_max_rad = kUnset;
};

struct Drive {
  std::vector<Tick> ticks;
  std::vector<world::Trajectory> trajectories;
};

Result<Drive, Problem> driven(const bench::Loaded& loaded) {
  Drive drive;
  bench::LockstepOptions options;
  options.step = [&drive](const pipeline::Setup& setup, pipeline::Car& car,
                          const pipeline::Inputs& in) {
    const pipeline::Outputs out = pipeline::step(setup, car, in);
    if (!control::is_usable(out.ego) || car.plan.output.drive.points.empty()) return out;
    const world::Trajectory& planned = car.plan.output.drive;
    if (drive.trajectories.empty() || drive.trajectories.back().at != planned.at)
      drive.trajectories.push_back(planned);
    drive.ticks.push_back({out.ego, drive.trajectories.size() - 1, car.learned,
                           steering::angle_max_rad(setup.angles, out.ego.vx_mps)});
    return out;
  };
  const auto result = bench::run_lockstep(loaded.scenario, loaded.setup, options);
  if (!result) return Unexpected{result.error()};
  return drive;
}

template <class Work>
double processor_us(Work work) {
  const Duration before = transport::thread_time();
  work();
  return cost::microseconds_of(transport::thread_time() - before);
}

double block_p99_us(const control::Params& params, const control::LateralGains& gains,
                    const Drive& drive, std::size_t& allocations) {
  std::vector<double> took_us(drive.ticks.size());
  control::State state;
  Instant now{};
  for (std::size_t i = 0; i < drive.ticks.size(); ++i) {
    const Tick& tick = drive.ticks[i];
    now = now + kTick;
    control::Output out;
    took_us[i] = processor_us([&] {
      allocations += testing::allocations_of([&] {
        out = control::step(params, gains, state,
                            {.ego = tick.ego,
                             .trajectory = drive.trajectories[tick.trajectory],
                             .learned = tick.learned,
                             .angle_max_rad = tick.angle_max_rad},
                            now, kTick);
      });
    });
    state = out.next;
  }
  return benchmarks::quantiles_of(std::move(took_us)).p99_us;
}

std::vector<envelope::RoadStep> road_of(const planning::Line& line) {
  std::vector<envelope::RoadStep> road;
  for (const planning::LinePoint& p : line.points)
    road.push_back(
        {.curvature_per_m = p.curvature_per_m, .bank_rad = p.bank_rad, .step_m = line.spacing_m});
  return road;
}

void measure_profile(const pipeline::Setup& setup, cost::ReferenceCost& reference,
                     ControlCost& out) {
  const envelope::EnvelopeTable table{pipeline::envelope_of(setup.params, setup.track)};
  const std::vector<envelope::RoadStep> road = road_of(setup.line);
  std::vector<world::LapPoint> lap(road.size());
  envelope::LapProfile profile{table};
  profile.solve(road, lap);  // the first one makes room
  out.profile_points = road.size(), out.profile_us = HUGE_VAL;
  for (int block = 0; block < kCostBlocks; ++block) {
    envelope::LapOutcome outcome;
    out.profile_us = std::min(
        out.profile_us, processor_us([&] {
          out.allocations += testing::allocations_of([&] { outcome = profile.solve(road, lap); });
        }));
    CHECK(!outcome.stuck);
    reference.take();
  }
}

}  // namespace

Result<ControlCost, Problem> measure_cost(const bench::Loaded& loaded,
                                          const std::vector<std::string>& laws) {
  const auto drive = driven(loaded);
  if (!drive) return Unexpected{drive.error()};
  ControlCost out{.laws = {}, .ticks = drive->ticks.size(), .prepare_us = HUGE_VAL};
  cost::ReferenceCost reference;
  auto gains = control::prepare(loaded.setup.params.control);
  if (!gains) return Unexpected{gains.error()};
  for (int block = 0; block < kCostBlocks; ++block)
    out.prepare_us =
        std::min(out.prepare_us,
                 processor_us([&] { gains = control::prepare(loaded.setup.params.control); }));
  for (const std::string& law : laws) {
    control::Params params = loaded.setup.params.control;
    params.controller = control::controller_named(law);
    LawCost cost{.law = law, .tick_p99_us = HUGE_VAL};
    for (int block = 0; block < kCostBlocks; ++block) {
      cost.tick_p99_us =
          std::min(cost.tick_p99_us, block_p99_us(params, *gains, *drive, out.allocations));
      for (int unit = 0; unit < kUnitsPerBlock; ++unit) reference.take();
    }
    out.laws.push_back(cost);
  }
  measure_profile(loaded.setup, reference, out);
  out.unit_us = reference.unit_us();
  return out;
}

cost::CostGates gates_of(const ControlCost& measured) {
  cost::CostGates gates;
  for (const LawCost& law : measured.laws)
    gates.at_most({law.law + ", a tick, p99", law.tick_p99_us, measured.unit_us, kTickLimit_us});
  gates.at_most({"all Riccati equations", measured.prepare_us, measured.unit_us, kRiccatiLimit_us});
  gates.at_most(
      {"speed profile of a lap", measured.profile_us, measured.unit_us, kProfileLimit_us});
  gates.count("no allocation in " + std::to_string(measured.ticks) + " ticks and a profile",
              measured.allocations == 0 && measured.ticks > 0);
  return gates;
}

std::string to_text(const ControlCost& measured) {
  std::string text =
      formatted("processor time, us, the best of %d blocks over %zu ticks of a lap\n%-14s %10s\n",
                kCostBlocks, measured.ticks, "law", "tick, p99");
  for (const LawCost& law : measured.laws)
    text += formatted("%-14s %10.2f\n", law.law.c_str(), law.tick_p99_us);
  return text + formatted("all Riccati equations %.0f; speed profile of a lap of %zu points %.0f\n",
                          measured.prepare_us, measured.profile_points, measured.profile_us);
}

}  // namespace pitwall::control_bench
