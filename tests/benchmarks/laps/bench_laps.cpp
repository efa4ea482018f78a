// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/laps/bench_laps.hpp"

#include <atomic>
#include <cstdio>
#include <utility>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/sweep/in_parallel.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "tests/benchmarks/command_line.hpp"
#include "tests/benchmarks/laps/lap_plan.hpp"
#include "tests/benchmarks/laps/lap_table.hpp"
#include "vehicle/parameters/track_file.hpp"

namespace pitwall::benchmarks {
namespace {

constexpr unsigned kWorkers = 2;

struct Job {
  const bench::Loaded* on;
  laps::Case what;
};

Result<std::vector<bench::Loaded>, Problem> shipped() {
  std::vector<bench::Loaded> all;
  for (const char* file : laps::kScenarios) {
    auto loaded = bench::load(file, "");
    if (!loaded) return Unexpected{loaded.error()};
    all.push_back(*std::move(loaded));
  }
  return all;
}

// The first scenario's car and calls, on another track.
Result<std::vector<bench::Loaded>, Problem> custom(const std::string& track_file) {
  const auto like = bench::load(laps::kScenarios.front(), "");
  if (!like) return Unexpected{like.error()};
  const auto text = transport::read_file(track_file);
  if (!text) return Unexpected{text.error()};
  const auto track = parameters::read_track(*text, track_file);
  if (!track) return Unexpected{track.error()};
  auto setup = pipeline::prepare(like->setup.params, *track);
  if (!setup) return Unexpected{setup.error()};
  scenario::Scenario scenario = laps::flying_laps_of(like->scenario, *setup, track_file);
  std::vector<bench::Loaded> all;
  all.push_back({std::move(scenario), *std::move(setup)});
  return all;
}

Result<std::vector<laps::LapRow>, Problem> drive(const std::vector<Job>& jobs) {
  std::vector<Result<laps::LapRow, Problem>> results(jobs.size(), laps::LapRow{});
  std::atomic<std::size_t> next = 0;
  sweep::in_parallel(jobs.size(), kWorkers, [&](std::size_t i) {
    scenario::Scenario scenario = jobs[i].on->scenario;
    scenario.perturb = jobs[i].what.perturb;
    results[i] = laps::run_laps(scenario, jobs[i].on->setup);
    if (results[i]) results[i]->perturbation = jobs[i].what.name;
  });
  std::vector<laps::LapRow> rows;
  for (const auto& result : results) {
    if (!result) return Unexpected{result.error()};
    rows.push_back(*result);
  }
  return rows;
}

}  // namespace

int bench_laps(std::span<const std::string> args) {
  std::string track_file, only, json_file;
  CommandLine app{"pitwall-benchmarks laps: three ovals, nominal and perturbed"};
  app.option("--track", track_file, "another track (YAML) instead of the three");
  app.option("--only", only, "only perturbations whose name contains this, and the nominal one");
  app.option("--json", json_file, "write the rows here");
  if (const auto code = app.ended_by(args)) return *code;
  const auto tracks = track_file.empty() ? shipped() : custom(track_file);
  if (!tracks) return refuse(tracks.error());
  std::vector<Job> jobs;
  for (const bench::Loaded& on : *tracks)
    for (const laps::Case& what : laps::cases())
      if (what.name == laps::kNominal || what.name.find(only) != std::string::npos)
        jobs.push_back({&on, what});
  const Instant begun = transport::monotonic_now();
  const auto rows = drive(jobs);
  if (!rows) return refuse(rows.error());
  std::printf("%s%zu runs in %.1f s\n", laps::to_text(*rows).c_str(), rows->size(),
              (transport::monotonic_now() - begun).seconds());
  if (!json_file.empty()) {
    const auto written = transport::write_file(json_file, laps::to_json(*rows));
    if (!written) return refuse(written.error());
  }
  return laps::gates_of(*rows).held() ? kExitPass : kExitFailed;
}

}  // namespace pitwall::benchmarks
