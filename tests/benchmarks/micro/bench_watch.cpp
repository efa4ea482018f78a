// SPDX-License-Identifier: Apache-2.0
// What the base's judgement costs: one evaluation of all derived fields and alarms (a hundred a
// second), a judgement of every field, the list as it is shown. Figures, no gates.
#include <benchmark/benchmark.h>

#include "tests/basestation/healthy_race.hpp"

namespace pitwall {
namespace {

// A healthy car, or one with an alarm of each kind that its values can raise.
void evaluate(benchmark::State& state, bool healthy) {
  HealthyRace wall;
  if (!healthy) {
    wall.tyres(29.0);
    wall.set(telemetry::field("wheels.rear_left"), 60.0);
    wall.set(telemetry::field("gnss1.status"), 1.0);
  }
  wall.run(seconds(5));
  Instant now = wall.now;
  std::int64_t steps = 0;
  for (auto _ : state) {
    if (++steps % 2 == 0) {  // a packet comes with every second step
      state.PauseTiming();
      wall.reported.touch_all(now);
      wall.link.received = now;
      wall.evaluator.link(wall.link);
      state.ResumeTiming();
    }
    now += alarms::kGrid;
    wall.evaluator.advance(wall.reported.vehicle, now);
  }
  state.counters["alarms"] = static_cast<double>(alarms::alarm_count());
}
BENCHMARK_CAPTURE(evaluate, healthy, true);
BENCHMARK_CAPTURE(evaluate, three_alarms, false);

void judge_every_field(benchmark::State& state) {
  HealthyRace wall;
  wall.run(seconds(5));
  for (auto _ : state) {
    for (state::FieldId id = 0; id < telemetry::kFieldCount; ++id) {
      const auto view = wall.evaluator.view(wall.reported.vehicle, id, wall.now);
      benchmark::DoNotOptimize(wall.evaluator.evaluate(id, view));
    }
  }
}
BENCHMARK(judge_every_field);

void list_of_three(benchmark::State& state) {
  HealthyRace wall;
  wall.tyres(29.0);
  wall.set(telemetry::field("wheels.rear_left"), 60.0);
  wall.set(telemetry::field("gnss1.status"), 1.0);
  wall.run(seconds(5));
  for (auto _ : state) benchmark::DoNotOptimize(wall.evaluator.alarms().active());
}
BENCHMARK(list_of_three);

}  // namespace
}  // namespace pitwall

BENCHMARK_MAIN();
