// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/sweep/sweep_verb.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <thread>
#include <utility>
#include <vector>

#include "hil/cli/command_line.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/cli/live/programs.hpp"
#include "hil/cli/run_verb.hpp"
#include "hil/cli/sweep/sweep_case.hpp"
#include "hil/sweep/baseline.hpp"
#include "hil/sweep/local_engine.hpp"
#include "hil/sweep/results_file.hpp"
#include "hil/sweep/slurm_engine.hpp"
#include "hil/sweep/summary.hpp"
#include "hil/sweep/sweep_folder.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kProcessesMost = 1'024;

struct Options {
  std::string plan_file, folder, report_folder, worker, engine = "local", baseline;
  std::vector<std::string> sbatch;
  unsigned processes = std::max(1U, std::thread::hardware_concurrency());
  std::size_t one_case = 0;
  std::vector<std::size_t> cases;  // of a process of the sweep
};

// The work of a process of the sweep. Slurm starts one again whose node was lost: what it has done
// is not run twice.
int work(const Options& options, const SweepInputs& of, const sweep::SweepFolder& folder) {
  const auto done = folder.read_of(options.worker, of.cases.size());
  if (!done) return refuse(done.error());
  for (const std::size_t number : sweep::without_result(options.cases, *done)) {
    const auto written = folder.append(options.worker, run_case(of, of.cases.at(number)));
    if (!written) return refuse(written.error());
  }
  return kExitPass;
}

int run_one(const Options& options, const SweepInputs& of) {
  if (options.one_case >= of.cases.size())
    return refuse(Problem{"--case", formatted("the sweep has %zu cases", of.cases.size())});
  const sweep::Case one = of.cases.at(options.one_case);
  const auto text =
      yaml::with_settings(of.scenario_text, of.cases.plan().scenario_file, one.settings);
  if (!text) return refuse(text.error());
  const auto folder = transport::TemporaryFolder::create("pitwall-case");
  if (!folder) return refuse(folder.error());
  for (const yaml::Setting& setting : one.settings)
    std::printf("%s = %s\n", setting.path.c_str(), setting.value.c_str());
  const std::string file = folder->path() + formatted("/case_%zu.yaml", one.number);
  if (const auto written = transport::write_file(file, *text); !written)
    return refuse(written.error());
  RunOptions run;
  run.scenario = file, run.report_folder = options.report_folder;
  return run_as_told(std::move(run));
}

class Progress {
 public:
  Progress(std::size_t before, std::size_t all) : before_(before), all_(all) {}

  void operator()(std::size_t done) {
    const Instant now = transport::monotonic_now();
    if (now - told_ < seconds(2) && before_ + done < all_) return;
    told_ = now;
    const double per_case_s =
        (now - begun_).seconds() / static_cast<double>(std::max<std::size_t>(done, 1));
    std::printf("%zu of %zu cases, about %.0f s left\n", before_ + done, all_,
                per_case_s * static_cast<double>(all_ - before_ - done));
    std::fflush(stdout);
  }

 private:
  std::size_t before_, all_;
  Instant begun_ = transport::monotonic_now(), told_ = begun_;
};

std::string joined(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (const std::size_t number : numbers)
    text += (text.empty() ? "" : ",") + std::to_string(number);
  return text;
}

Result<bool, Problem> run_missing(const Options& options, const SweepInputs& of,
                                  const sweep::SweepFolder& folder) {
  const std::size_t all = of.cases.size();
  const auto before = folder.read(all);
  if (!before) return Unexpected{before.error()};
  const sweep::CaseNumbers missing = sweep::missing_cases(*before, all);
  if (!before->empty()) std::printf("%zu of %zu cases were done before\n", before->size(), all);
  const std::vector<std::string> command{own_program(), "sweep", options.plan_file, "--out",
                                         folder.path()};
  if (options.engine == "slurm") {
    return sweep::run_on_cluster(missing, all, folder,
                                 {.command = command,
                                  .options = options.sbatch,
                                  .progress = [](std::size_t left, std::size_t tasks) {
                                    std::printf("%zu of %zu tasks left\n", left, tasks);
                                    std::fflush(stdout);
                                  }});
  }
  sweep::LocalEngine engine;
  engine.processes = options.processes;
  engine.progress = Progress{before->size(), all};
  engine.start = [&](const sweep::CaseNumbers& cases, const std::string& name) {
    std::vector<std::string> argv = command;
    argv.insert(argv.end(), {"--worker", name, "--cases", joined(cases)});
    return transport::Process::spawn({.argv = argv});
  };
  return sweep::run_here(missing, all, folder, engine);
}

