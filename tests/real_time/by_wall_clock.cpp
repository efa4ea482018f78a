// by_wall_clock COMMAND...: runs a test that only the wall clock can judge. One that says by its
// exit code that nothing but time failed (tests/support/in_time.hpp) is run again. All tests of a
// suite together have five minutes for that (the file that PITWALL_TRIES_FILE names holds what they
// took); when these are spent, the test is not judged. Any other failure is one at once.
//   exit   that of the command; 1: the command could not be run; 3: not judged
// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/virtual_machine.hpp"
#include "tests/support/only_late.hpp"

namespace pitwall::testing {
namespace {

constexpr Duration kForTries = seconds(300);
constexpr Duration kRest = seconds(2);  // of a busy machine
constexpr int kFailed = 1, kNotJudged = 3;

// What tries of this suite took, those of other tests included, as far as they have ended.
class SpentOnTries {
 public:
  Duration all() const {
    const auto text = path_ == nullptr ? std::nullopt : read();
    return text ? std::max(*text, own_) : own_;
  }
  void add(Duration more) {
    own_ = all() + more;
    if (path_ == nullptr) return;
    const auto written = transport::write_file(path_, std::to_string(own_.ns / 1'000'000'000));
    if (!written) std::fprintf(stderr, "by_wall_clock: %s\n", to_string(written.error()).c_str());
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

// 1 where it cannot be run.
int run_once(const transport::ProcessPlan& plan) {
  const transport::KeepAwake awake;
  auto process = transport::Process::spawn(plan);
  if (process) return process->wait().shell_code();
  std::fprintf(stderr, "by_wall_clock: %s\n", to_string(process.error()).c_str());
  return kFailed;
}

int run(const transport::ProcessPlan& plan) {
  SpentOnTries spent;
  for (int tries = 1;; ++tries) {
    const Instant begun = transport::monotonic_now();
    const int code = run_once(plan);
    if (code == 0 && tries > 1) std::printf("by_wall_clock: passed at try %d\n", tries);
    if (code != kOnlyLate) return code;
    const bool again = spent.all() < kForTries;
    std::printf("by_wall_clock: %s at try %d\n",
                again ? "only late" : "not judged, the suite's minutes for tries are spent,",
                tries);
    std::fflush(stdout);
    if (!again) return kNotJudged;
    transport::nap(kRest);
    spent.add(transport::monotonic_now() - begun);
  }
}

}  // namespace
}  // namespace pitwall::testing

int main(int count, char** words) {
  if (count < 2) {
    std::fprintf(stderr, "by_wall_clock: no command to run\n");
    return 1;
  }
  return pitwall::testing::run({.argv = {words + 1, words + count}});
}
