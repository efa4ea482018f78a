// by_wall_clock [--keep-awake] COMMAND...: runs a test that limits by the wall clock can fail. It
// is run again where it says by its exit code that nothing but time failed (only_late.hpp in
// tests/support), and where it failed in any way while the machine stood still (StallWatch). All
// tests of a suite together have five minutes for that (the file that PITWALL_TRIES_FILE names
// holds what they took); when these are spent, a test that was only late is not judged. Any other
// failure is one.
//   --keep-awake  keep the processors of a virtual machine awake meanwhile
//   exit   that of the command; 1: the command could not be run; 3: not judged
// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "hil/bench/live/virtual_machine.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "tests/support/only_late.hpp"

namespace pitwall::testing {
namespace {

constexpr Duration kForTries = seconds(300);
constexpr Duration kRest = seconds(2);  // of a busy machine
constexpr Duration kStall = milliseconds(250);
constexpr int kFailed = 1, kNotJudged = 3, kMostStalls = 3;

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

// How late a thread with nothing to do came to run at worst: so long no process of its priority had
// a processor.
class StallWatch {
 public:
  // Ends the watch; a stall that has just ended counts although the thread has not run since.
  Duration worst() {
    thread_.request_stop();
    thread_.join();
    return worst_;
  }

 private:
  static constexpr Duration kNap = milliseconds(5);

  void watch(const std::stop_token& stop) {
    Instant slept = begun_;
    do {
      transport::nap(kNap);
      const Instant now = transport::monotonic_now();
      worst_ = std::max(worst_, now - slept - kNap);
      slept = now;
    } while (!stop.stop_requested());
  }

  Instant begun_ = transport::monotonic_now();  // the thread may begin after the stall
  Duration worst_{};
  std::jthread thread_{[this](const std::stop_token& stop) { watch(stop); }};
};

// 1 where it cannot be run.
int run_once(const transport::ProcessPlan& plan) {
  auto process = transport::Process::spawn(plan);
  if (process) return process->wait().shell_code();
  std::fprintf(stderr, "by_wall_clock: %s\n", to_string(process.error()).c_str());
  return kFailed;
}

struct Try {
  int code = 0;
  Duration stall{};
  bool stood_still() const { return code != 0 && code != kOnlyLate && stall >= kStall; }
};

Try try_once(const transport::ProcessPlan& plan) {
  StallWatch watch;
  const int code = run_once(plan);
  return {code, watch.worst()};
}

int run(const transport::ProcessPlan& plan) {
  SpentOnTries spent;
  int stalls = 0;
  for (int tries = 1;; ++tries) {
    const Instant begun = transport::monotonic_now();
    const Try last = try_once(plan);
    const int code = last.code;
    if (code == 0 && tries > 1) std::printf("by_wall_clock: passed at try %d\n", tries);
    if (code == 0) return 0;
    const bool has_time = spent.all() < kForTries;
    if (last.stood_still()) {
      const bool again = has_time && ++stalls < kMostStalls;
      std::printf(
          "by_wall_clock: failed with %d at try %d; the machine stood still for %.0f ms%s\n", code,
          tries, last.stall.seconds() * 1e3, again ? ", so once more" : "");
      if (!again) return code;
    } else if (code == kOnlyLate) {
      std::printf("by_wall_clock: %s at try %d\n",
                  has_time ? "only late" : "not judged, the suite's minutes for tries are spent,",
                  tries);
      if (!has_time) return kNotJudged;
    } else {
      return code;
    }
    std::fflush(stdout);
    transport::nap(kRest);
    spent.add(transport::monotonic_now() - begun);
  }
}

}  // namespace
}  // namespace pitwall::testing

int main(int count, char** words) {
  using pitwall::bench::KeepAwake;
  const bool keep_awake = count > 1 && std::string_view{words[1]} == "--keep-awake";
  const int first = keep_awake ? 2 : 1;
  if (count <= first) {
    std::fprintf(stderr, "by_wall_clock: no command to run\n");
    return 1;
  }
  const auto awake = keep_awake ? std::make_unique<KeepAwake>() : nullptr;
  return pitwall::testing::run({.argv = {words + first, words + count}});
}