// Of an earlier sweep with the same plan and scenario.
Result<std::vector<sweep::CaseResult>, Problem> baseline_of(const Options& options,
                                                            const SweepInputs& of) {
  if (!fs::exists(options.baseline + "/cases"))
    return Unexpected{Problem{options.baseline, "is no folder of a sweep"}};
  const auto folder = sweep::SweepFolder::open(options.baseline, of.plan_text, of.scenario_text);
  if (!folder) return Unexpected{folder.error()};
  return folder->read(of.cases.size());
}

int run_all(const Options& options, const SweepInputs& of, const sweep::SweepFolder& folder) {
  if (const auto ran = run_missing(options, of, folder); !ran) return refuse(ran.error());
  const auto results = folder.read(of.cases.size());
  if (!results) return refuse(results.error());
  const auto written =
      sweep::write_results(folder.results_file(), of.cases, of.plan_text, *results);
  if (!written) return refuse(written.error());
  std::printf(
      "%s%s\n",
      sweep::summary_of(of.cases, *results, "pitwall-hil sweep " + options.plan_file).c_str(),
      folder.results_file().c_str());
  if (!options.baseline.empty()) {
    const auto before = baseline_of(options, of);
    if (!before) return refuse(before.error());
    const sweep::Difference difference = sweep::difference(*before, *results);
    std::printf("%s", to_text(difference).c_str());
    return difference.worse.empty() ? kExitPass : kExitFailed;
  }
  return sweep::all_passed(*results) ? kExitPass : kExitFailed;
}

// What there is to refuse before anything is started.
Result<bool, Problem> check(const Options& options, const SweepInputs& of) {
  if (options.engine == "slurm")
    if (auto found = sweep::find_slurm(); !found) return found;
  if (!options.baseline.empty())
    if (const auto before = baseline_of(options, of); !before) return Unexpected{before.error()};
  return check_values(of.scenario_text, of.cases.plan());
}

}  // namespace

int sweep_verb(std::span<const std::string> args) {
  Options options;
  CommandLine app{"pitwall-hil sweep: many cases of one scenario, in lockstep"};
  app.option("PLAN", options.plan_file, "plan of the sweep (YAML)").required();
  app.option("--out", options.folder, "folder of the results; default out/sweeps/NAME");
  app.option("--processes", options.processes, "at a time; default: the processors")
      .range(1, kProcessesMost);
  app.option("--engine", options.engine, "local, or slurm: array jobs of a cluster")
      .shows_default();
  app.option("--sbatch", options.sbatch, "an option for sbatch, such as --sbatch=--partition=long");
  app.option("--baseline", options.baseline,
             "folder of an earlier sweep of this plan: what passed there has to pass");
  const VerbOption one = app.option("--case", options.one_case, "run this case alone, as `run`");
  app.option("--report", options.report_folder, "of that case: log, result and page").needs(one);
  const VerbOption worker =
      app.option("--worker", options.worker, "name of a process of the sweep").hidden();
  app.option("--cases", options.cases, "cases of such a process")
      .with_commas()
      .needs(worker)
      .hidden();
  if (const auto code = app.ended_by(args)) return *code;
  if (options.engine != "local" && options.engine != "slurm")
    return refuse(Problem{"--engine " + options.engine, "expected local or slurm"});
  const auto of = read_sweep(options.plan_file);
  if (!of) return refuse(of.error());
  if (one.given()) return run_one(options, *of);
  const sweep::Plan& plan = of->cases.plan();
  if (options.folder.empty()) options.folder = "out/sweeps/" + plan.name;
  if (!worker.given())
    if (const auto ready = check(options, *of); !ready) return refuse(ready.error());
  const auto folder = sweep::SweepFolder::open(options.folder, of->plan_text, of->scenario_text);
  if (!folder) return refuse(folder.error());
  return worker.given() ? work(options, *of, *folder) : run_all(options, *of, *folder);
}

}  // namespace pitwall::cli
