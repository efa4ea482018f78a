// Keeper of bench time: bench time follows the wall clock, and stands while the host gives a
// process no processor.
//
//   wall clock   0 . . . 10 . . . 20 . . . 30 . . . 40
//   bench time   0 . . . 10 . . . . . . . . . 10 . . 20     the car had no processor from 10 to 30
//
//   in     the clock page; calls of advance(), at least one per lead
//   out    horizon and lost time of the page; record of the waits
//   invariants
//          time runs at most one lead past the last advance(). It stands while a thread that takes
//          turns is due and gets no processor. It runs on for a thread that is stopped (by a
//          scenario or by a person), blocks on its own or has ended; for a thread that computes it
//          runs at the rate of its processor time
//   errors keep(): Problem with the path of the file, or if another bench keeps it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "protocol/transport/bench_clock/clock_memory.hpp"
#include "protocol/transport/bench_clock/clock_waits.hpp"

namespace pitwall::transport {

class ClockKeeper {
 public:
  // Delay of a thread before time stands, and time that runs without a new advance().
  static constexpr Duration kGrace = milliseconds(1), kLead = milliseconds(2);

  static Result<ClockKeeper, Problem> keep(const std::string& path);
  ClockKeeper(ClockKeeper&& other) = default;
  ClockKeeper& operator=(ClockKeeper&&) = delete;
  ~ClockKeeper();

  Instant now() const;
  // From now on time runs only by advance(), until end() or the destruction of the keeper.
  void begin(Duration lead = kLead);
  // Lets time run on, never past `limit`, which another clock may set. False: time stands.
  bool advance(Instant limit = Instant::max()) { return advance(limit, now()); }
  bool advance(Instant limit, Instant now);  // `now`: bench time as just read
  // Sets time forward, for a bench that follows another clock; waits() does not change.
  void leap(Instant to);
  void end();
  // True if a thread is due and gets no processor; waits() names its process if this lasts.
  bool is_held_up(Instant now);

  const ClockWaits& waits() const { return waits_; }
  void restart_waits() { waits_ = {}; }

 private:
  // Observation of the present turn of a slot.
  struct Watch {
    std::uint64_t turn = UINT64_MAX;
    Instant since{};
    Duration used{};  // processor time of the process at the first observation
  };

  explicit ClockKeeper(ClockMemory memory) : memory_(std::move(memory)) {}
  bool holds_up(std::size_t slot, Instant now);
  void move_horizon(Instant to, Instant wall);
  void set_horizon(std::int64_t to_ns);
  void wake_sleepers();
  void count_wait(Duration waited, Instant at);

  ClockMemory memory_;
  std::array<Watch, ClockPage::kSlots> watches_;
  Duration lead_ = kLead;
  std::int32_t blamed_ = 0;  // the process for which time last stood
  ClockWaits waits_;
};

}  // namespace pitwall::transport
