// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/realtime.hpp"

#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "protocol/transport/posix_call.hpp"

namespace pitwall::transport {

void return_free_memory() { malloc_trim(0); }

bool lock_memory() {
  return posix_call([] { return mlockall(MCL_CURRENT | MCL_FUTURE); }).ok();
}

RealtimeReport request_realtime(int priority) {
  RealtimeReport report;
  // Without SCHED_FIFO the kernel may wake us 50 us late to save wake-ups; that is never refused.
  static_cast<void>(posix_call([] { return prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL); }));
  const auto locked = posix_call([] { return mlockall(MCL_CURRENT | MCL_FUTURE); });
  report.memory_locked = locked.ok();
  report.memory_error = locked.error;
  sched_param parameters{};
  parameters.sched_priority = priority;
  const auto scheduled = posix_call(
      [&] { return sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters); });
  report.fifo = scheduled.ok();
  report.fifo_error = scheduled.error;
  return report;
}

void release_realtime() {
  const sched_param ordinary{};
  constexpr int kOrdinary = SCHED_OTHER | SCHED_RESET_ON_FORK;  // only root may take the flag back
  static_cast<void>(posix_call([&] { return sched_setscheduler(0, kOrdinary, &ordinary); }));
  static_cast<void>(posix_call([] { return munlockall(); }));
}

void lower_priority() {
  constexpr int kNicer = 10;
  static_cast<void>(nice(kNicer));  // of this thread alone on Linux; never refused upwards
}

std::string to_string(const RealtimeReport& report) {
  const auto say = [](bool granted, int error) {
    return granted ? std::string("granted")
                   : "refused (" + PosixOutcome{.value = -1, .error = error}.reason() + ")";
  };
  return "memory lock " + say(report.memory_locked, report.memory_error) + ", SCHED_FIFO " +
         say(report.fifo, report.fifo_error);
}

bool raise_priority(pid_t process) {
  constexpr int kPreferred = -15;
  return posix_call(
             [&] { return setpriority(PRIO_PROCESS, static_cast<id_t>(process), kPreferred); })
      .ok();
}

OnOneProcessor::OnOneProcessor(int n) {
  if (!posix_call([&] { return sched_getaffinity(0, sizeof before_, &before_); }).ok()) return;
  const int count = CPU_COUNT(&before_);
  n = (n % count + count) % count;
  for (std::size_t processor = 0; processor < CPU_SETSIZE; ++processor) {
    if (!CPU_ISSET(processor, &before_) || n-- != 0) continue;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(processor, &one);
    static_cast<void>(posix_call([&] { return sched_setaffinity(0, sizeof one, &one); }));
    return;
  }
}

OnOneProcessor::~OnOneProcessor() {
  if (CPU_COUNT(&before_) == 0) return;
  static_cast<void>(posix_call([&] { return sched_setaffinity(0, sizeof before_, &before_); }));
}

}  // namespace pitwall::transport
