// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/step/bench_step.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "hil/bench/loading.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/transport/file.hpp"
#include "tests/benchmarks/command_line.hpp"
#include "tests/benchmarks/cost/cost_gates.hpp"
#include "tests/benchmarks/cost/machine_name.hpp"
#include "tests/benchmarks/cost/quantiles.hpp"
#include "tests/benchmarks/step/lockstep_speed.hpp"
#include "tests/benchmarks/step/step_times.hpp"

namespace pitwall::benchmarks {
namespace {

constexpr int kRuns = 5;
// On the reference machine, see tests/benchmarks/cost/cost_gates.hpp.
constexpr double kStepLimit_us = 100.0;        // half of the steps
constexpr double kBusyStepLimit_us = 1'200.0;  // p99: those that plan, or redo late measurements

// Prints the verdict; writes `json`, and what all benchmarks say at its end, into a file.
int end(const cost::CostGates& gates, json::Object json, const std::string& json_file) {
  const std::string machine = cost::machine_name();
  std::printf("%s\n%s", machine.c_str(), gates.text().c_str());
  json.text("machine", machine).json("gates", gates.json()).flag("held", gates.held());
  if (!json_file.empty()) {
    const auto written = transport::write_file(json_file, json.str() + "\n");
    if (!written) return refuse(written.error());
  }
  return gates.held() ? kExitPass : kExitFailed;
}

int measure_step(const std::string& json_file) {
  const auto loaded = bench::load(kBenchScenario, "");
  if (!loaded) return refuse(loaded.error());
  const auto times = time_steps(*loaded);
  if (!times) return refuse(times.error());
  std::vector<double> took_us;
  for (const StepTime& step : times->steps) took_us.push_back(step.least_us);
  const Quantiles step = quantiles_of(std::move(took_us));
  std::printf(
      "pipeline step over %.0f s of LVMS, %zu steps, us of processor time, the least of %d runs\n"
      "%8s %8s %8s %16s\n%8.1f %8.1f %8.1f %16.1f\n",
      loaded->scenario.duration.seconds(), step.count, kStepRuns, "p50", "p99", "max",
      "reference unit", step.p50_us, step.p99_us, step.worst_us, times->unit_us);
  cost::CostGates gates;
  gates.at_most({"a step, p50", step.p50_us, times->unit_us, kStepLimit_us});
  gates.at_most({"a step, p99", step.p99_us, times->unit_us, kBusyStepLimit_us});
  return end(gates,
             json::Object{}
                 .text("bench", "step")
                 .number("p50_us", step.p50_us)
                 .number("p99_us", step.p99_us)
                 .number("max_us", step.worst_us),
             json_file);
}

void print_runs(const char* name, const std::vector<LockstepCost>& runs) {
  const auto [least, most] = std::minmax_element(
      runs.begin(), runs.end(),
      [](const auto& a, const auto& b) { return a.times_real_time() < b.times_real_time(); });
  const LockstepCost median = median_of(runs);
  std::printf("%-22s %8.1f %8.1f %8.1f %16.1f %16.1f\n", name, least->times_real_time(),
              median.times_real_time(), most->times_real_time(), median.unit_us, median.units());
}

int measure_lockstep(const std::string& json_file) {
  const auto loaded = bench::load(kBenchScenario, "");
  if (!loaded) return refuse(loaded.error());
  std::printf(
      "lockstep, %.0f s of LVMS, times real time by processor time, %d runs\n"
      "%-22s %8s %8s %8s %16s %16s\n",
      loaded->scenario.duration.seconds(), kRuns, "", "least", "median", "most", "us of one unit",
      "units a second");
  cost::CostGates gates;
  json::Object json;
  json.text("bench", "lockstep");
  for (const bool with_log : {false, true}) {
    std::vector<LockstepCost> runs;
    for (int i = 0; i < kRuns; ++i) {
      const auto run = lockstep_cost(*loaded, with_log);
      if (!run) return refuse(run.error());
      runs.push_back(*run);
    }
    const char* name = with_log ? "with event log" : "without event log";
    print_runs(name, runs);
    const LockstepCost median = median_of(std::move(runs));
    json.number(with_log ? "with_log" : "without_log", median.times_real_time());
    gates.at_most(lockstep_gate(median, std::string(" ") + name + ", median"));
  }
  return end(gates, json, json_file);
}

// Understands `--json FILE`, whose folder must be there before minutes are spent.
int measured(std::span<const std::string> args, const std::string& what,
             int (*measure)(const std::string& json_file)) {
  std::string json_file;
  CommandLine app{"pitwall-benchmarks " + what};
  app.option("--json", json_file, "write the figures here");
  if (const auto code = app.ended_by(args)) return *code;
  const std::filesystem::path folder = std::filesystem::path(json_file).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder))
    return refuse({json_file, "its folder is not there; make it, or name another file"});
  return measure(json_file);
}

}  // namespace

int bench_step(std::span<const std::string> args) {
  return measured(args, "step: processor time of one step of the car", measure_step);
}

int bench_lockstep(std::span<const std::string> args) {
  return measured(args, "lockstep: closed loop in virtual time, against real time",
                  measure_lockstep);
}

}  // namespace pitwall::benchmarks
