// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/sweep/falsify_verb.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "hil/cli/command_line.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/cli/sweep/falsifier.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kThreadsMost = 1'024;

int keep(const SweepInputs& inputs, const sweep::Case& found, const std::string& file) {
  const auto text =
      yaml::with_settings(inputs.scenario_text, inputs.cases.plan().scenario_file, found.settings);
  if (!text) return refuse(text.error());
  std::error_code error;
  if (const fs::path folder = fs::path{file}.parent_path(); !folder.empty())
    fs::create_directories(folder, error);
  if (const auto written = transport::write_file(file, *text); !written)
    return refuse(written.error());
  std::printf("found; again: pitwall-hil run %s\n", file.c_str());
  return kExitFailed;
}

}  // namespace

int falsify_verb(std::span<const std::string> args) {
  std::string plan_file, file;
  std::size_t runs = 200;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  CommandLine app{"pitwall-hil falsify: values at which a scenario misses an expectation"};
  app.option("PLAN", plan_file, "plan of a sweep, with ranges (YAML)").required();
  app.option("--runs", runs, "at most").range(1, 1'000'000).shows_default();
  app.option("--processes", threads, "threads; default: the processors").range(1, kThreadsMost);
  app.option("--out", file, "the scenario that missed one; default out/falsified/NAME.yaml");
  if (const auto code = app.ended_by(args)) return *code;
  const auto inputs = read_sweep(plan_file);
  if (!inputs) return refuse(inputs.error());
  const sweep::Plan& plan = inputs->cases.plan();
  if (std::ranges::none_of(plan.parameters, is_searched))
    return refuse(Problem{plan_file, "no parameter has a range (from, to): nothing to search"});
  if (const auto fits = check_values(inputs->scenario_text, plan); !fits)
    return refuse(fits.error());
  const auto found = falsify(*inputs, {.runs = runs, .threads = threads});
  if (found)
    return keep(*inputs, *found, file.empty() ? "out/falsified/" + plan.name + ".yaml" : file);
  std::printf("nothing found\n");
  return kExitPass;
}

}  // namespace pitwall::cli
