// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/sweep/sweep_verb.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "hil/cli/command_line.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/cli/live/programs.hpp"
#include "hil/cli/run_verb.hpp"
#include "hil/cli/sweep/case_pages.hpp"
#include "hil/cli/sweep/sweep_case.hpp"
#include "hil/report/sweep/sweep_page.hpp"
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

constexpr int kProcessesMost = 1'024, kPagesMost = 1'000;

struct Options {
  std::string plan_file, folder, report_folder, worker, engine = "local", baseline;
  std::vector<std::string> sbatch;
  unsigned processes = std::max(1U, std::thread::hardware_concurrency());
  std::size_t one_case = 0, pages = sweep::kWorstShown;
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

// Under the name that the scenario has in the sweep, so that the event log is the same.
int run_one(const Options& options, const SweepInputs& of) {
  if (options.one_case >= of.cases.size())
    return refuse(Problem{"--case", formatted("the sweep has %zu cases", of.cases.size())});
  const sweep::Case one = of.cases.at(options.one_case);
  RunOptions run;
  run.scenario = of.cases.plan().scenario_file, run.report_folder = options.report_folder;
  auto text = yaml::with_settings(of.scenario_text, run.scenario, one.settings);
  if (!text) return refuse(text.error());
  run.text = *std::move(text);
  for (const yaml::Setting& setting : one.settings)
    std::printf("%s = %s\n", setting.path.c_str(), setting.value.c_str());
  return run_as_told(std::move(run));
}

// How much is done, at most every two seconds, and when it will have ended at the speed since.
class Progress {
 public:
  // `before`: what was done when it began; else what is done at the first call.
  explicit Progress(const char* what, std::optional<std::size_t> before = {})
      : what_(what), before_(before) {}

  void operator()(std::size_t done, std::size_t all) {
    if (!before_) before_ = done;
    const Instant now = transport::monotonic_now();
    if (now - printed_ < seconds(2) && done < all) return;
    printed_ = now;
    std::printf("%zu of %zu %s", done, all, what_);
    if (done > *before_)
      std::printf(", about %.0f s left",
                  (now - begun_).seconds() / number(done - *before_) * number(all - done));
    std::printf("\n");
    std::fflush(stdout);
  }

 private:
  static double number(std::size_t count) { return static_cast<double>(count); }

  const char* what_;
  std::optional<std::size_t> before_;
  Instant begun_ = transport::monotonic_now(), printed_ = begun_;
};

std::string joined(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (const std::size_t number : numbers)
    text += (text.empty() ? "" : ",") + std::to_string(number);
  return text;
}

std::vector<std::string> command_of(const Options& options) {
  return {own_program(), "sweep", options.plan_file};
}

Result<bool, Problem> run_missing(const Options& options, const SweepInputs& of,
                                  const sweep::SweepFolder& folder) {
  const std::size_t all = of.cases.size();
  const auto before = folder.read(all);
  if (!before) return Unexpected{before.error()};
  const sweep::CaseNumbers missing = sweep::missing_cases(*before, all);
  if (!before->empty()) std::printf("%zu of %zu cases were done before\n", before->size(), all);
  std::vector<std::string> command = command_of(options);
  command.insert(command.end(), {"--out", folder.path()});
  if (options.engine == "slurm") {
    return sweep::run_on_cluster(
        missing, all, folder,
        {.command = command,
         .options = options.sbatch,
         .progress = [progress = Progress{"tasks"}](std::size_t left, std::size_t tasks) mutable {
           progress(tasks - left, tasks);
         }});
  }
  sweep::LocalEngine engine;
  engine.processes = options.processes;
  engine.progress = [progress = Progress{"cases", before->size()}, first = before->size(),
                     all](std::size_t done) mutable { progress(first + done, all); };
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

// The worst cases, and the first of those whose verdict is another than in the baseline.
std::vector<const sweep::CaseResult*> with_page(const report::SweepRun& run, std::size_t most) {
  std::vector<const sweep::CaseResult*> cases = report::worst_of(run.results);
  cases.resize(std::min(cases.size(), most));
  const sweep::Difference difference =
      run.baseline ? run.baseline->difference : sweep::Difference{};
  for (const std::vector<std::size_t>* numbers : {&difference.worse, &difference.better})
    for (const std::size_t number : std::span{*numbers}.first(std::min(numbers->size(), most)))
      cases.push_back(&sweep::result_of(run.results, number));
  std::ranges::sort(cases, {}, &sweep::CaseResult::number);
  const auto twice = std::ranges::unique(cases);
  cases.erase(twice.begin(), twice.end());
  return cases;
}

// The page of the sweep, those of its worst cases, and the summary by which others find them.
Result<bool, Problem> write_pages(const Options& options, const sweep::SweepFolder& folder,
                                  report::SweepRun run) {
  auto pages = make_case_pages(with_page(run, options.pages), {.folder = folder.pages_folder(),
                                                               .command = command_of(options),
                                                               .processes = options.processes});
  if (!pages) return Unexpected{pages.error()};
  run.pages = *std::move(pages);
  auto written = transport::write_file(folder.report_file(), report::sweep_page(run));
  if (!written) return written;
  return transport::write_file(folder.summary_file(),
                               sweep::summary_json(run.cases.plan(), run.results) + "\n");
}

int run_all(const Options& options, const SweepInputs& of, const sweep::SweepFolder& folder) {
  if (const auto ran = run_missing(options, of, folder); !ran) return refuse(ran.error());
  const auto results = folder.read(of.cases.size());
  if (!results) return refuse(results.error());
  const std::string command = "pitwall-hil sweep " + options.plan_file;
  report::SweepRun run{.cases = of.cases, .results = *results, .command = command};
  std::vector<sweep::CaseResult> before;
  if (!options.baseline.empty()) {
    auto read = baseline_of(options, of);
    if (!read) return refuse(read.error());
    before = *std::move(read);
    run.baseline = {.results = before, .difference = sweep::difference(before, *results)};
    run.command += " --baseline " + options.baseline;
  }
  auto written = sweep::write_results(folder.results_file(), of.cases, of.plan_text, *results);
  if (!written) return refuse(written.error());
  std::printf("%s%s\n", sweep::summary_of(of.cases, *results, command).c_str(),
              folder.results_file().c_str());
  written = write_pages(options, folder, run);
  if (!written) return refuse(written.error());
  std::printf("%s\n", folder.report_file().c_str());
  if (run.baseline) std::printf("%s", to_text(run.baseline->difference).c_str());
  return report::passed(run) ? kExitPass : kExitFailed;
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
  app.option("--pages", options.pages, "how many of the worst cases get a page of their own")
      .range(0, kPagesMost)
      .shows_default();
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
