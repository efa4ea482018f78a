// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/bench_clock/bench_clock.hpp"

#include <unistd.h>

#include <optional>

#include "protocol/transport/bench_clock/futex.hpp"
#include "protocol/transport/bench_clock/wall_clock.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::transport {
namespace {

std::optional<BenchClock>& of_this_program() {
  static std::optional<BenchClock> clock;
  return clock;
}

// The slot of the calling thread, free again when it ends.
struct OwnSlot {
  ClockSlot* slot = nullptr;
  ~OwnSlot() {
    if (slot == nullptr) return;
    slot->thread.store(0);
    slot->process.store(0);
  }
};
thread_local OwnSlot own;

}  // namespace

Result<bool, Problem> BenchClock::use(const std::string& path) {
  CHECK(!of_this_program());
  auto memory = ClockMemory::open(path);
  if (!memory) return Unexpected{memory.error()};
  of_this_program().emplace(*std::move(memory));
  return true;
}

BenchClock* BenchClock::used() {
  auto& clock = of_this_program();
  return clock ? &*clock : nullptr;
}

BenchClock::BenchClock(ClockMemory memory)
    : memory_(std::move(memory)),
      behind_at_start_ns_(pause_of(memory_.page(), wall_now).total.ns) {}

Instant BenchClock::now() const { return bench_now(memory_.page(), wall_now); }

BenchPause BenchClock::pause() const {
  const BenchPause seen = pause_of(memory_.page(), wall_now);
  const std::int64_t stood_ns = seen.total.ns - behind_at_start_ns_;
  std::int64_t most_ns = stood_ns_.load();
  while (stood_ns > most_ns && !stood_ns_.compare_exchange_weak(most_ns, stood_ns)) continue;
  return {.now = seen.now, .total = {std::max(stood_ns, most_ns)}};
}

bool BenchClock::take_turns() {
  if (own.slot != nullptr) return true;
  for (ClockSlot& slot : memory_.page().slots) {
    std::int32_t free = 0;
    if (!slot.process.compare_exchange_strong(free, ::getpid())) continue;
    slot.thread.store(::gettid());
    slot.due_ns.store(ClockSlot::kAtWork);
    slot.turns.fetch_or(1);  // at work
    slot.asleep.store(0);
    own.slot = &slot;
    return true;
  }
  return false;
}

BenchClock::Wait::Wait(Instant due) {
  if (own.slot == nullptr) return;
  own.slot->due_ns.store(due.ns, std::memory_order_relaxed);
  own.slot->turns.fetch_add(1, std::memory_order_release);
}

BenchClock::Wait::~Wait() {
  if (own.slot == nullptr) return;
  own.slot->due_ns.store(ClockSlot::kAtWork, std::memory_order_relaxed);
  own.slot->turns.fetch_add(1, std::memory_order_release);
}

void BenchClock::sleep_until(Instant deadline) {
  if (own.slot != nullptr) return sleep_on_bench(deadline);
  wait_until(deadline, [](Duration span) {
    nap(span);
    return false;
  });
}

// Bench time runs up to the horizon by the wall clock alone; until the horizon moves, time itself
// cannot wake anybody.
void BenchClock::sleep_on_bench(Instant deadline) {
  Instant at = now();
  const Wait wait{std::max(deadline, at)};
  const std::atomic<std::int64_t>& horizon_ns = memory_.page().horizon_ns;
  for (; at < deadline; at = now()) {
    if (horizon_ns.load() >= deadline.ns) {
      nap(deadline - at);
      continue;
    }
    own.slot->asleep.store(1);
    const bool woken =
        horizon_ns.load() >= deadline.ns || sleep_while(own.slot->asleep, 1, kCheckPeriod);
    own.slot->asleep.store(0);
    if (!woken) check_bench();
  }
}

void BenchClock::check_bench() {
  if (memory_.page().horizon_ns.load() == INT64_MAX || memory_.is_locked()) return;
  memory_.resume(wall_now());
}

}  // namespace pitwall::transport
