// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/bench_control.hpp"

#include <cstdio>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/plant/plant_file.hpp"
#include "hil/sweep/in_parallel.hpp"
#include "protocol/transport/file.hpp"
#include "tests/benchmarks/command_line.hpp"
#include "tests/benchmarks/control/control_cost.hpp"
#include "tests/benchmarks/control/control_plan.hpp"
#include "tests/benchmarks/control/control_table.hpp"

namespace pitwall::benchmarks {
namespace {

using control_bench::ControlCost;
using control_bench::ControlRow;
using control_bench::NamedLaw;
using control_bench::World;

const std::vector<NamedLaw> kLaws{{control::LateralLaw::kPaperLqr, control_bench::kPaper},
                                  {control::LateralLaw::kFeedForward, control_bench::kOurs}};
constexpr unsigned kWorkers = 2;

struct Job {
  control_bench::Plan plan;
  pipeline::Setup setup;
  std::string law;
  World world;
};

Result<Job, Problem> job_of(const bench::Loaded& on, const World& world, const NamedLaw& law) {
  Job job{.plan = control_bench::plan_of(on.scenario, on.setup.track.length_m()),
          .setup = on.setup,
          .law = law.name,
          .world = world};
  job.setup.params.control.drive_law = law.law;
  job.plan.scenario.perturb = world.perturb;
  if (world.plant) job.plan.scenario.plant = *world.plant;
  if (world.plant_file.empty()) return job;
  const auto text = transport::read_file(world.plant_file);
  if (!text) return Unexpected{text.error()};
  const auto plant = plant::read_plant(*text, world.plant_file);
  if (!plant) return Unexpected{plant.error()};
  job.plan.scenario.plant_file = world.plant_file;
  job.plan.scenario.plant = plant->params;
  return job;
}

std::vector<World> worlds_of(const std::string& only, std::size_t family) {
  std::vector<World> worlds = control_bench::worlds();
  std::erase_if(worlds, [&](const World& world) {
    return world.name != laps::kNominal && world.name.find(only) == std::string::npos;
  });
  const std::vector<World> drawn = control_bench::family_worlds(family);
  worlds.insert(worlds.end(), drawn.begin(), drawn.end());
  return worlds;
}

Result<std::vector<Job>, Problem> jobs_of(const std::vector<World>& worlds) {
  std::vector<Job> jobs;
  for (const char* file : laps::kScenarios) {
    const auto on = bench::load(file, "");
    if (!on) return Unexpected{on.error()};
    for (const World& world : worlds) {
      for (const NamedLaw& law : kLaws) {
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
    rows.back().world = jobs[i].world.name;
    rows.back().is_judged = jobs[i].world.is_judged();
    rows.back().law = jobs[i].law;
  }
  return rows;
}

Result<ControlCost, Problem> cost_of_laws() {
  const auto on = bench::load(laps::kScenarios.front(), "");
  if (!on) return Unexpected{on.error()};
  return control_bench::measure_cost(*on, kLaws);
}

}  // namespace

int bench_control(std::span<const std::string> args) {
  std::string only, json_file;
  std::size_t family = 0;
  CommandLine app{"pitwall-benchmarks control: control laws at held speeds on three ovals"};
  app.option("--only", only, "only worlds whose name contains this, and the nominal one");
  app.option("--family", family, "so many drawn cars too, which are printed alone");
  app.option("--json", json_file, "write rows and gates here");
  if (const auto code = app.ended_by(args)) return *code;
  const auto jobs = jobs_of(worlds_of(only, family));
  if (!jobs) return refuse(jobs.error());
  const auto rows = drive(*jobs);
  if (!rows) return refuse(rows.error());
  std::printf("%s%zu runs\n", control_bench::to_text(*rows).c_str(), rows->size());
  const auto cost = cost_of_laws();
  if (!cost) return refuse(cost.error());
  const cost::CostGates cost_gates = control_bench::gates_of(*cost);
  const bool held = control_bench::all_held(*rows) && cost_gates.held();
  std::printf("%s%s", control_bench::to_text(*cost).c_str(), cost_gates.text().c_str());
  if (!json_file.empty()) {
    const auto written =
        transport::write_file(json_file, control_bench::to_json(*rows, cost_gates));
    if (!written) return refuse(written.error());
  }
  return held ? kExitPass : kExitFailed;
}

}  // namespace pitwall::benchmarks
