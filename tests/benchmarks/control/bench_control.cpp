// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/bench_control.hpp"

#include <array>
#include <cstdio>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/plant/plant_file.hpp"
#include "hil/sweep/in_parallel.hpp"
#include "protocol/transport/file.hpp"
#include "tests/benchmarks/command_line.hpp"
#include "tests/benchmarks/control/control_plan.hpp"
#include "tests/benchmarks/control/control_table.hpp"

namespace pitwall::benchmarks {
namespace {

using control_bench::ControlRow;
using control_bench::World;

constexpr std::array kLaws{control_bench::kPaper, control_bench::kOurs};
constexpr unsigned kWorkers = 2;

struct Job {
  control_bench::Plan plan;
  pipeline::Setup setup;
  std::string world, law;
};

Result<Job, Problem> job_of(const bench::Loaded& on, const World& world, const char* law) {
  Job job{.plan = control_bench::plan_of(on.scenario, on.setup.track.length_m()),
          .setup = on.setup,
          .world = world.name,
          .law = law};
  job.setup.params.control.controller = control::controller_named(law);
  job.plan.scenario.perturb = world.perturb;
  if (world.plant_file.empty()) return job;
  const auto text = transport::read_file(world.plant_file);
  if (!text) return Unexpected{text.error()};
  const auto plant = plant::read_plant(*text, world.plant_file);
  if (!plant) return Unexpected{plant.error()};
  job.plan.scenario.plant_file = world.plant_file;
  job.plan.scenario.plant = plant->params;
  return job;
}

Result<std::vector<Job>, Problem> jobs_of(const std::string& only) {
  std::vector<Job> jobs;
  for (const char* file : laps::kScenarios) {
    const auto on = bench::load(file, "");
    if (!on) return Unexpected{on.error()};
    for (const World& world : control_bench::worlds()) {
      if (world.name != laps::kNominal && world.name.find(only) == std::string::npos) continue;
      for (const char* law : kLaws) {
        auto job = job_of(*on, world, law);
        if (!job) return Unexpected{job.error()};
        jobs.push_back(*std::move(job));
      }
    }
  }
  return jobs;
}

Result<std::vector<ControlRow>, Problem> drive(const std::vector<Job>& jobs) {
  std::vector<Result<ControlRow, Problem>> results(jobs.size(), ControlRow{});
  sweep::in_parallel(jobs.size(), kWorkers, [&](std::size_t i) {
    results[i] = control_bench::run_control(jobs[i].plan, jobs[i].setup);
  });
  std::vector<ControlRow> rows;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (!results[i]) return Unexpected{results[i].error()};
    rows.push_back(*results[i]);
    rows.back().world = jobs[i].world;
    rows.back().law = jobs[i].law;
  }
  return rows;
}

}  // namespace

int bench_control(std::span<const std::string> args) {
  std::string only, json_file;
  CommandLine app{"pitwall-benchmarks control: control laws at held speeds on three ovals"};
  app.option("--only", only, "only worlds whose name contains this, and the nominal one");
  app.option("--json", json_file, "write rows and gates here");
  if (const auto code = app.ended_by(args)) return *code;
  const auto jobs = jobs_of(only);
  if (!jobs) return refuse(jobs.error());
  const auto rows = drive(*jobs);
  if (!rows) return refuse(rows.error());
  std::printf("%s%zu runs\n", control_bench::to_text(*rows).c_str(), rows->size());
  if (!json_file.empty()) {
    const auto written = transport::write_file(json_file, control_bench::to_json(*rows));
    if (!written) return refuse(written.error());
  }
  return control_bench::all_held(*rows) ? kExitPass : kExitFailed;
}

}  // namespace pitwall::benchmarks
