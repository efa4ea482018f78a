// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/bench_clock/futex.hpp"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <climits>

#include "protocol/transport/bench_clock/wall_clock.hpp"
#include "protocol/transport/posix_call.hpp"

namespace pitwall::transport {

bool sleep_while(const std::atomic<std::uint32_t>& word, std::uint32_t value, Duration longest) {
  const timespec limit = to_timespec(longest);
  const auto outcome =
      posix_call([&] { return ::syscall(SYS_futex, &word, FUTEX_WAIT, value, &limit); });
  return outcome.error != ETIMEDOUT;
}

void wake(std::atomic<std::uint32_t>& word) {
  static_cast<void>(posix_call([&] { return ::syscall(SYS_futex, &word, FUTEX_WAKE, INT_MAX); }));
}

}  // namespace pitwall::transport
