// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/bench_speed.hpp"

#include <array>
#include <cstdio>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/sweep/in_parallel.hpp"
#include "protocol/transport/file.hpp"
#include "tests/benchmarks/command_line.hpp"
#include "tests/benchmarks/control/speed_table.hpp"

namespace pitwall::benchmarks {
namespace {

using speed_bench::SpeedRow;

constexpr std::array kControllers{control_bench::kPaper, control_bench::kOurs};
constexpr unsigned kAtATime = 2;

struct SpeedJob {
  speed_bench::Plan plan;
  pipeline::Setup setup;
  std::string world, law;
};

Result<std::vector<SpeedJob>, Problem> speed_jobs(const std::string& only) {
  std::vector<SpeedJob> jobs;
  for (const char* file : laps::kScenarios) {
    const auto on = bench::load(file, "");
    if (!on) return Unexpected{on.error()};
    for (const control_bench::World& world : speed_bench::cars()) {
      if (world.name.find(only) == std::string::npos) continue;
      for (const char* law : kControllers) {
        SpeedJob job{.plan = speed_bench::plan_of(on->scenario, on->setup.params.planning),
                     .setup = on->setup,
                     .world = world.name,
                     .law = law};
        job.setup.params.control.controller = control::controller_named(law);
        const auto there = control_bench::in_world(job.plan.scenario, world);
        if (!there) return Unexpected{there.error()};
        job.plan.scenario = *there;
        jobs.push_back(std::move(job));
      }
    }
  }
  return jobs;
}

Result<std::vector<SpeedRow>, Problem> drive_speeds(const std::vector<SpeedJob>& jobs) {
  std::vector<Result<SpeedRow, Problem>> results(jobs.size(), SpeedRow{});
  sweep::in_parallel(jobs.size(), kAtATime, [&](std::size_t i) {
    results[i] = speed_bench::run_speed(jobs[i].plan, jobs[i].setup);
  });
  std::vector<SpeedRow> rows;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (!results[i]) return Unexpected{results[i].error()};
    rows.push_back(*results[i]);
    rows.back().world = jobs[i].world;
    rows.back().law = jobs[i].law;
  }
  return rows;
}

}  // namespace

int bench_speed(std::span<const std::string> args) {
  std::string only, json_file;
  CommandLine app{"pitwall-benchmarks speed: longitudinal laws through the same calls"};
  app.option("--only", only, "only cars whose name contains this");
  app.option("--json", json_file, "write rows and gates here");
  if (const auto code = app.ended_by(args)) return *code;
  const auto jobs = speed_jobs(only);
  if (!jobs) return refuse(jobs.error());
  const auto rows = drive_speeds(*jobs);
  if (!rows) return refuse(rows.error());
  std::printf("%s%zu runs\n", speed_bench::to_text(*rows).c_str(), rows->size());
  if (!json_file.empty()) {
    const auto written = transport::write_file(json_file, speed_bench::to_json(*rows));
    if (!written) return refuse(written.error());
  }
  return speed_bench::all_held(*rows) ? kExitPass : kExitFailed;
}

}  // namespace pitwall::benchmarks
