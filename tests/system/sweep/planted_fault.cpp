// A fault that is planted into the car, which every scenario that ships passes, and the search that
// finds it: planted_fault [--processes N]. Minutes of simulation; `./pitwall long sweeps` runs it.
//   out    the scenarios with the car as it is and with the fault; what the search found, with each
//   exit   0: all of them pass, the car as it is is not falsified in 200 runs, that with the fault
//          is; 1: not so
// SPDX-License-Identifier: Apache-2.0
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/cli/command_line.hpp"
#include "hil/cli/sweep/falsifier.hpp"
#include "hil/sweep/in_parallel.hpp"

namespace pitwall::testing {
namespace {

namespace fs = std::filesystem;
using Files = std::vector<std::string>;

constexpr std::size_t kRuns = 200;
constexpr double kSuiteMost_s = 600.0;  // of two processors

// The learned offset of the steering runs away while the car keeps one speed, which in no scenario
// that ships it does: there it passes through.
constexpr double kBad_mps = 30.3, kBadWidth_mps = 0.5, kSteady_mps2 = 0.5;
constexpr double kRuns_rad_per_tick = 4e-5;

pipeline::Outputs learn_wrongly(const pipeline::Setup& setup, pipeline::Car& car,
                                const pipeline::Inputs& in) {
  pipeline::Outputs out = pipeline::step(setup, car, in);
  const double off = (out.ego.vx_mps - kBad_mps) / kBadWidth_mps;
  if (std::abs(out.ego.ax_mps2) < kSteady_mps2 && std::isfinite(off))
    car.learned.offset_rad += kRuns_rad_per_tick * std::exp(-0.5 * off * off);
  return out;
}

// In lockstep. Ray by ray a run takes longer than it lasts: those have tests of their own.
bool is_for_here(const bench::Loaded& loaded) {
  return !bench::refused_by(bench::BenchMode::kLockstep, loaded.scenario.faults) &&
         !scenario::has_rays(loaded.scenario.lidars);
}

struct Suite {
  Files files, left_out;
};

Suite shipped() {
  Suite suite;
  const std::string root = PITWALL_SOURCE_DIR;
  for (const auto& entry : fs::recursive_directory_iterator(root + "/hil/scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    const auto loaded = bench::load(entry.path().string(), root);
    if (!loaded) std::printf("%s\n", to_string(loaded.error()).c_str());
    Files& to = !loaded || is_for_here(*loaded) ? suite.files : suite.left_out;
    to.push_back(entry.path().string());
  }
  std::ranges::sort(suite.files);
  return suite;
}

double processor_s() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

// How many do not pass.
std::size_t run_suite(const char* car, const Files& files, unsigned threads,
                      const bench::StepFunction& step) {
  std::vector<int> passed(files.size());
  const double begun_s = processor_s();
  sweep::in_parallel(files.size(), threads, [&](std::size_t i) {
    const auto loaded = bench::load(files[i], PITWALL_SOURCE_DIR);
    if (!loaded) return;
    const auto run = bench::run_lockstep(*loaded, {.step = step});
    passed[i] = run && run->passed();
  });
  const double took_s = processor_s() - begun_s;
  for (std::size_t i = 0; i < files.size(); ++i)
    if (!passed[i]) std::printf("  does not pass: %s\n", files[i].c_str());
  const auto failed = static_cast<std::size_t>(std::ranges::count(passed, 0));
  std::printf("%s: %zu scenarios, %zu do not pass; %.0f s of two processors (%.0f)\n", car,
              files.size(), failed, took_s / 2.0, kSuiteMost_s);
  std::fflush(stdout);
  return failed + (took_s / 2.0 > kSuiteMost_s ? 1U : 0U);
}

bool is_falsified(const char* car, const cli::SweepInputs& inputs, unsigned threads,
                  const bench::StepFunction& step) {
  std::printf("%s, searched\n", car);
  const auto found = cli::falsify(inputs, {.runs = kRuns, .threads = threads, .step = step});
  if (!found) std::printf("nothing found in %zu runs\n", kRuns);
  return found.has_value();
}

int run(unsigned threads) {
  fs::current_path(PITWALL_SOURCE_DIR);  // from where the plan names its scenario
  const auto inputs = cli::read_sweep("tests/system/sweep/speed_and_wind.yaml");
  if (!inputs) return std::printf("%s\n", to_string(inputs.error()).c_str()), EXIT_FAILURE;
  const Suite suite = shipped();
  for (const std::string& file : suite.left_out)
    std::printf("left out, live or ray by ray: %s\n", file.c_str());
  std::size_t faults = run_suite("the car as it is", suite.files, threads, pipeline::step);
  faults += run_suite("with the planted fault", suite.files, threads, learn_wrongly);
  faults += is_falsified("the car as it is", *inputs, threads, pipeline::step) ? 1U : 0U;
  faults += is_falsified("with the planted fault", *inputs, threads, learn_wrongly) ? 0U : 1U;
  std::printf("%s, simulation\n", faults == 0 ? "all as it should be" : "NOT as it should be");
  return faults == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace pitwall::testing

int main(int count, char** words) {
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  const std::vector<std::string> args(words + 1, words + count);
  pitwall::cli::CommandLine app{"planted_fault: is it found?"};
  app.option("--processes", threads, "threads; default: the processors").range(1, 1'024);
  if (const auto code = app.ended_by(args)) return *code;
  return pitwall::testing::run(threads);
}
