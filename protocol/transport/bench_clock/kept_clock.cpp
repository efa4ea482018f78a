// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/bench_clock/kept_clock.hpp"

#include <pthread.h>

#include <ctime>

#include "protocol/transport/posix_call.hpp"

namespace pitwall::transport {
namespace {

constexpr timespec kCheckPeriod{.tv_sec = 0, .tv_nsec = 1'000'000};  // half a lead

// Before those whose turns it gives; where that is not allowed they wait for it a little longer.
void be_urgent() {
  constexpr int kPriority = 90;
  const sched_param parameters{.sched_priority = kPriority};
  static_cast<void>(
      posix_call([&] { return ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters); },
                 Success::kZeroElseNumber));
}

}  // namespace

Result<KeptClock, Problem> KeptClock::keep(const std::string& path) {
  auto keeper = ClockKeeper::keep(path);
  if (!keeper) return Unexpected{keeper.error()};
  return KeptClock{std::make_unique<ClockKeeper>(*std::move(keeper))};
}

KeptClock::KeptClock(std::unique_ptr<ClockKeeper> keeper) : keeper_(std::move(keeper)) {
  keeper_->begin();
  thread_ = std::jthread{[own = keeper_.get()](const std::stop_token& stop) {
    be_urgent();
    while (!stop.stop_requested()) {
      own->advance();
      ::nanosleep(&kCheckPeriod, nullptr);
    }
  }};
}

KeptClock::~KeptClock() { end(); }

ClockWaits KeptClock::end() {
  if (!thread_.joinable()) return {};
  thread_.request_stop();
  thread_.join();
  keeper_->end();
  return keeper_->waits();
}

}  // namespace pitwall::transport
