// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/modules/bench_ekf.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/bench/lockstep/lockstep.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/transport/file.hpp"
#include "tests/benchmarks/command_line.hpp"
#include "tests/benchmarks/cost/cost_gates.hpp"
#include "tests/benchmarks/cost/machine_name.hpp"
#include "tests/benchmarks/cost/quantiles.hpp"
#include "tests/benchmarks/cost/reference_cost.hpp"
#include "tests/benchmarks/modules/filter_times.hpp"
#include "tests/benchmarks/step/lockstep_speed.hpp"
#include "tests/benchmarks/step/step_times.hpp"
#include "tests/support/allocation_guard.hpp"

namespace pitwall::benchmarks {
namespace {

using localization::FilterKind, localization::Kind;

// On the reference machine, see tests/benchmarks/cost/cost_gates.hpp.
constexpr double kPredictLimit_us = 15.0, kUpdateLimit_us = 30.0;                // p50
constexpr double kShortRewindLimit_us = 1'000.0, kLongRewindLimit_us = 8'000.0;  // p50
constexpr double kStepLimit_us = 1'200.0;                                        // p99
constexpr Duration kSpan = seconds(60);                                          // of the scenario
constexpr Duration kMoves = seconds(20);  // from here the car is at speed
constexpr Duration kEvery = milliseconds(250);
constexpr std::uint32_t kLateUnit = 1;

struct NamedKind {
  Kind kind;
  const char* name;
};
constexpr std::array<NamedKind, 6> kUpdates{{{Kind::kPosition, "position"},
                                             {Kind::kVelocity, "velocity"},
                                             {Kind::kHeading, "heading"},
                                             {Kind::kWheelSpeed, "wheel_speed"},
                                             {Kind::kSlip, "slip"},
                                             {Kind::kRoad, "road"}}};

struct FilterFigures {
  Quantiles predict, short_rewind, long_rewind;
  std::array<Quantiles, kUpdates.size()> update;
  double unit_us = 0.0;

  double worst_update_us() const {
    double worst = 0.0;
    for (const Quantiles& q : update) worst = std::max(worst, q.p50_us);
    return worst;
  }
};

struct StepFigures {
  Quantiles any, late;  // with a rewind; with one of 100 ms and more
  std::size_t allocations = 0;
  double unit_us = 0.0;
};

struct Figures {
  FilterFigures spatial, planar;
  StepFigures step;

