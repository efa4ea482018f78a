// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/lockstep.hpp"

#include "hil/bench/lockstep/car_bench.hpp"

namespace pitwall::bench {

Result<RunResult, Problem> run_lockstep(const scenario::Scenario& scenario,
                                        const pipeline::Setup& setup,
                                        const LockstepOptions& options) {
  auto car = CarBench::build(scenario, setup, options);
  if (!car) return Unexpected{car.error()};
  CarBench& own = **car;
  const Duration tick = setup.params.rates.tick;
  for (Instant now{}; now - Instant{} <= scenario.duration; now += tick) {
    own.step_computer(now);
    for (Instant at = now + kRigStep; at <= now + tick; at += kRigStep) own.step_rig(at);
    if (own.is_over(now)) break;
  }
  return own.finish();
}

}  // namespace pitwall::bench
