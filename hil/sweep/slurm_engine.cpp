// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/slurm_engine.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::sweep {
namespace {

using Words = std::vector<std::string>;

constexpr Duration kAskPeriod = seconds(1);
constexpr int kJobsAlone = 2;  // in which a case may end without a result before it has crashed

// What a command prints; a Problem with it where the command fails.
Result<std::string, Problem> output_of(const Words& command, const std::string& file) {
  Words argv{"sh", "-c", "exec \"$@\" > \"$0\" 2>&1", file};
  argv.insert(argv.end(), command.begin(), command.end());
  auto process = transport::Process::spawn({.argv = argv});
  if (!process) return Unexpected{process.error()};
  const bool is_good = process->wait().success();
  auto output = transport::read_file(file);
  if (!output) return Unexpected{output.error()};
  while (output->ends_with('\n')) output->pop_back();
  if (!is_good) return refuse(command.front(), *output);
  return output;
}

// Of the array job's task: the file of shares, then a process of the sweep.
constexpr std::string_view kTaskScript = R"sh(#!/bin/sh
shares=$1
shift
exec "$@" --worker "slurm-$SLURM_ARRAY_JOB_ID-$SLURM_ARRAY_TASK_ID" \
  --cases "$(sed -n "$((SLURM_ARRAY_TASK_ID + 1))p" "$shares")"
)sh";

