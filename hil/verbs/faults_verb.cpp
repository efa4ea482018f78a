// SPDX-License-Identifier: Apache-2.0
#include "hil/verbs/faults_verb.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/matrix/fault_matrix.hpp"
#include "hil/sweep/in_parallel.hpp"
#include "hil/verbs/command_line.hpp"
#include "hil/verbs/exit_code.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::verbs {
namespace {

namespace fs = std::filesystem;
using matrix::FaultRow;
using world::Monitor;

constexpr unsigned kFaultsWorkers = 2;

struct FaultsJob {
  const bench::Loaded* loaded;
  world::MonitorSet off;
};

Result<std::vector<bench::Loaded>, Problem> load_all(const std::string& folder,
                                                     const std::string& only) {
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
    all.push_back(*std::move(loaded));
  }
  return all;
}

Result<std::vector<FaultRow>, Problem> run(const std::vector<FaultsJob>& jobs) {
  std::vector<Result<FaultRow, Problem>> results(jobs.size(), FaultRow{});
  sweep::in_parallel(jobs.size(), kFaultsWorkers, [&](std::size_t i) {
    results[i] = matrix::run_fault(*jobs[i].loaded, jobs[i].off);
  });
  std::vector<FaultRow> rows;
  for (auto& result : results) {
    if (!result) return Unexpected{result.error()};
    rows.push_back(*std::move(result));
  }
  return rows;
}

// A monitor that no scenario asks has an empty proof.
Result<std::vector<matrix::Proof>, Problem> prove(const std::vector<bench::Loaded>& all) {
  std::vector<matrix::Proof> proofs(world::kMonitors);
  std::vector<FaultsJob> jobs;
  std::vector<std::size_t> of_monitor;
  for (std::size_t m = 0; m < world::kMonitors; ++m) {
    proofs[m].monitor = static_cast<Monitor>(m);
    for (const bench::Loaded& loaded : all) {
      if (!matrix::asks(loaded.scenario, proofs[m].monitor)) continue;
      world::MonitorSet off;
      off.add(proofs[m].monitor);
      jobs.push_back({&loaded, off});
      of_monitor.push_back(m);
    }
  }
  const auto rows = run(jobs);
  if (!rows) return Unexpected{rows.error()};
  for (std::size_t i = 0; i < rows->size(); ++i) {
    matrix::Proof& proof = proofs[of_monitor[i]];
    proof.asked.push_back((*rows)[i].scenario);
    if (!(*rows)[i].passed()) proof.red.push_back((*rows)[i].scenario);
  }
  return proofs;
}

Result<world::MonitorSet, Problem> monitors_named(const std::vector<std::string>& names) {
  world::MonitorSet off;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(world::kMonitorNames, name);
    if (found == world::kMonitorNames.end())
      return Unexpected{Problem{"--without", "there is no monitor \"" + name + "\""}};
    off.add(static_cast<Monitor>(found - world::kMonitorNames.begin()));
  }
  return off;
}

struct FaultsOptions {
  std::string folder = "hil/scenarios/faults", only, json_file;
  std::vector<std::string> without;
  bool prove = false;
};

Result<int, Problem> judge(const FaultsOptions& options) {
  const auto off = monitors_named(options.without);
  if (!off) return Unexpected{off.error()};
  const auto all = load_all(options.folder, options.only);
  if (!all) return Unexpected{all.error()};
  const Instant begun = transport::monotonic_now();
  std::vector<FaultsJob> jobs;
  for (const bench::Loaded& loaded : *all) jobs.push_back({&loaded, *off});
  const auto rows = run(jobs);
  if (!rows) return Unexpected{rows.error()};
  double simulated_s = 0.0;
  for (const FaultRow& row : *rows) simulated_s += row.simulated_s;
  std::printf("%s%.0f s simulated in %.1f s\n", matrix::to_text(*rows).c_str(), simulated_s,
              (transport::monotonic_now() - begun).seconds());
  std::vector<matrix::Proof> proofs;
  if (options.prove) {
    auto proven = prove(*all);
    if (!proven) return Unexpected{proven.error()};
    proofs = *std::move(proven);
    std::printf("%s", matrix::to_text(proofs).c_str());
  }
  if (!options.json_file.empty()) {
    const auto written = transport::write_file(options.json_file, matrix::to_json(*rows, proofs));
    if (!written) return Unexpected{written.error()};
  }
  const bool whole = options.only.empty() ? matrix::holes(*rows).empty() : true;
  const bool needed = std::ranges::none_of(proofs, [&options](const matrix::Proof& proof) {
    return proof.red.empty() && (options.only.empty() || !proof.asked.empty());
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
  app.flag("--prove", options.prove, "switch each monitor off once: something must fail");
  app.option("--json", options.json_file, "write the matrix here");
  if (const auto code = app.ended_by(args)) return *code;
  const auto code = judge(options);
  return code ? *code : refuse(code.error());
}

}  // namespace pitwall::verbs
