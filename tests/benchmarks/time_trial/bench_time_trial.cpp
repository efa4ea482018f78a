// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/time_trial/bench_time_trial.hpp"

#include <cstdio>
#include <utility>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/sweep/in_parallel.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "tests/benchmarks/command_line.hpp"
#include "tests/benchmarks/time_trial/trial_plan.hpp"
#include "tests/benchmarks/time_trial/trial_table.hpp"

namespace pitwall::benchmarks {
namespace {

using time_trial::Change;
using time_trial::TrialRow;

constexpr unsigned kWorkers = 2;

struct Job {
  Change change;
  std::uint64_t seed = 1;
};

std::vector<Job> jobs(std::uint64_t seeds) {
  std::vector<Job> out;
  for (const Change& change : time_trial::changes()) {
    const std::uint64_t last = out.empty() ? seeds : 1;
    for (std::uint64_t seed = 1; seed <= last; ++seed) out.push_back({change, seed});
  }
  return out;
}

Result<TrialRow, Problem> drive(const bench::Loaded& flying_laps, const Job& job) {
  const auto trial = time_trial::trial_of(flying_laps, job.change, job.seed);
  if (!trial) return Unexpected{trial.error()};
  auto row = time_trial::run_trial(trial->scenario, trial->setup);
  if (row) row->name = job.change.name;
  return row;
}

}  // namespace

int bench_time_trial(std::span<const std::string> args) {
  std::string json_file;
  int seeds = 20;  // of the first change; one of each other
  CommandLine app{"pitwall-benchmarks time_trial: laps of Las Vegas at the limit"};
  app.option("--json", json_file, "write the rows here");
  app.option("--seeds", seeds, "of the first run; one of each other").range(1, 1000);
  if (const auto code = app.ended_by(args)) return *code;
  const auto flying_laps = bench::load(time_trial::kScenario, "");
  if (!flying_laps) return refuse(flying_laps.error());
  const std::vector<Job> all = jobs(static_cast<std::uint64_t>(seeds));
  const Instant begun = transport::monotonic_now();
  std::vector<Result<TrialRow, Problem>> results(all.size(), TrialRow{});
  sweep::in_parallel(all.size(), kWorkers,
                     [&](std::size_t i) { results[i] = drive(*flying_laps, all[i]); });
  std::vector<TrialRow> rows;
  for (const auto& result : results) {
    if (!result) return refuse(result.error());
    rows.push_back(*result);
  }
  std::printf("%s%zu runs in %.1f s\n", time_trial::to_text(rows).c_str(), rows.size(),
              (transport::monotonic_now() - begun).seconds());
  if (!json_file.empty()) {
    const auto written = transport::write_file(json_file, time_trial::to_json(rows));
    if (!written) return refuse(written.error());
  }
  return time_trial::gates_of(rows).held() ? kExitPass : kExitFailed;
}

}  // namespace pitwall::benchmarks
