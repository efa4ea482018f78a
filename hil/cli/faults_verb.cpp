// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/faults_verb.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/cli/command_line.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/cli/fault_coverage/fault_matrix.hpp"
#include "hil/cli/fault_coverage/proof.hpp"
#include "hil/cli/fault_coverage/speeds.hpp"
#include "hil/sweep/in_parallel.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::cli {
namespace {

namespace fs = std::filesystem;
using fault_coverage::FaultRow;
using world::Monitor;

constexpr unsigned kFaultsWorkers = 2;

struct FaultsJob {
  const bench::Loaded* loaded;
  world::MonitorSet off;
};

Result<std::vector<bench::Loaded>, Problem> load_all(const std::string& folder,
                                                     const std::string& only,
                                                     std::optional<fault_coverage::Speed> speed) {
  std::error_code error;
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".yaml" &&
        entry.path().stem().string().find(only) != std::string::npos)
      files.push_back(entry.path().string());
  if (error) return Unexpected{Problem{folder, error.message()}};
  if (files.empty()) return Unexpected{Problem{folder, "no such scenario"}};
  std::ranges::sort(files);
  std::vector<bench::Loaded> all;
  for (const std::string& file : files) {
    auto loaded = bench::load(file, "");
    if (!loaded) return Unexpected{loaded.error()};
    if (speed) {
      auto twin = fault_coverage::at_speed(loaded->scenario, *speed);
      if (!twin) continue;
      loaded->scenario = *std::move(twin);
    }
    all.push_back(*std::move(loaded));
  }
  if (all.empty()) return Unexpected{Problem{"--speed", "the fault is not possible at this speed"}};
  return all;
}

Result<std::vector<FaultRow>, Problem> run(const std::vector<FaultsJob>& jobs) {
  std::vector<Result<FaultRow, Problem>> results(jobs.size(), FaultRow{});
  sweep::in_parallel(jobs.size(), kFaultsWorkers, [&](std::size_t i) {
    results[i] = fault_coverage::run_fault(*jobs[i].loaded, jobs[i].off);
  });
  std::vector<FaultRow> rows;
  for (auto& result : results) {
    if (!result) return Unexpected{result.error()};
    rows.push_back(*std::move(result));
  }
  return rows;
}

// What each monitor is needed for, by the scenarios that pass with it.
Result<std::vector<fault_coverage::Proof>, Problem> prove(const std::vector<bench::Loaded>& all,
                                                          const std::vector<FaultRow>& rows) {
  struct ProofJob {
    const bench::Loaded* loaded;
    Monitor monitor;
  };
  std::vector<fault_coverage::Proof> proofs(world::kMonitors);
  std::vector<ProofJob> jobs;
  for (std::size_t m = 0; m < world::kMonitors; ++m) {
    proofs[m].monitor = static_cast<Monitor>(m);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (rows[i].passed() && fault_coverage::asks(all[i].scenario, proofs[m].monitor))
        jobs.push_back({&all[i], proofs[m].monitor});
  }
  using Found = Result<std::optional<fault_coverage::Consequence>, Problem>;
  std::vector<Found> results(jobs.size(), Found{std::nullopt});
  sweep::in_parallel(jobs.size(), kFaultsWorkers, [&](std::size_t i) {
    results[i] = fault_coverage::consequence_without(jobs[i].monitor, *jobs[i].loaded);
  });
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (!results[i]) return Unexpected{results[i].error()};
    fault_coverage::Proof& proof = proofs[static_cast<std::size_t>(jobs[i].monitor)];
    proof.asked.push_back(jobs[i].loaded->scenario.name);
    if (*results[i]) proof.failed.push_back(**results[i]);
  }
  return proofs;
}

Result<world::MonitorSet, Problem> monitors_named(const std::vector<std::string>& names) {
  world::MonitorSet off;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(world::kMonitorNames, name);
    if (found == world::kMonitorNames.end())
      return Unexpected{Problem{"--without", "unknown monitor \"" + name + "\""}};
    off.add(static_cast<Monitor>(found - world::kMonitorNames.begin()));
  }
  return off;
}

// None: each scenario at the speed at which it is written.
Result<std::optional<fault_coverage::Speed>, Problem> speed_named(const std::string& name) {
  if (name.empty()) return std::optional<fault_coverage::Speed>{};
  const auto found = std::ranges::find(fault_coverage::kSpeedNames, name);
  if (found == fault_coverage::kSpeedNames.end())
    return Unexpected{Problem{"--speed", "\"" + name + "\" is not one of: walking yellow racing"}};
  return std::optional{
      static_cast<fault_coverage::Speed>(found - fault_coverage::kSpeedNames.begin())};
}

struct FaultsOptions {
  std::string folder = "hil/scenarios/faults", only, json_file;
  std::vector<std::string> without;
  std::string speed;
  bool prove = false;
};

Result<int, Problem> judge(const FaultsOptions& options) {
  const auto off = monitors_named(options.without);
  if (!off) return Unexpected{off.error()};
  const auto speed = speed_named(options.speed);
  if (!speed) return Unexpected{speed.error()};
  const auto all = load_all(options.folder, options.only, *speed);
  if (!all) return Unexpected{all.error()};
  const Instant begun = transport::monotonic_now();
  std::vector<FaultsJob> jobs;
  for (const bench::Loaded& loaded : *all) jobs.push_back({&loaded, *off});
  const auto rows = run(jobs);
  if (!rows) return Unexpected{rows.error()};
  double simulated_s = 0.0;
  for (const FaultRow& row : *rows) simulated_s += row.simulated_s;
  std::printf("%s%.0f s simulated in %.1f s\n", fault_coverage::to_text(*rows).c_str(), simulated_s,
              (transport::monotonic_now() - begun).seconds());
  std::vector<fault_coverage::Proof> proofs;
  if (options.prove) {
    auto proven = prove(*all, *rows);
    if (!proven) return Unexpected{proven.error()};
    proofs = *std::move(proven);
    if (!options.only.empty())
      std::erase_if(proofs, [](const fault_coverage::Proof& proof) { return proof.asked.empty(); });
    std::printf("%s", fault_coverage::to_text(proofs).c_str());
  }
  if (!options.json_file.empty()) {
    const auto written =
        transport::write_file(options.json_file, fault_coverage::to_json(*rows, proofs));
    if (!written) return Unexpected{written.error()};
  }
  const bool is_part = !options.only.empty() || *speed;
  const bool whole = is_part || fault_coverage::holes(*rows).empty();
  const bool needed = std::ranges::all_of(proofs, [](const fault_coverage::Proof& proof) {
    return fault_coverage::open_point(proof).empty();
  });
  return whole && needed && std::ranges::all_of(*rows, &FaultRow::passed) ? kExitPass : kExitFailed;
}

}  // namespace

int faults_verb(std::span<const std::string> args) {
  FaultsOptions options;
  CommandLine app{"pitwall-hil faults: every fault of the catalogue, and who noticed it how fast"};
  app.option("--folder", options.folder, "of the scenarios; default " + options.folder);
  app.option("--only", options.only, "only scenarios whose name contains this");
  app.option("--without", options.without, "switch this monitor off; may be given again");
  app.option("--speed", options.speed, "every fault at this one: walking, yellow or racing");
  app.flag("--prove", options.prove,
           "switch each monitor off once: the car must do something else");
  app.option("--json", options.json_file, "write the matrix here");
  if (const auto code = app.ended_by(args)) return *code;
  const auto code = judge(options);
  return code ? *code : refuse(code.error());
}

}  // namespace pitwall::cli
