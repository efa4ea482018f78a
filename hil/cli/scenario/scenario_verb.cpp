// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/scenario/scenario_verb.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <vector>

#include "hil/cli/bench_server/catalogue.hpp"
#include "hil/cli/command_line.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/cli/recordings/scenario_from.hpp"
#include "hil/cli/scenario/new_scenario.hpp"
#include "hil/cli/scenario/scenario_check.hpp"
#include "hil/cli/scenario/scenario_table.hpp"
#include "hil/scenario/radio_section.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::cli {
namespace {

namespace fs = std::filesystem;
using bench_server::Listed;

int check_files(const std::vector<std::string>& files) {
  int code = kExitPass;
  for (const std::string& file : files) {
    if (const auto problem = problem_in(file)) {
      code = refuse(*problem);
      continue;
    }
    std::printf("%s: ok\n", file.c_str());
    std::fflush(stdout);  // in order with the problems
  }
  return code;
}

int list_folder(const std::string& folder) {
  auto rows = bench_server::list_scenarios(folder);
  if (!rows) return refuse(rows.error());
  const auto broken =
      std::ranges::stable_partition(*rows, [](const Listed& row) { return row.problem.empty(); });
  std::printf("%s", scenario_table(std::span{rows->begin(), broken.begin()}).c_str());
  std::fflush(stdout);
  for (const Listed& row : broken) std::fprintf(stderr, "%s\n", row.problem.c_str());
  return broken.empty() ? kExitPass : kExitUnusable;
}

int make_new(const std::string& file, NewScenario scenario) {
  std::error_code error;
  const fs::path folder = fs::absolute(file, error).parent_path();
  scenario.schema = fs::absolute(kScenarioSchema, error).lexically_relative(folder).string();
  if (scenario.name.empty()) scenario.name = fs::path{file}.stem().string();
  if (fs::symlink_status(file, error).type() != fs::file_type::not_found)
    return refuse({file, "exists already, and is not replaced: name another file"});
  const std::string text = new_scenario_text(scenario);
  if (const auto problem = problem_in_text(text, file)) return refuse(*problem);
  if (const auto written = transport::write_file(file, text); !written)
    return refuse(written.error());
  std::printf("%s written; to run it: pitwall-hil run %s\n", file.c_str(), file.c_str());
  return kExitPass;
}

void add_new_options(CommandLine& verb, std::string& file, NewScenario& scenario) {
  verb.option("FILE", file, "the scenario to write (.yaml)").required();
  verb.option("--name", scenario.name, "of the scenario; default: the file's");
  verb.option("--track", scenario.track, "track file").shows_default();
  verb.option("--car", scenario.car, "car file").shows_default();
  verb.option("--duration", scenario.duration_s, "of the run, s")
      .range(kShortestNew_s, scenario::kLongest_s)
      .shows_default();
}

}  // namespace

int scenario_verb(std::span<const std::string> args) {
  std::string file, folder = "hil/scenarios";
  std::vector<std::string> files;
  NewScenario scenario;
  ScenarioFromOptions recorded;
  CommandLine app{"pitwall-hil scenario: scenario files, without a run"};
  CommandLine makes = app.one_of("new", "a small scenario to start from");
  add_new_options(makes, file, scenario);
  CommandLine checks = app.one_of("check", "scenarios, with the files that they name");
  checks.option("FILE", files, "scenario files").required();
  CommandLine lists = app.one_of("list", "the scenarios of a folder and its subfolders");
  lists.option("FOLDER", folder, "folder").shows_default();
  CommandLine from = app.one_of("from", "a scenario of a car's own recording");
  add_options(from, recorded);
  if (const auto code = app.ended_by(args)) return *code;
  if (makes.is_chosen()) return make_new(file, std::move(scenario));
  if (checks.is_chosen()) return check_files(files);
  return lists.is_chosen() ? list_folder(folder) : scenario_from(recorded);
}

}  // namespace pitwall::cli
