// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/step/step_times.hpp"

#include <algorithm>

#include "hil/bench/lockstep/lockstep.hpp"
#include "protocol/transport/clock.hpp"
#include "tests/benchmarks/cost/reference_cost.hpp"
#include "tests/support/allocation_guard.hpp"

namespace pitwall::benchmarks {
namespace {

// A unit turns over the caches of the step after it: in each run of another one.
constexpr std::size_t kTicksPerUnit = 50, kTicksOnInEachRun = 16;

std::optional<Duration> rewind_of(const pipeline::Car& car, const world::SensorInput& sensors) {
  if (!car.localization.started) return std::nullopt;
  const Instant newest = localization::newest(car.localization.filter);
  Instant oldest = newest;
  const auto look = [&oldest](const auto& samples) {
    for (const auto& sample : samples) oldest = std::min(oldest, sample.at);
  };
  look(sensors.positions), look(sensors.velocities), look(sensors.headings);
  if (oldest == newest) return std::nullopt;
  return newest - oldest;
}

}  // namespace

Result<StepTimes, Problem> time_steps(const bench::Loaded& loaded) {
  StepTimes times;
  cost::ReferenceCost reference;
  for (std::size_t run = 0; run < kStepRuns; ++run) {
    std::size_t tick = 0;
    bench::LockstepOptions options;
    options.step = [&](const pipeline::Setup& setup, pipeline::Car& car,
                       const pipeline::Inputs& in) {
      const std::optional<Duration> rewind = rewind_of(car, in.sensors);
      pipeline::Outputs out;
      const Duration before = transport::thread_time();
      times.allocations += testing::allocations_of([&] { out = pipeline::step(setup, car, in); });
      const double took_us = cost::microseconds_of(transport::thread_time() - before);
      if (tick == times.steps.size()) times.steps.push_back({took_us, rewind});
      times.steps[tick].least_us = std::min(times.steps[tick].least_us, took_us);
      if (++tick % kTicksPerUnit == run * kTicksOnInEachRun) reference.take();
      return out;
    };
    const auto result = bench::run_lockstep(loaded.scenario, loaded.setup, options);
    if (!result) return Unexpected{result.error()};
    reference.again();
  }
  times.unit_us = reference.unit_us();
  return times;
}

}  // namespace pitwall::benchmarks