// One line a task.
std::string shares_text(const CaseNumbers& cases, std::size_t share) {
  std::string text;
  for (std::size_t i = 0; i < cases.size(); ++i)
    text += std::to_string(cases[i]) + ((i + 1) % share == 0 || i + 1 == cases.size() ? "\n" : ",");
  return text;
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t end = 0; end != std::string_view::npos;) {
    end = text.find('\n');
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

// "JobHeldUser", "launch failed requeued held": it does not start by itself.
bool is_held(std::string_view reason) {
  return reason.starts_with("JobHeld") || reason.ends_with("held");
}

struct Job {
  std::string number;
  std::size_t tasks = 0;
};

class Cluster {
 public:
  Cluster(const SweepFolder& folder, const SlurmEngine& engine)
      : folder_(folder), engine_(engine), own_(folder.path() + "/slurm") {}

  Result<bool, Problem> run(CaseNumbers cases, std::size_t all) {
    std::error_code error;
    std::filesystem::create_directories(own_, error);
    if (error) return refuse(own_, error.message());
    if (const auto before = wait_for_last(); !before) return before;
    for (int round = 0; round <= kJobsAlone; ++round) {
      const auto left = still_missing(cases, all);
      if (!left) return Unexpected{left.error()};
      cases = *left;
      if (cases.empty()) return true;
      const std::size_t share = round == 0
                                    ? (cases.size() + engine_.tasks_most - 1) / engine_.tasks_most
                                    : std::size_t{1};
      if (const auto done = run_jobs(cases, share); !done) return done;
    }
    const auto left = still_missing(cases, all);
    if (!left) return Unexpected{left.error()};
    return record_crashed(*left);
  }

 private:
  std::string job_file() const { return own_ + "/job"; }

  Result<CaseNumbers, Problem> still_missing(const CaseNumbers& cases, std::size_t all) const {
    const auto results = folder_.read(all);
    if (!results) return Unexpected{results.error()};
    return without_result(cases, *results);
  }

  // As many jobs as the tasks need, one after the other.
  Result<bool, Problem> run_jobs(const CaseNumbers& cases, std::size_t share) {
    for (std::size_t first = 0; first < cases.size(); first += share * engine_.tasks_most) {
      const auto part = std::span{cases}.subspan(
          first, std::min(share * engine_.tasks_most, cases.size() - first));
      const auto job = submit(CaseNumbers(part.begin(), part.end()), share);
      if (!job) return Unexpected{job.error()};
      if (const auto ended = wait_for(*job); !ended) return ended;
    }
    return true;
  }

  Result<Job, Problem> submit(const CaseNumbers& cases, std::size_t share) {
    Job job{.number = {}, .tasks = (cases.size() + share - 1) / share};
    const std::string shares =
        own_ + formatted("/shares-%lld", static_cast<long long>(transport::monotonic_now().ns));
    auto written = transport::write_file(shares, shares_text(cases, share));
    if (written) written = transport::write_file(own_ + "/task.sh", kTaskScript);
    if (!written) return Unexpected{written.error()};
    Words command{"sbatch", "--parsable", "--requeue", "--array=0-" + std::to_string(job.tasks - 1),
                  "--output=" + own_ + "/%A_%a.out"};
    command.insert(command.end(), engine_.options.begin(), engine_.options.end());
    command.insert(command.end(), {own_ + "/task.sh", shares});
    command.insert(command.end(), engine_.command.begin(), engine_.command.end());
    auto number = output_of(command, own_ + "/output");
    if (!number) return Unexpected{number.error()};
    job.number = number->substr(0, number->find(';'));  // a cluster's name may follow
    written = transport::write_file(job_file(), job.number + " " + std::to_string(job.tasks));
    if (!written) return Unexpected{written.error()};
    return job;
  }

  // A job of a sweep that was interrupted; what cannot be read is none.
  Result<bool, Problem> wait_for_last() {
    if (!std::filesystem::exists(job_file())) return true;
    const auto text = transport::read_file(job_file());
    if (!text) return Unexpected{text.error()};
    const std::size_t space = text->find(' ');
    if (space == std::string::npos) return true;
    Job job{.number = text->substr(0, space)};
    std::from_chars(text->data() + space + 1, text->data() + text->size(), job.tasks);
    return wait_for(job);
  }

  // Slurm forgets a job some minutes after its end: then it is not found.
  Result<bool, Problem> wait_for(const Job& job) {
    for (;;) {
      const auto output =
          output_of({"squeue", "--noheader", "--array", "--format=%r", "--job", job.number},
                    own_ + "/output");
      if (!output && output.error().what.find("Invalid job id") != std::string::npos) return true;
      if (!output) return Unexpected{output.error()};
      if (output->empty()) return true;
      const std::vector<std::string_view> reasons = lines_of(*output);
      if (std::ranges::all_of(reasons, is_held))
        return refuse("job " + job.number,
                      "every task that is left is held: " + std::string{reasons.front()} +
                          "; free or cancel them and begin the sweep again");
      if (engine_.progress) engine_.progress(reasons.size(), job.tasks);
      transport::sleep_until(transport::monotonic_now() + kAskPeriod);
    }
  }

  Result<bool, Problem> record_crashed(const CaseNumbers& cases) const {
    for (const std::size_t number : cases) {
      const auto written =
          folder_.append("crashed", {.number = number,
                                     .verdict = CaseVerdict::kCrashed,
                                     .why = "its task ended without a result, in three jobs"});
      if (!written) return written;
    }
    return true;
  }

  const SweepFolder& folder_;
  const SlurmEngine& engine_;
  std::string own_;
};

}  // namespace

Result<bool, Problem> run_on_cluster(const CaseNumbers& cases, std::size_t all,
                                     const SweepFolder& folder, const SlurmEngine& engine) {
  return Cluster{folder, engine}.run(cases, all);
}

Result<bool, Problem> find_slurm() {
  for (const char* program : {"sbatch", "squeue"}) {
    auto process = transport::Process::spawn(
        {.argv = {"sh", "-c", "exec \"$0\" --version > /dev/null 2>&1", program}});
    if (!process) return Unexpected{process.error()};
    if (!process->wait().success())
      return refuse(program,
                    "is not there: --engine slurm needs a cluster and its commands "
                    "(package slurm-client)");
  }
  return true;
}

}  // namespace pitwall::sweep
