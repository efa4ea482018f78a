// in_real_time COMMAND...: runs a test of real time on a machine whose host may take its processors
// away, and keeps them awake meanwhile. What fails while the machine was there has failed. What
// fails while it was not is tried again, when the host has been quiet for some seconds. All tests
// of a suite together have five minutes for such tries (the file that PITWALL_TRIES_FILE names
// holds what they took); when these are spent the test is not judged, and the last line says what
// the host did.
//   exit   that of the command; 1: the command could not be run; 3: not judged
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/virtual_machine.hpp"
#include "tests/real_time/stall_watch.hpp"

namespace pitwall::testing {
namespace {

constexpr Duration kForTries = seconds(300);
constexpr Duration kQuiet = seconds(3), kPatience = seconds(45);
constexpr Duration kLook = milliseconds(100);
constexpr int kFailed = 1, kNotJudged = 3;

// What tries of this suite took, those of other tests included, as far as they have ended.
class SpentOnTries {
 public:
  Duration all() const {
    const auto text = path_ == nullptr ? std::nullopt : read();
    return text ? std::max(*text, own_) : own_;
  }
  void add(Duration more) {
    const Duration before = all();
    own_ = before + more;
    if (path_ == nullptr) return;
    const auto written = transport::write_file(path_, std::to_string(own_.ns / 1'000'000'000));
    if (!written) std::fprintf(stderr, "in_real_time: %s\n", to_string(written.error()).c_str());
  }

 private:
  std::optional<Duration> read() const {
    const auto text = transport::read_file(path_);
    std::int64_t spent_s = 0;
    if (!text ||
        std::from_chars(text->data(), text->data() + text->size(), spent_s).ec != std::errc{})
      return std::nullopt;
    return seconds(spent_s);
  }

  const char* path_ = std::getenv("PITWALL_TRIES_FILE");
  Duration own_{};
};

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
  SpentOnTries spent;
  for (int tries = 1;; ++tries) {
    const Instant begun = transport::monotonic_now();
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
    const bool was_spoiled = tried->status.signal == 0 && spoiled(tried->stalls);
    const bool again = was_spoiled && spent.all() < kForTries;
    std::printf("in_real_time: %s at try %d: %s\n",
                again         ? "spoiled"
                : was_spoiled ? "not judged, the suite's minutes for tries are spent,"
                              : "failed",
                tries, host.c_str());
    std::fflush(stdout);
    if (!again) return was_spoiled ? kNotJudged : tried->status.shell_code();
    wait_for_quiet();
    spent.add(transport::monotonic_now() - begun);
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
