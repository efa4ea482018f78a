// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/step/lockstep_speed.hpp"

#include <algorithm>

#include "hil/bench/lockstep/lockstep.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/vocabulary/check.hpp"
#include "tests/benchmarks/cost/reference_cost.hpp"

namespace pitwall::benchmarks {
namespace {

constexpr Duration kUnitEvery = milliseconds(500);

}  // namespace

Result<LockstepCost, Problem> lockstep_cost(const bench::Loaded& loaded, bool with_log) {
  cost::ReferenceCost reference;
  bench::LockstepOptions options;
  if (with_log) options.log = [](std::span<const std::uint8_t>) { return true; };
  options.follow = [&reference](const bench::RunView& run) {
    if ((run.now - Instant{}).ns % kUnitEvery.ns == 0) reference.take();
  };
  const Duration before = transport::thread_time();
  const auto result = bench::run_lockstep(loaded.scenario, loaded.setup, options);
  if (!result) return Unexpected{result.error()};
  const Duration took = transport::thread_time() - before - reference.spent();
  return LockstepCost{cost::microseconds_of(took) / loaded.scenario.duration.seconds(),
                      reference.unit_us()};
}

LockstepCost median_of(std::vector<LockstepCost> runs) {
  CHECK(!runs.empty());
  std::sort(runs.begin(), runs.end(),
            [](const LockstepCost& a, const LockstepCost& b) { return a.units() < b.units(); });
  return runs[runs.size() / 2];
}

cost::CostGate lockstep_gate(const LockstepCost& cost, const std::string& which) {
  return {.what = "a second of lockstep" + which + ", 50 times real time",
          .cost_us = cost.second_us,
          .unit_us = cost.unit_us,
          .limit_us = kSecondLimit_us};
}

}  // namespace pitwall::benchmarks