  cost::CostGates gates() const {
    cost::CostGates gates;
    const auto of_filter = [&](const char* what, double cost_us, double limit_us) {
      gates.at_most({what, cost_us, spatial.unit_us, limit_us});
    };
    of_filter("predict, p50", spatial.predict.p50_us, kPredictLimit_us);
    of_filter("update, p50, each kind", spatial.worst_update_us(), kUpdateLimit_us);
    of_filter("rewind of 100 ms, p50", spatial.short_rewind.p50_us, kShortRewindLimit_us);
    of_filter("rewind of 1 s, p50", spatial.long_rewind.p50_us, kLongRewindLimit_us);
    gates.at_most(
        {"step with a rewind of 100 ms, p99", step.late.p99_us, step.unit_us, kStepLimit_us});
    gates.count("no allocation in any step", step.allocations == 0);
    return gates;
  }
};

FilterFigures figures_of(const FilterTimes& times, double unit_us) {
  FilterFigures f;
  f.unit_us = unit_us;
  f.predict = quantiles_of(times.predict_us);
  f.short_rewind = quantiles_of(times.short_rewind_us);
  f.long_rewind = quantiles_of(times.long_rewind_us);
  for (std::size_t i = 0; i < kUpdates.size(); ++i)
    f.update[i] = quantiles_of(times.update_us[static_cast<std::size_t>(kUpdates[i].kind)]);
  return f;
}

Result<FilterFigures, Problem> time_filter(bench::Loaded loaded, FilterKind kind) {
  localization::FilterParams& params = loaded.setup.params.localization.filter;
  params.kind = kind;
  params.window_s = localization::kWindowMost_s;
  FilterTimes times;
  cost::ReferenceCost reference;
  bench::LockstepOptions options;
  options.step = [&](const pipeline::Setup& setup, pipeline::Car& car, const pipeline::Inputs& in) {
    const pipeline::Outputs out = pipeline::step(setup, car, in);
    const Duration since = in.now - Instant{};
    if (since >= kMoves && since.ns % kEvery.ns == 0 && car.localization.started) {
      take_times(car.localization.filter, params, times);
      reference.take();
    }
    return out;
  };
  const auto result = bench::run_lockstep(loaded.scenario, loaded.setup, options);
  if (!result) return Unexpected{result.error()};
  return figures_of(times, reference.unit_us());
}

Result<StepFigures, Problem> step_figures(bench::Loaded loaded) {
  scenario::Fault late;
  late.kind = "gnss_latency", late.unit = kLateUnit, late.value = kShortRewind.seconds();
  late.at = kMoves, late.lasts = kSpan;
  loaded.scenario.faults.push_back(late);
  const auto times = time_steps(loaded);
  if (!times) return Unexpected{times.error()};
  std::vector<double> any_us, late_us;
  for (const StepTime& step : times->steps) {
    if (step.rewind) any_us.push_back(step.least_us);
    if (step.rewind && *step.rewind >= kShortRewind) late_us.push_back(step.least_us);
  }
  return StepFigures{quantiles_of(std::move(any_us)), quantiles_of(std::move(late_us)),
                     times->allocations, times->unit_us};
}

Result<Figures, Problem> measure() {
  auto loaded = bench::load(kBenchScenario, "");
  if (!loaded) return Unexpected{loaded.error()};
  loaded->scenario.duration = std::min(loaded->scenario.duration, kSpan);
  const auto spatial = time_filter(*loaded, FilterKind::kSpatial);
  if (!spatial) return Unexpected{spatial.error()};
  const auto planar = time_filter(*loaded, FilterKind::kPlanar);
  if (!planar) return Unexpected{planar.error()};
  const auto step = step_figures(*loaded);
  if (!step) return Unexpected{step.error()};
  return Figures{*spatial, *planar, *step};
}

void print_row(const char* name, const Quantiles& a, const Quantiles& b) {
  std::printf("%-22s %8.2f %8.2f %8.2f %7zu   ", name, a.p50_us, a.p99_us, a.worst_us, a.count);
  if (b.count > 0)
    std::printf("%8.2f %8.2f %8.2f\n", b.p50_us, b.p99_us, b.worst_us);
  else
    std::printf("%8s\n", "-");
}

void print(const Figures& f) {
  std::printf(
      "the filter in %.0f s of LVMS, us%19s spatial %27s planar\n%-22s %8s %8s %8s %7s   %8s %8s "
      "%8s\n",
      kSpan.seconds(), "", "", "", "p50", "p99", "worst", "calls", "p50", "p99", "worst");
  print_row("predict, one IMU", f.spatial.predict, f.planar.predict);
  for (std::size_t i = 0; i < kUpdates.size(); ++i) {
    const std::string name = std::string("update, ") + kUpdates[i].name;
    print_row(name.c_str(), f.spatial.update[i], f.planar.update[i]);
  }
  print_row("rewind of 100 ms", f.spatial.short_rewind, f.planar.short_rewind);
  print_row("rewind of 1 s", f.spatial.long_rewind, f.planar.long_rewind);
  print_row("step with a rewind", f.step.any, {});
  print_row("step, rewind >= 100 ms", f.step.late, {});
  std::printf("steps: the least of %d runs, tick by tick\n", kStepRuns);
  std::printf("allocations in all steps: %zu%s\n", f.step.allocations,
              testing::kAllocationsCounted ? "" : " (not counted under AddressSanitizer)");
  std::printf(
      "peer, TUM FusionTracking (six states in the plane, Python): 2750 us mean, 5260 us p90 "
      "a cycle [published, arXiv 2310.08114]\n");
  std::printf("reference unit, us: beside the filter %.1f, beside the steps %.1f; %s\n%s",
              f.spatial.unit_us, f.step.unit_us, cost::machine_name().c_str(),
              f.gates().text().c_str());
}

std::string json_of(const Figures& f) {
  json::Object json;
  json.text("bench", "ekf");
  const auto add = [&json](const std::string& name, const Quantiles& q) {
    json.number(name + "_p50_us", q.p50_us)
        .number(name + "_p99_us", q.p99_us)
        .number(name + "_worst_us", q.worst_us)
        .number(name + "_calls", q.count);
  };
  const auto add_filter = [&](const std::string& name, const FilterFigures& figures) {
    add(name + "_predict", figures.predict);
    for (std::size_t i = 0; i < kUpdates.size(); ++i)
      add(name + "_update_" + kUpdates[i].name, figures.update[i]);
    add(name + "_rewind_100ms", figures.short_rewind);
    add(name + "_rewind_1s", figures.long_rewind);
  };
  add_filter("spatial", f.spatial);
  add_filter("planar", f.planar);
  add("step_rewind", f.step.any);
  add("step_rewind_100ms", f.step.late);
  const cost::CostGates gates = f.gates();
  return json.number("step_allocations", f.step.allocations)
             .text("machine", cost::machine_name())
             .json("gates", gates.json())
             .flag("held", gates.held())
             .str() +
         "\n";
}

}  // namespace

int bench_ekf(std::span<const std::string> args) {
  std::string json_file;
  CommandLine app{"pitwall-benchmarks ekf: what the filter of localization costs the car"};
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
