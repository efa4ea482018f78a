// in_real_time COMMAND...: runs a test of real time on a machine whose host may take its processors
// away, and keeps them awake meanwhile. What fails while the machine was there has failed. What
// fails while it was not is tried again, when the host has been quiet for some seconds; where that
// does not help in minutes it has failed, too, and the last line says what the host did.
//   exit   that of the command; 1: the command could not be run
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <string>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/virtual_machine.hpp"
#include "tests/real_time/stall_watch.hpp"

namespace pitwall::testing {
namespace {

constexpr Duration kNoNewTryAfter = seconds(200);
constexpr Duration kQuiet = seconds(3), kPatience = seconds(45);
constexpr Duration kLook = milliseconds(100);
constexpr int kFailed = 1;

void wait_for_quiet() {
  const StallWatch watch;
  const Instant limit = transport::monotonic_now() + kPatience;
  for (Instant now{}; now < limit && now - watch.last_stall() < kQuiet;
       now = transport::monotonic_now())
    transport::sleep_until(transport::monotonic_now() + kLook);
}

struct Try {
  transport::ExitStatus status;
  Stalls stalls;
};

Result<Try, Problem> run_once(const transport::ProcessPlan& plan) {
  const transport::KeepAwake awake;
  auto process = transport::Process::spawn(plan);
  if (!process) return Unexpected{process.error()};
  const StallWatch watch;
  const transport::ExitStatus status = process->wait();
  return Try{.status = status, .stalls = watch.seen()};
}

int run(const transport::ProcessPlan& plan) {
  const Instant limit = transport::monotonic_now() + kNoNewTryAfter;
  for (int tries = 1;; ++tries) {
    const auto tried = run_once(plan);
    if (!tried) {
      std::fprintf(stderr, "in_real_time: %s\n", to_string(tried.error()).c_str());
      return kFailed;
    }
    if (tried->status.success()) {
      if (tries > 1) std::printf("in_real_time: passed at try %d\n", tries);
      return 0;
    }
    const std::string host = to_string(tried->stalls);
    // A program that crashed did so on any machine.
    const bool again =
        tried->status.signal == 0 && spoiled(tried->stalls) && transport::monotonic_now() < limit;
    std::printf("in_real_time: %s at try %d: %s\n", again ? "spoiled" : "failed", tries,
                host.c_str());
    std::fflush(stdout);
    if (!again) return tried->status.shell_code();
    wait_for_quiet();
  }
}

}  // namespace
}  // namespace pitwall::testing

int main(int count, char** words) {
  if (count < 2) {
    std::fprintf(stderr, "in_real_time: no command to run\n");
    return 1;
  }
  return pitwall::testing::run({.argv = {words + 1, words + count}});
}
