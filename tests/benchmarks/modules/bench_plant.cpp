// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/modules/bench_plant.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/plant/plant.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/check.hpp"
#include "tests/benchmarks/command_line.hpp"
#include "tests/benchmarks/cost/cost_gates.hpp"
#include "tests/benchmarks/cost/machine_name.hpp"
#include "tests/benchmarks/cost/reference_cost.hpp"
#include "tests/benchmarks/step/lockstep_speed.hpp"
#include "tests/hil/plant/single_track.hpp"

namespace pitwall::benchmarks {
namespace {

constexpr double kStepLimit_us = 5.0;  // on the reference machine
// Short, so that some batch falls between two interruptions.
constexpr int kBatches = 400, kStepsPerBatch = 250;
constexpr int kLockstepRuns = 5;
constexpr Duration kLockstepSpan = seconds(60);  // of the scenario
constexpr double kStep_s = 0.001;

// What others publish of theirs; nobody ran them for this table.
struct Peer {
  const char* name;
  const char* figure;
};
constexpr std::array<Peer, 2> kPeers{{
    {"Open-Car-Dynamics", "< 10 us a step of 0.8 ms (double track, Ryzen 7950X) [published]"},
    {"Open-Car-Dynamics", "8.4 us a step at -O1 on another machine [noted, not by this run]"},
}};

struct Timed {
  double best_us = 0.0, median_us = 0.0;
};

// `step(i)` is one step; `settled()` reads a number out of the state so that none is left out. The
// reference unit takes turns with the batches.
template <class Step, class Settled>
Timed timed(cost::ReferenceCost& reference, Step step, Settled settled) {
  std::vector<double> took_us;
  for (int batch = 0; batch < kBatches; ++batch) {
    reference.take();
    const Duration before = transport::thread_time();
    for (int i = 0; i < kStepsPerBatch; ++i) step(i);
    took_us.push_back(cost::microseconds_of(transport::thread_time() - before) / kStepsPerBatch);
    CHECK(std::isfinite(settled()));
  }
  std::sort(took_us.begin(), took_us.end());
  return {took_us.front(), took_us[kBatches / 2]};
}

// A banked bend at speed, in gear, with the steering on the move: nothing is left out.
plant::Actuation driven(int i) {
  return {.steering_motor_rad = 0.4 + 0.2 * std::sin(0.02 * i),
          .throttle_fraction = 0.6,
          .brake_kpa = 50.0,
          .gear = 6,
          .ignition = true};
}

Timed time_double_track(cost::ReferenceCost& reference) {
  const plant::Params p;
  const plant::State start = plant::rolling(p, plant::standing(p, 0.0, 0.0, 0.0), 55.0, 6);
  const plant::Surface road{.bank_rad = 0.25, .wind_east_mps = 3.0};
  plant::State s = start;
  return timed(
      reference,
      [&](int i) {
        if (i == 0) s = start;  // every batch is the same work
        s = plant::step(p, s, driven(i), road, kStep_s);
      },
      [&] { return s.motion.x_m; });
}

plant::SingleTrackInput driven_single(int i) {
  return {0.02 * std::cos(i * kStep_s), std::sin(0.5 * i * kStep_s)};
}

Timed time_single_track(cost::ReferenceCost& reference) {
  const plant::SingleTrackParams p = plant::single_track_of(plant::Params{});
  plant::SingleTrackState s{.speed_mps = 55.0};
  return timed(
      reference, [&](int i) { s = plant::blended_step(p, s, driven_single(i), kStep_s); },
      [&] { return s.x_m; });
}

Timed time_kinematic(cost::ReferenceCost& reference) {
  const plant::SingleTrackParams p = plant::single_track_of(plant::Params{});
  plant::KinematicState s{.speed_mps = 55.0};
  return timed(
      reference, [&](int i) { s = plant::kinematic_step(p, s, driven_single(i), kStep_s); },
      [&] { return s.x_m; });
}

struct Figures {
  Timed double_track, single_track, kinematic;
  double unit_us = 0.0;  // beside them
  double fastest = 0.0;  // lockstep run, times real time
  LockstepCost lockstep;

  cost::CostGates gates() const {
    cost::CostGates gates;
    gates.at_most(
        {"a step of the double track, median", double_track.median_us, unit_us, kStepLimit_us});
    gates.at_most(lockstep_gate(lockstep, ", median"));
    return gates;
  }
};

Result<Figures, Problem> measure() {
  auto loaded = bench::load(kBenchScenario, "");
  if (!loaded) return Unexpected{loaded.error()};
  loaded->scenario.duration = std::min(loaded->scenario.duration, kLockstepSpan);
  cost::ReferenceCost reference;
  Figures f{.double_track = time_double_track(reference),
            .single_track = time_single_track(reference),
            .kinematic = time_kinematic(reference),
            .unit_us = reference.unit_us(),
            .lockstep = {}};
  std::vector<LockstepCost> runs;
  for (int i = 0; i < kLockstepRuns; ++i) {
    const auto run = lockstep_cost(*loaded, false);
    if (!run) return Unexpected{run.error()};
    runs.push_back(*run);
    f.fastest = std::max(f.fastest, run->times_real_time());
  }
  f.lockstep = median_of(std::move(runs));
  return f;
}

void print_row(const char* name, const Timed& t) {
  // A simulated second has a thousand steps: microseconds a step are milliseconds a second.
  std::printf("%-26s %10.3f %10.3f %16.3f\n", name, t.best_us, t.median_us, t.best_us);
}

void print(const Figures& f) {
  std::printf("one step of 1 ms, us: %d batches of %d steps\n%-26s %10s %10s %16s\n", kBatches,
              kStepsPerBatch, "", "best", "median", "ms/simulated s");
  print_row("double track", f.double_track);
  print_row("single track", f.single_track);
  print_row("kinematic single track", f.kinematic);
  std::printf("lockstep, times real time: best %.1f, median %.1f of %d runs of %.0f s\n", f.fastest,
              f.lockstep.times_real_time(), kLockstepRuns, kLockstepSpan.seconds());
  for (const Peer& peer : kPeers) std::printf("peer, %s: %s\n", peer.name, peer.figure);
  std::printf("reference unit, us: beside the steps %.1f, beside lockstep %.1f; %s\n%s", f.unit_us,
              f.lockstep.unit_us, cost::machine_name().c_str(), f.gates().text().c_str());
}

std::string json_of(const Figures& f) {
  json::Object json;
  json.text("bench", "plant");
  const auto add = [&json](const std::string& name, const Timed& t) {
    json.number(name + "_us", t.best_us).number(name + "_median_us", t.median_us);
  };
  add("double_track", f.double_track);
  add("single_track", f.single_track);
  add("kinematic", f.kinematic);
  return json.number("lockstep_times_real_time", f.fastest)
             .number("lockstep_median", f.lockstep.times_real_time())
             .text("machine", cost::machine_name())
             .json("gates", f.gates().json())
             .flag("held", f.gates().held())
             .str() +
         "\n";
}

}  // namespace

int bench_plant(std::span<const std::string> args) {
  std::string json_file;
  CommandLine app{"pitwall-benchmarks plant: what the modelled car costs"};
  app.option("--json", json_file, "write the figures here");
  if (const auto code = app.ended_by(args)) return *code;
  const auto figures = measure();
  if (!figures) return refuse(figures.error());
  print(*figures);
  if (!json_file.empty()) {
    const auto written = transport::write_file(json_file, json_of(*figures));
    if (!written) return refuse(written.error());
  }
  return figures->gates().held() ? kExitPass : kExitFailed;
}

}  // namespace pitwall::benchmarks
