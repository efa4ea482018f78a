// Attempts to pass in every bracket, ours and the published planner's: `./pitwall long matches`.
// With `--lidars rays` ours alone, at three speeds, by LiDARs that shoot their rays; at one of them
// again without cameras and without the LiDAR that looks ahead. With `--cameras rendered` the car
// looks in rendered images too.
// Exit: 0 the gates hold, 1 one does not, 2 the command line is wrong.
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "hil/sweep/in_parallel.hpp"
#include "protocol/transport/file.hpp"
#include "tests/system/passing/attempt_table.hpp"

namespace pitwall::testing {
namespace {

// Processor time of one, on the reference machine.
constexpr double kAttempt_s = 7.0, kByRays_s = 110.0, kByImages_s = 350.0;
constexpr std::array kByRays{kBrackets[1], kBrackets[3], kBrackets[5]};
constexpr std::size_t kByRaysAttempts = 5;

std::vector<AttemptCase> cases_of(Seeds seeds, const std::string& commit, std::size_t attempts) {
  std::vector<AttemptCase> cases;
  for (const BracketGate& bracket : kBrackets)
    for (std::size_t i = 0; i < attempts; ++i)
      for (const Driver driver : kDrivers)
        cases.push_back(case_of(seeds, commit, i, bracket.round_mph, driver));
  return cases;
}

void see_as_measured(std::vector<AttemptCase>& cases) {
  for (AttemptCase& attempt : cases) attempt.lidars = scenario::LidarKind::kMeasured;
}

std::vector<AttemptCase> cases_by_rays(std::span<const BracketGate> brackets, SensorsOut out,
                                       std::size_t attempts, scenario::CameraKind cameras) {
  std::vector<AttemptCase> cases;
  for (const BracketGate& bracket : brackets)
    for (std::size_t i = 0; i < attempts; ++i) {
      cases.push_back(case_of(Seeds::kCommitted, "", i, bracket.round_mph, Driver::kOurs));
      cases.back().lidars = scenario::LidarKind::kRays;
      cases.back().cameras = cameras;
      cases.back().out = out;
    }
  return cases;
}

// The file shows the attempt again: pitwall-hil run FILE.
void keep(const AttemptRun& run, const std::string& folder) {
  const std::string file =
      folder + "/lost_" + std::to_string(static_cast<int>(run.of.round_mph)) + "_" +
      std::to_string(run.of.seed) +
      (run.of.out == SensorsOut::kNone ? ""
                                       : "_out_" + std::to_string(static_cast<int>(run.of.out))) +
      ".yaml";
  if (transport::write_file(file, scenario_text(run.of)))
    std::printf("  written: %s\n", file.c_str());
}

bool run_all(const std::vector<AttemptCase>& cases, std::span<const BracketGate> brackets,
             Seeds seeds, unsigned processes, const std::string& lost_folder) {
  std::vector<AttemptRun> runs(cases.size());
  sweep::in_parallel(runs.size(), processes, [&](std::size_t i) {
    runs[i] = run_attempt(cases[i]);
    std::printf("%s\n", row_of(runs[i]).c_str());
    std::fflush(stdout);
  });
  std::printf("\n%s", table_of(runs, seeds).c_str());
  for (const AttemptRun& run : runs) {
    if (run.of.driver != Driver::kOurs || run.verdict == Verdict::kPassed) continue;
    std::printf("%s\n", row_of(run).c_str());
    if (!lost_folder.empty()) keep(run, lost_folder);
  }
  const std::vector<std::string> missed = missed_gates(runs, seeds, brackets);
  for (const std::string& why : missed) std::printf("MISSED %s\n", why.c_str());
  if (missed.empty()) std::printf("all gates hold\n");
  return missed.empty();
}

bool run_by_rays(std::size_t attempts, scenario::CameraKind cameras, unsigned processes,
                 const std::string& lost_folder) {
  bool held = true;
  for (const SensorsOut out : {SensorsOut::kNone, SensorsOut::kCameras, SensorsOut::kFrontLidar}) {
    const std::span<const BracketGate> brackets =
        out == SensorsOut::kNone ? std::span{kByRays} : std::span{kByRays}.subspan(1, 1);
    std::printf("%s%s:\n", out == SensorsOut::kNone ? "" : "\n", text_of(out));
    held = run_all(cases_by_rays(brackets, out, attempts, cameras), brackets, Seeds::kCommitted,
                   processes, lost_folder) &&
           held;
  }
  return held;
}

}  // namespace
}  // namespace pitwall::testing

int main(int argc, char** argv) {
  using namespace pitwall::testing;
  std::size_t attempts = 0;
  unsigned processes = 2;
  std::string commit, lost_folder, lidars = "model", cameras = "model";
  CLI::App app{"Attempts to pass a defender at every round speed: ours and the published planner."};
  app.add_option("--attempts", attempts,
                 "of each driver at each speed, for each kind of seeds; 20, by rays 5")
      ->check(CLI::Range(1, 1'000));
  app.add_option(
         "--lidars", lidars,
         "model; measured: its errors are the network's; rays: ours alone at 100, 125, 150 mph")
      ->check(CLI::IsMember({"model", "measured", "rays"}));
  CLI::Option* const by_images =
      app.add_option("--cameras", cameras, "rendered: the car looks in images; with --lidars rays")
          ->check(CLI::IsMember({"model", "rendered"}));
  app.add_option("--commit", commit, "its name gives the second kind of seeds; without: none");
  app.add_option("--processes", processes, "at once")->check(CLI::Range(1, 256));
  app.add_option("--lost", lost_folder, "scenarios of attempts that ours did not make go here");
  CLI11_PARSE(app, argc, argv);
  const bool by_rays = lidars == "rays", is_rendered = cameras == "rendered";
  if (*by_images && !by_rays) {
    std::fprintf(stderr, "--cameras: only with --lidars rays\n");
    return 2;
  }
  if (attempts == 0) attempts = by_rays ? kByRaysAttempts : kGateAttempts;
  const auto announce = [&](std::size_t all, double one_s) {
    std::printf("simulated: %zu attempts, about %.0f min on %u processors\n", all,
                static_cast<double>(all) * one_s / 60.0 / processes, processes);
    std::fflush(stdout);
  };
  if (by_rays) {
    announce((kByRays.size() + 2) * attempts, is_rendered ? kByImages_s : kByRays_s);
    const auto kind = is_rendered ? pitwall::scenario::CameraKind::kRendered
                                  : pitwall::scenario::CameraKind::kModel;
    return run_by_rays(attempts, kind, processes, lost_folder) ? 0 : 1;
  }
  auto committed = cases_of(Seeds::kCommitted, commit, attempts);
  if (lidars == "measured") see_as_measured(committed);
  announce((commit.empty() || lidars != "model" ? 1 : 2) * committed.size(), kAttempt_s);
  bool held = run_all(committed, kBrackets, Seeds::kCommitted, processes, lost_folder);
  if (!commit.empty() && lidars == "model")
    held = run_all(cases_of(Seeds::kOfCommit, commit, attempts), kBrackets, Seeds::kOfCommit,
                   processes, lost_folder) &&
           held;
  return held ? 0 : 1;
}
