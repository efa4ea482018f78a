// in_bench_time COMMAND...: runs a test while it keeps bench time for the programs that the test
// starts. The file of that time is in PITWALL_TEST_CLOCK; a program goes by it with --clock, one of
// the tests' own by tests/support/test_clock.hpp. A stall of the machine then costs them nothing.
//   exit   that of the command; 1: it could not be run, or no time could be kept
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <string>

#include "protocol/transport/bench_clock/kept_clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"

namespace pitwall::testing {
namespace {

int complain(const Problem& problem) {
  std::fprintf(stderr, "in_bench_time: %s\n", to_string(problem).c_str());
  return 1;
}

int run(transport::ProcessPlan plan) {
  const auto folder = transport::TemporaryFolder::create("pitwall-test-clock-");
  if (!folder) return complain(folder.error());
  const std::string file = folder->path() + "/clock";
  auto clock = transport::KeptClock::keep(file);
  if (!clock) return complain(clock.error());
  plan.environment.push_back("PITWALL_TEST_CLOCK=" + file);
  auto process = transport::Process::spawn(plan);
  if (!process) return complain(process.error());
  const int code = process->wait().shell_code();
  const transport::ClockWaits waits = clock->end();
  std::printf("in_bench_time: stood %llu times for the machine, %.2f s in all\n",
              static_cast<unsigned long long>(waits.count), waits.total.seconds());
  return code;
}

}  // namespace
}  // namespace pitwall::testing

int main(int count, char** words) {
  if (count < 2) {
    std::fprintf(stderr, "in_bench_time: no command to run\n");
    return 1;
  }
  return pitwall::testing::run({.argv = {words + 1, words + count}});
}
