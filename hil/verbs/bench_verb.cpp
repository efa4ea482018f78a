// SPDX-License-Identifier: Apache-2.0
#include "hil/verbs/bench_verb.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/bench/lockstep.hpp"
#include "hil/verbs/bench_dbc.hpp"
#include "hil/verbs/bench_ekf.hpp"
#include "hil/verbs/bench_gateway.hpp"
#include "hil/verbs/bench_gnss.hpp"
#include "hil/verbs/bench_laps.hpp"
#include "hil/verbs/bench_plant.hpp"
#include "hil/verbs/bench_radio.hpp"
#include "hil/verbs/bench_replay.hpp"
#include "hil/verbs/command_line.hpp"
#include "hil/verbs/exit_code.hpp"
#include "hil/verbs/lockstep_speed.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::verbs {
namespace {

constexpr double kLeastTimesRealTime = 50.0;
constexpr int kRuns = 5;
constexpr double kStepLimit_us = 100.0;        // half of the steps
constexpr double kBusyStepLimit_us = 1'200.0;  // p99: those that plan, or redo late measurements

struct StepFigures {
  double p50_us = 0.0, p99_us = 0.0, max_us = 0.0;
  std::size_t steps = 0;
};

// The car's step inside the closed loop, fed with what a lap feeds it.
Result<StepFigures, Problem> time_steps(const bench::Loaded& loaded) {
  std::vector<double> took_us;
  took_us.reserve(
      static_cast<std::size_t>(loaded.scenario.duration / loaded.setup.params.rates.tick) + 1);
  bench::LockstepOptions options;
  options.step = [&took_us](const pipeline::Setup& setup, pipeline::Car& car,
                            const pipeline::Inputs& in) {
    const Instant begun = transport::monotonic_now();
    const pipeline::Outputs out = pipeline::step(setup, car, in);
    took_us.push_back(static_cast<double>((transport::monotonic_now() - begun).ns) * 1e-3);
    return out;
  };
  const auto result = bench::run_lockstep(loaded.scenario, loaded.setup, options);
  if (!result) return Unexpected{result.error()};
  std::sort(took_us.begin(), took_us.end());
  const auto quantile = [&took_us](double q) {
    return took_us[static_cast<std::size_t>(q * static_cast<double>(took_us.size() - 1))];
  };
  return StepFigures{quantile(0.5), quantile(0.99), took_us.back(), took_us.size()};
}

int bench_step(const std::string& json_file) {
  const auto loaded = bench::load(kBenchScenario, "");
  if (!loaded) return refuse(loaded.error());
  const auto figures = time_steps(*loaded);
  if (!figures) return refuse(figures.error());
  const bool held = figures->p50_us < kStepLimit_us && figures->p99_us < kBusyStepLimit_us;
  std::printf("pipeline step over %.0f s of LVMS, %zu steps, us\n%8s %8s %8s\n%8.1f %8.1f %8.1f\n",
              loaded->scenario.duration.seconds(), figures->steps, "p50", "p99", "max",
              figures->p50_us, figures->p99_us, figures->max_us);
  std::printf("gate: p50 below %.0f us, p99 below %.0f us: %s\n", kStepLimit_us, kBusyStepLimit_us,
              held ? "held" : "MISSED");
  if (!json_file.empty()) {
    const auto written = transport::write_file(
        json_file, "{\"bench\":\"step\",\"p50_us\":" + std::to_string(figures->p50_us) +
                       ",\"p99_us\":" + std::to_string(figures->p99_us) +
                       ",\"max_us\":" + std::to_string(figures->max_us) +
                       ",\"held\":" + (held ? "true" : "false") + "}\n");
    if (!written) return refuse(written.error());
  }
  return held ? kExitPass : kExitFailed;
}

int bench_lockstep(const std::string& json_file) {
  const auto loaded = bench::load(kBenchScenario, "");
  if (!loaded) return refuse(loaded.error());
  std::string json =
      "{\"bench\":\"lockstep\",\"gate_times_real_time\":" + std::to_string(kLeastTimesRealTime);
  bool held = true;
  std::printf(
      "lockstep, %.0f s of LVMS, times real time by processor time, %d runs\n%-22s %8s %8s %8s\n",
      loaded->scenario.duration.seconds(), kRuns, "", "least", "median", "most");
  for (const bool with_log : {false, true}) {
    std::vector<double> speeds;
    for (int i = 0; i < kRuns; ++i) {
      const auto speed = times_real_time(*loaded, with_log);
      if (!speed) return refuse(speed.error());
      speeds.push_back(*speed);
    }
    std::sort(speeds.begin(), speeds.end());
    const double median = speeds[kRuns / 2];
    std::printf("%-22s %8.1f %8.1f %8.1f\n", with_log ? "with event log" : "without event log",
                speeds.front(), median, speeds.back());
    json += std::string(",\"") + (with_log ? "with_log" : "without_log") +
            "\":" + std::to_string(median);
    held = held && median >= kLeastTimesRealTime;
  }
  std::printf("gate: median at least %.0f times real time: %s\n", kLeastTimesRealTime,
              held ? "held" : "MISSED");
  if (!json_file.empty()) {
    const auto written =
        transport::write_file(json_file, json + ",\"held\":" + (held ? "true" : "false") + "}\n");
    if (!written) return refuse(written.error());
  }
  return held ? kExitPass : kExitFailed;
}

}  // namespace

int bench_verb(std::span<const std::string> args) {
  if (!args.empty() && args[0] == "replay") return bench_replay(args.subspan(1));
  if (!args.empty() && args.front() == "gateway") return bench_gateway(args.subspan(1));
  if (!args.empty() && args.front() == "ekf") return bench_ekf(args.subspan(1));
  if (!args.empty() && args.front() == "gnss") return bench_gnss(args.subspan(1));
  if (!args.empty() && args.front() == "plant") return bench_plant(args.subspan(1));
  if (!args.empty() && args.front() == "dbc") return bench_dbc(args.subspan(1));
  if (!args.empty() && args.front() == "laps") return bench_laps(args.subspan(1));
  if (!args.empty() && args.front() == "radio") return bench_radio(args.subspan(1));
  std::string name, json_file;
  CommandLine app{"pitwall-hil bench: benchmarks with gates"};
  app.option("name", name, "dbc, ekf, gateway, gnss, laps, lockstep, plant, radio, replay or step")
      .required();
  app.option("--json", json_file, "write the figures here");
  if (const auto code = app.ended_by(args)) return *code;
  if (name == "lockstep") return bench_lockstep(json_file);
  if (name == "step") return bench_step(json_file);
  return refuse(
      {"bench",
       "unknown name \"" + name +
           "\"; known: dbc, ekf, gateway, gnss, laps, lockstep, plant, radio, replay, step"});
}

}  // namespace pitwall::verbs
