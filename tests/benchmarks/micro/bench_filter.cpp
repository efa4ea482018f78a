// SPDX-License-Identifier: Apache-2.0
// How fast the filters of localization are: one step of prediction, one update of each kind, one
// second of everything done again, a tick of the car. Figures, no gates.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "tests/vehicle/autonomy/localization/oval.hpp"
#include "vehicle/autonomy/localization/filter/filter.hpp"

namespace pitwall::localization {
namespace {

using testing::Arrival;
using testing::Oval;
using testing::OvalDrive;
using testing::recommended_filter;

struct Driven {
  FilterParams params = recommended_filter();
  std::unique_ptr<FilterState> state = std::make_unique<FilterState>();
  std::vector<Arrival> all;

  explicit Driven(double for_s, FilterKind kind = FilterKind::kSpatial) {
    params.kind = kind;
    OvalDrive drive(Oval{}, 1);
    all = drive.run(for_s);
    start(*state, params, drive.seed());
  }
};

SpatialBelief settled() {
  Driven driven(5.0);
  for (const Arrival& a : driven.all) (void)insert(*driven.state, driven.params, a.measurement);
  (void)estimate_at(*driven.state, driven.params, newest(*driven.state));
  return driven.state->spatial.tip;
}

void predict_spatial(benchmark::State& state) {
  const SpatialParams params = recommended_filter().spatial;
  const SpatialBelief from = settled();
  SpatialBelief b = from;
  for (auto _ : state) {
    b.at = from.at;
    advance(b, params, from.at + milliseconds(8), nullptr);
    benchmark::DoNotOptimize(b);
  }
}
BENCHMARK(predict_spatial);

void update_spatial(benchmark::State& state, Kind kind) {
  const FilterParams params = recommended_filter();
  const SpatialBelief from = settled();
  Measurement m{.kind = kind, .at = from.at, .sigma_a = 10.0, .sigma_b = 10.0, .sigma_c = 10.0};
  m.a = from.position_m[0], m.b = from.position_m[1], m.c = from.position_m[2];
  if (kind == Kind::kVelocity)
    m.a = from.velocity_mps[0], m.b = from.velocity_mps[1], m.c = from.velocity_mps[2];
  if (kind == Kind::kHeading) m.a = std::atan2(from.velocity_mps[1], from.velocity_mps[0]);
  if (kind == Kind::kWheelSpeed) m.a = 66.0;
  m.road = Oval{}.road((from.at - Instant{}).seconds());
  SpatialBelief b = from;
  for (auto _ : state) {
    b.model_at = {};  // as if for the first time
    b.position_m = from.position_m;
    benchmark::DoNotOptimize(SpatialModel::fold(b, params.spatial, m, nullptr));
  }
}
BENCHMARK_CAPTURE(update_spatial, position, Kind::kPosition);
BENCHMARK_CAPTURE(update_spatial, velocity, Kind::kVelocity);
BENCHMARK_CAPTURE(update_spatial, heading, Kind::kHeading);
BENCHMARK_CAPTURE(update_spatial, wheel_speed, Kind::kWheelSpeed);
BENCHMARK_CAPTURE(update_spatial, slip, Kind::kSlip);
BENCHMARK_CAPTURE(update_spatial, road, Kind::kRoad);

// All measurements of a second, in order, without the window.
void replay_one_second(benchmark::State& state) {
  const Driven driven(6.0);
  std::vector<Measurement> second;
  const Instant from = Instant{} + seconds(5);
  for (const Arrival& a : driven.all)
    if (a.measurement.at > from) second.push_back(a.measurement);
  std::sort(second.begin(), second.end(), before);
  const SpatialBelief at_start = settled();
  for (auto _ : state) {
    SpatialBelief b = at_start;
    const Measurement* ahead = nullptr;
    for (std::size_t i = 0, k = 0; i < second.size(); ++i) {
      for (k = std::max(k, i); k < second.size() && second[k].kind != Kind::kImu; ++k) continue;
      ahead = k < second.size() ? &second[k] : nullptr;
      (void)SpatialModel::fold(b, driven.params.spatial, second[i], ahead);
    }
    benchmark::DoNotOptimize(b);
  }
  state.counters["measurements"] = static_cast<double>(second.size());
}
BENCHMARK(replay_one_second)->Unit(benchmark::kMicrosecond);

// Ten seconds as they arrive, with an estimate every 10 ms; the time of one tick.
void tick(benchmark::State& state, FilterKind kind) {
  constexpr std::int64_t kFor_ms = 10'000, kTick_ms = 10;
  for (auto _ : state) {
    state.PauseTiming();
    Driven driven(1e-3 * static_cast<double>(kFor_ms), kind);
    state.ResumeTiming();
    std::size_t next = 0;
    for (std::int64_t ms = kTick_ms; ms < kFor_ms; ms += kTick_ms) {
      for (; next < driven.all.size() && driven.all[next].at_ms <= ms; ++next)
        (void)insert(*driven.state, driven.params, driven.all[next].measurement);
      benchmark::DoNotOptimize(publish(*driven.state, driven.params, Instant{ms * 1'000'000}));
    }
  }
  state.SetItemsProcessed(state.iterations() * (kFor_ms / kTick_ms));
}
BENCHMARK_CAPTURE(tick, planar, FilterKind::kPlanar)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(tick, spatial, FilterKind::kSpatial)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pitwall::localization

BENCHMARK_MAIN();
