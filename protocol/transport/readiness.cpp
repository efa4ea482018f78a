// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/readiness.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <ctime>

#include "protocol/transport/bench_clock/bench_clock.hpp"
#include "protocol/transport/bench_clock/wall_clock.hpp"
#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::transport {

std::uint32_t wait_readable(std::span<const int> descriptors, Instant deadline, Duration longest) {
  CHECK(descriptors.size() <= kMaxWatched);
  std::array<pollfd, kMaxWatched> watched{};
  for (std::size_t i = 0; i < descriptors.size(); ++i)
    watched[i] = {.fd = descriptors[i], .events = POLLIN, .revents = 0};
  const auto wait = [&](auto&& left) {  // computed again after a signal
    return posix_call([&] {
      const std::int64_t left_ns = std::max<std::int64_t>(left().ns, 0);
      const timespec timeout{.tv_sec = left_ns / kNanosecondsPerSecond,
                             .tv_nsec = left_ns % kNanosecondsPerSecond};
      return ppoll(watched.data(), descriptors.size(), &timeout, nullptr);
    });
  };
  PosixOutcome outcome;
  const Instant give_up = longest == kNoTimeout ? Instant::max() : wall_now() + longest;
  if (BenchClock* const bench = BenchClock::used()) {
    bench->wait_until(deadline, [&](Duration span) {
      const Instant at = wall_now();
      const Instant end = span < give_up - at ? at + span : give_up;
      outcome = wait([&] { return end - wall_now(); });
      return outcome.value != 0 || end == give_up;
    });
  } else {
    outcome = wait([&] { return std::min(deadline, give_up) - wall_now(); });
  }
  std::uint32_t ready = 0;
  if (!outcome.ok()) return ready;
  for (std::size_t i = 0; i < descriptors.size(); ++i)
    if (watched[i].revents != 0) ready |= 1U << i;
  return ready;
}

ReadOutcome read_available(int descriptor, std::span<std::uint8_t> into) {
  const int watched[] = {descriptor};
  if (into.empty() || wait_readable(watched, Instant{}) == 0) return {};
  return read_now(descriptor, into);
}

ReadOutcome read_now(int descriptor, std::span<std::uint8_t> into) {
  if (into.empty()) return {};
  const auto got = posix_call([&] { return ::read(descriptor, into.data(), into.size()); });
  if (got.would_block()) return {};
  if (!got.ok() || got.value == 0) return {.bytes = 0, .ended = true};
  return {.bytes = static_cast<std::size_t>(got.value), .ended = false};
}

}  // namespace pitwall::transport
