// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/bench_control.hpp"

#include <array>
#include <cstdio>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/sweep/in_parallel.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/transport/file.hpp"
#include "tests/benchmarks/command_line.hpp"
#include "tests/benchmarks/control/control_cost.hpp"
#include "tests/benchmarks/control/control_plan.hpp"
#include "tests/benchmarks/control/control_table.hpp"
#include "tests/benchmarks/control/lane_changes.hpp"
#include "tests/benchmarks/control/planner_cost.hpp"

namespace pitwall::benchmarks {
namespace {

using control_bench::ControlCost;
using control_bench::ControlRow;
using control_bench::Gate;
using control_bench::LaneChangeRow;
using control_bench::PlannerCost;
using control_bench::World;

constexpr std::array kLaws{control_bench::kPaper, control_bench::kOfStops, control_bench::kOurs};
constexpr unsigned kWorkers = 2;

struct Job {
  control_bench::Plan plan, lane_changes;
  pipeline::Setup setup;
  std::string law;
  World world;
};

Result<Job, Problem> job_of(const bench::Loaded& on, const World& world, const char* law) {
  const auto there = control_bench::in_world(on.scenario, world);
  if (!there) return Unexpected{there.error()};
  Job job{.plan = control_bench::plan_of(*there, on.setup.track.length_m()),
          .lane_changes = control_bench::lane_change_plan(*there),
          .setup = on.setup,
          .law = law,
          .world = world};
  job.setup.params.control.controller = control::controller_named(law);
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
      for (const char* law : kLaws) {
        auto job = job_of(*on, world, law);
        if (!job) return Unexpected{job.error()};
        jobs.push_back(*std::move(job));
      }
    }
  }
  return jobs;
}

template <class Row>
Result<std::vector<Row>, Problem> drive(const std::vector<Job>& jobs,
                                        Result<Row, Problem> (*run)(const Job&)) {
  std::vector<Result<Row, Problem>> results(jobs.size(), Row{});
  sweep::in_parallel(jobs.size(), kWorkers, [&](std::size_t i) { results[i] = run(jobs[i]); });
  std::vector<Row> rows;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (!results[i]) return Unexpected{results[i].error()};
    rows.push_back(*results[i]);
    rows.back().world = jobs[i].world.name;
    rows.back().is_judged = jobs[i].world.is_judged();
    rows.back().law = jobs[i].law;
  }
  return rows;
}

Result<ControlRow, Problem> held_speeds(const Job& job) {
  return control_bench::run_control(job.plan, job.setup);
}
Result<LaneChangeRow, Problem> lane_changes(const Job& job) {
  return control_bench::run_lane_changes(job.lane_changes, job.setup);
}

// Each car; the perturbations of the AV-21 change lanes as it does.
std::vector<Job> changing_lanes(std::vector<Job> jobs) {
  std::erase_if(jobs, [](const Job& job) {
    return job.world.name != laps::kNominal && job.world.plant_file.empty() && !job.world.plant;
  });
  return jobs;
}

Result<ControlCost, Problem> cost_of_laws() {
  const auto on = bench::load(laps::kScenarios.front(), "");
  if (!on) return Unexpected{on.error()};
  return control_bench::measure_cost(*on, {kLaws.begin(), kLaws.end()});
}

Result<PlannerCost, Problem> cost_of_planning() {
  const auto match = bench::load("hil/scenarios/matches/match_won.yaml", "");
  if (!match) return Unexpected{match.error()};
  return control_bench::measure_planner(*match);
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
  const auto rows = drive<ControlRow>(*jobs, held_speeds);
  if (!rows) return refuse(rows.error());
  const auto changes = drive<LaneChangeRow>(changing_lanes(*jobs), lane_changes);
  if (!changes) return refuse(changes.error());
  const auto cost = cost_of_laws();
  if (!cost) return refuse(cost.error());
  const auto planner = cost_of_planning();
  if (!planner) return refuse(planner.error());
  std::vector<Gate> gates = gates_of(*rows);
  for (const Gate& gate : gates_of(*changes)) gates.push_back(gate);
  const cost::CostGates cost_gates = gates_of(*cost), planner_gates = gates_of(*planner);
  std::printf("%s%s%s%s%s%s%s%zu runs\n", to_text(*rows).c_str(), to_text(*changes).c_str(),
              to_text(*cost).c_str(), to_text(*planner).c_str(), to_text(gates).c_str(),
              cost_gates.text().c_str(), planner_gates.text().c_str(),
              rows->size() + changes->size());
  const bool held = all_held(gates) && cost_gates.held() && planner_gates.held();
  if (!json_file.empty()) {
    const auto written =
        transport::write_file(json_file, json::Object{}
                                                 .text("bench", "control")
                                                 .flag("simulation", true)
                                                 .json("rows", to_json(*rows))
                                                 .json("lane_changes", to_json(*changes))
                                                 .json("gates", to_json(gates))
                                                 .json("cost_gates", cost_gates.json())
                                                 .json("planner_gates", planner_gates.json())
                                                 .flag("held", held)
                                                 .str() +
                                             "\n");
    if (!written) return refuse(written.error());
  }
  return held ? kExitPass : kExitFailed;
}

}  // namespace pitwall::benchmarks
