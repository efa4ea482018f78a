// Keeper of bench time: the time follows the wall clock, and stands while the host holds a process
// up.
//
//   wall clock   0 . . . 10 . . . 20 . . . 30 . . . 40
//   bench time   0 . . . 10 . . . . . . . . . 10 . . 20     the car had no processor from 10 to 30
//
//   in     the page; advance() called often, at least once in a lead
//   out    the page's horizon and lost time; what was waited for, in all and at the longest
//   invariants
//          time runs at most a lead past the last advance(). It stands while a thread that takes
//          turns is due and has had no processor for it. It runs on for one that is stopped (by a
//          scenario, or by a person), that blocks by its own doing, or that is gone; and at the
//          pace of its processor time for one that computes
//   errors keep(): Problem with the file's path, or another bench keeps it
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
  // How late somebody may be before time stands, and how far it runs without a new word.
  static constexpr Duration kGrace = milliseconds(1), kLead = milliseconds(2);

  static Result<ClockKeeper, Problem> keep(const std::string& path);
  ClockKeeper(ClockKeeper&& other) = default;
  ClockKeeper& operator=(ClockKeeper&&) = delete;
  ~ClockKeeper();

  Instant now() const;
  // From here on time needs advance() to go on; until end(), or the end of the keeper.
  void begin(Duration lead = kLead);
  // Never past `limit`, whoever keeps another clock beside this one. False: time stands.
  bool advance(Instant limit = Instant::max());
  // Forward, for one that follows another clock; what was waited for is not touched.
  void leap(Instant to);
  void end();
  // Somebody is due and is held up; the process is named in waits() if this lasts.
  bool is_held_up(Instant now);

  const ClockWaits& waits() const { return waits_; }

 private:
  // What was seen of a slot's present turn.
  struct Watch {
    std::uint64_t turn = UINT64_MAX;
    Instant since{};
    Duration used{};  // processor time then
  };

  explicit ClockKeeper(ClockMemory memory) : memory_(std::move(memory)) {}
  bool holds_up(std::size_t slot, Instant now);
  void move_horizon(Instant to, Instant wall);
  void count_wait(Duration waited, Instant at);

  ClockMemory memory_;
  std::array<Watch, ClockPage::kSlots> watches_;
  Duration lead_ = kLead;
  std::int32_t blamed_ = 0;  // the process that time last stood for
  ClockWaits waits_;
};

}  // namespace pitwall::transport
