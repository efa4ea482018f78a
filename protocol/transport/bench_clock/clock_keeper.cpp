// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/bench_clock/clock_keeper.hpp"

#include <unistd.h>

#include <algorithm>

#include "protocol/transport/bench_clock/futex.hpp"
#include "protocol/transport/bench_clock/task_state.hpp"
#include "protocol/transport/bench_clock/wall_clock.hpp"

namespace pitwall::transport {

Result<ClockKeeper, Problem> ClockKeeper::keep(const std::string& path) {
  auto memory = ClockMemory::open(path);
  if (!memory) return Unexpected{memory.error()};
  if (!memory->lock()) return Unexpected{Problem{path, "another bench uses this clock file"}};
  memory->page().horizon_ns.store(INT64_MAX);
  return ClockKeeper{*std::move(memory)};
}

ClockKeeper::~ClockKeeper() {
  if (memory_.is_open()) end();
}

Instant ClockKeeper::now() const { return bench_now(memory_.page(), wall_now); }

void ClockKeeper::begin(Duration lead) {
  lead_ = lead;
  set_horizon((now() + lead_).ns);
}

bool ClockKeeper::advance(Instant limit, Instant now) {
  if (is_held_up(now)) return false;
  const Instant to = std::min(now + lead_, limit);
  if (to.ns <= memory_.page().horizon_ns.load()) return to > now;
  move_horizon(to, wall_now());
  return true;
}

void ClockKeeper::move_horizon(Instant to, Instant wall) {
  ClockPage& page = memory_.page();
  const std::int64_t horizon_ns = page.horizon_ns.load(), lost_ns = page.lost_ns.load();
  const Duration waited{wall.ns - lost_ns - horizon_ns};
  if (waited.ns > 0) {
    const std::uint64_t made = page.pauses_made.load();
    ClockPause& pause = page.pauses[made % ClockPage::kPauses];
    pause.from_ns.store(wall.ns - waited.ns);
    pause.to_ns.store(wall.ns);
    page.pauses_made.store(made + 1, std::memory_order_release);
    page.lost_ns.store(lost_ns + waited.ns, std::memory_order_release);
    count_wait(waited, {horizon_ns});
  }
  blamed_ = 0;
  set_horizon(to.ns);
}

// A thread sets `asleep` before it reads the horizon, so that it sees the new one or is woken.
void ClockKeeper::set_horizon(std::int64_t to_ns) {
  memory_.page().horizon_ns.store(to_ns);
  wake_sleepers();
}

void ClockKeeper::wake_sleepers() {
  ClockPage& page = memory_.page();
  const std::int64_t horizon_ns = page.horizon_ns.load();
  for (ClockSlot& slot : page.slots)
    if (slot.asleep.load() != 0 && slot.due_ns.load() <= horizon_ns && slot.asleep.exchange(0) != 0)
      wake(slot.asleep);
}

void ClockKeeper::count_wait(Duration waited, Instant at) {
  ++waits_.count;
  waits_.total = waits_.total + waited;
  if (waited <= waits_.longest) return;
  waits_.longest = waited;
  waits_.longest_at = at;
  waits_.longest_for = blamed_ == 0 ? std::string() : task_name(blamed_);
}

void ClockKeeper::leap(Instant to) {
  ClockPage& page = memory_.page();
  const Instant at = now();
  if (to <= at) return;
  page.horizon_ns.store(std::max(page.horizon_ns.load(), to.ns));
  page.lost_ns.store(wall_now().ns - to.ns, std::memory_order_release);
  wake_sleepers();
}

void ClockKeeper::end() {
  if (memory_.page().horizon_ns.load() != INT64_MAX) move_horizon(Instant::max(), wall_now());
}

bool ClockKeeper::is_held_up(Instant now) {
  for (std::size_t slot = 0; slot < ClockPage::kSlots; ++slot) {
    if (!holds_up(slot, now)) continue;
    blamed_ = memory_.page().slots[slot].process.load();
    return true;
  }
  return false;
}

bool ClockKeeper::holds_up(std::size_t index, Instant now) {
  ClockSlot& slot = memory_.page().slots[index];
  const std::int32_t process = slot.process.load(std::memory_order_acquire);
  const std::int32_t thread = slot.thread.load();
  if (process == 0) return false;
  if (thread == 0) {
    const TaskState state = task_state(process, process);
    if (state != TaskState::kGone) return state != TaskState::kStopped;  // just coming
  }
  const std::uint64_t turn = slot.turns.load(std::memory_order_acquire);
  const Instant due{slot.due_ns.load(std::memory_order_relaxed)};
  if (now - kGrace <= due || thread == ::gettid()) return false;  // nobody waits for himself
  Watch& watch = watches_[index];
  if (watch.turn != turn) {
    const bool at_work = turn % 2 != 0;
    watch = {.turn = turn, .since = at_work ? now - kGrace : due, .used = process_time(process)};
  }
  switch (task_state(process, thread)) {
    case TaskState::kGone: {
      std::int32_t dead = process;
      slot.thread.store(0);
      slot.process.compare_exchange_strong(dead, 0);
      return false;
    }
    case TaskState::kStopped:
      return false;
    case TaskState::kWaits:
      // A nap that ends soon; else something of its own.
      if (turn % 2 != 0) return false;
      break;
    case TaskState::kRuns:
      break;
  }
  const Duration worked = process_time(process) - watch.used;
  return now - kGrace - kGrace > watch.since + worked;
}

}  // namespace pitwall::transport
