// SPDX-License-Identifier: Apache-2.0
#include "tests/real_time/stall_watch.hpp"

#include <sched.h>

#include <algorithm>
#include <cstdio>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/realtime.hpp"
#include "protocol/transport/virtual_machine.hpp"

namespace pitwall::testing {
namespace {

constexpr int kHighest = 99;
constexpr Duration kLook = milliseconds(2);
constexpr Duration kLate = milliseconds(15);
constexpr Duration kTooLate = milliseconds(40);  // that of a live bench
constexpr int kTooMuch = 200;                    // 0.5 % of the time

Duration stolen() { return transport::stolen_time().value_or(Duration{}); }

}  // namespace

bool spoiled(const Stalls& stalls) {
  if (stalls.stolen * 2 < stalls.together) return false;  // late by something else than the host
  return stalls.worst > kTooLate || stalls.together * kTooMuch > stalls.watched;
}

std::string to_string(const Stalls& stalls) {
  char text[160];
  std::snprintf(text, sizeof text,
                "the host took %.0f ms of processor time, a processor was %d times away for more "
                "than 15 ms, for %.0f ms at worst, %.0f ms together",
                stalls.stolen.milliseconds(), stalls.count, stalls.worst.milliseconds(),
                stalls.together.milliseconds());
  return text;
}

StallWatch::StallWatch()
    : from_(transport::monotonic_now()), last_stall_(from_), stolen_before_(stolen()) {
  cpu_set_t ours;
  const bool known = sched_getaffinity(0, sizeof ours, &ours) == 0;
  const int count = known ? CPU_COUNT(&ours) : 1;
  for (int n = 0; n < count; ++n)
    threads_.emplace_back([this, n](const std::stop_token& stop) { look(n, stop); });
}

void StallWatch::look(int processor, const std::stop_token& stop) {
  const transport::OnOneProcessor pinned{processor};
  transport::request_realtime(kHighest);
  while (!stop.stop_requested()) {
    const Instant due = transport::monotonic_now() + kLook;
    transport::sleep_until(due);
    const Instant now = transport::monotonic_now();
    if (now - due > kLate) add(now - due, now);
  }
}

void StallWatch::add(Duration late, Instant now) {
  const std::lock_guard lock(mutex_);
  ++stalls_.count;
  stalls_.worst = std::max(stalls_.worst, late);
  stalls_.together = stalls_.together + late;
  last_stall_ = now;
}

Stalls StallWatch::seen() const {
  const std::lock_guard lock(mutex_);
  Stalls seen = stalls_;
  seen.stolen = stolen() - stolen_before_;
  seen.watched = (transport::monotonic_now() - from_) * static_cast<std::int64_t>(threads_.size());
  return seen;
}

Instant StallWatch::last_stall() const {
  const std::lock_guard lock(mutex_);
  return last_stall_;
}

}  // namespace pitwall::testing
