// SPDX-License-Identifier: Apache-2.0
// What the base's judgement costs: one evaluation of all derived fields and alarms (a hundred a
// second), a judgement of every field, the list as it is shown. Figures, no gates.
#include <benchmark/benchmark.h>

#include "tests/basestation/race_wall.hpp"

namespace pitwall {
namespace {

// A healthy car, or one with an alarm of each kind that its values can raise.
void evaluate(benchmark::State& state, bool healthy) {
  RaceWall wall;
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
      wall.told.touch_all(now);
      wall.link.heard = now;
      wall.watch.link(wall.link);
      state.ResumeTiming();
    }
    now += picture::kGrid;
    wall.watch.advance(wall.told.picture, now);
  }
  state.counters["alarms"] = static_cast<double>(alarms::alarm_count());
}
BENCHMARK_CAPTURE(evaluate, healthy, true);
BENCHMARK_CAPTURE(evaluate, three_alarms, false);

void judge_every_field(benchmark::State& state) {
  RaceWall wall;
  wall.run(seconds(5));
  for (auto _ : state) {
    for (picture::FieldId id = 0; id < telemetry::kFieldCount; ++id) {
      const auto view = wall.watch.view(wall.told.picture, id, wall.now);
      benchmark::DoNotOptimize(wall.watch.judge(id, view));
    }
  }
}
BENCHMARK(judge_every_field);

void list_of_three(benchmark::State& state) {
  RaceWall wall;
  wall.tyres(29.0);
  wall.set(telemetry::field("wheels.rear_left"), 60.0);
  wall.set(telemetry::field("gnss1.status"), 1.0);
  wall.run(seconds(5));
  for (auto _ : state) benchmark::DoNotOptimize(wall.watch.alarms().active());
}
BENCHMARK(list_of_three);

}  // namespace
}  // namespace pitwall

BENCHMARK_MAIN();
