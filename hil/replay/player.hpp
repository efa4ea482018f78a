// Player of a timeline at its due times: sleeps until an absolute deadline, then passes every frame
// and datagram that is due within kGroup to its track in one call. Between waking up and sending it
// neither reads a clock nor encodes nor allocates.
//
//   due      |a b|  c        |d e f|            a, b and d, e, f: one call each
//   wake      ^     ^         ^  (records that become due during the call go with the next one)
//   calls    sleep, send per track in turn, clock; no sleep if the next record is due already
//
//   in     Timeline; the I/O: now(), wait_until(), send(track, first, count), stopped(); if it
//          has prepare(track, end, pass), that is called while there is time, and the records of
//          the track before `end` are sent next in that pass
//   out    PlayReport: counts, lateness (sent minus due; negative up to kGroup), dropped records
//   units  nanoseconds
//   invariants
//          a track keeps its order, and no track is ahead of another by more than kGroup of due
//          time, even if the player is late; records due at the same time are sent in the order of
//          the tracks
//   errors a full queue is retried for kMaxRetry, then the record is dropped and counted; any other
//          refusal of the kernel drops and counts it at once
//   cost   O(1) per record and track; allocates in its constructor only
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "hil/replay/lateness_histogram.hpp"
#include "hil/replay/timeline.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"

namespace pitwall::replay {

inline constexpr Duration kGroup = microseconds(20);        // less than the duration of a wake-up
inline constexpr Duration kRetryPause = microseconds(200);  // a frame at 1 Mbit/s takes about 110
inline constexpr Duration kMaxRetry = milliseconds(50);
inline constexpr std::size_t kListedDrops = 20;

enum class LatePolicy : std::uint8_t {
  kCatchUp,  // late frames are sent at once, in order; the schedule does not shift
  kDrop,     // records later than PlayOptions::late_limit are not sent; reads the clock once more
  kAbort,    // such a record ends the replay; reads the clock once more
};

struct PlayOptions {
  unsigned passes = 1;
  LatePolicy late = LatePolicy::kCatchUp;
  Duration late_limit = milliseconds(100);  // of kDrop and kAbort
};

// Result of send(): number of leading records taken, and whether the queue was full.
struct TrackOutcome {
  std::size_t taken = 0;
  bool full = false;
};

struct DroppedRecord {
  unsigned pass = 0;
  std::size_t track = 0, record = 0;  // indices of the track, and of the record in it
  Duration late{};
};

struct PlayCount {
  std::uint64_t sent = 0;
  std::uint64_t dropped_late = 0;     // by LatePolicy::kDrop
  std::uint64_t dropped_full = 0;     // queue full for kMaxRetry
  std::uint64_t dropped_refused = 0;  // any other error of the kernel

  std::uint64_t dropped() const { return dropped_late + dropped_full + dropped_refused; }
};

struct PlayReport {
  PlayCount frames, datagrams;
  std::uint64_t calls = 0, waits = 0, retries = 0;
  FixedVector<DroppedRecord, kListedDrops> dropped_list;  // the first kListedDrops
  bool aborted = false;                                   // by LatePolicy::kAbort
  bool stopped = false;                                   // by the I/O object
  Duration took{};
  Duration seam_error{};  // largest error of a gap between two passes: sent minus planned
  LatenessHistogram lateness;

  std::uint64_t dropped() const { return frames.dropped() + datagrams.dropped(); }
};

template <class Io>
class Player {
 public:
  Player(const Timeline& timeline, const PlayOptions& options, Io& io)
      : timeline_(timeline), options_(options), io_(io), cursors_(timeline.tracks.size()) {}

  PlayReport play(Instant start) {
    now_ = io_.now();
    for (pass_ = 0; pass_ < options_.passes && !ended(); ++pass_) {
      start_ = start + timeline_.pass * static_cast<std::int64_t>(pass_);  // no drift over passes
      play_pass();
    }
    report_.took = now_ - start;
    return std::move(report_);
  }

 private:
  // Position of a track in its pass: records before `next` are finished, those before `recorded`
  // are in the histogram.
  struct Cursor {
    std::size_t next = 0, recorded = 0;
  };

  PlayCount& count_of(std::size_t track) {
    return timeline_.tracks[track].to ? report_.datagrams : report_.frames;
  }
  bool ended() const { return report_.aborted || report_.stopped; }
  bool judges_lateness() const { return options_.late != LatePolicy::kCatchUp; }

  void play_pass() {
    std::fill(cursors_.begin(), cursors_.end(), Cursor{});
    while (!ended()) {
      const Duration due = next_due();
      if (due == kNothingLeft) return;
      wait_until(start_ + due);
      for (std::size_t track = 0; track < cursors_.size() && !ended(); ++track)
        send_due(track, due);
      now_ = io_.now();
      for (std::size_t track = 0; track < cursors_.size(); ++track) record(track);
      prepare_next_pass();
    }
  }

  void prepare_next_pass() {
    if constexpr (requires { io_.prepare(std::size_t{}, std::size_t{}, 0U); }) {
      if (pass_ + 1 == options_.passes) return;
      for (std::size_t track = 0; track < cursors_.size(); ++track)
        io_.prepare(track, cursors_[track].next, pass_ + 1);
    }
  }

  Duration next_due() const {
    Duration first = kNothingLeft;
    for (std::size_t track = 0; track < cursors_.size(); ++track) {
      const Track& plan = timeline_.tracks[track];
      if (cursors_[track].next < plan.due.size())
        first = std::min(first, plan.due[cursors_[track].next]);
    }
    return first;
  }

  // Afterwards now_ is the deadline or later; the clock is read only if lateness is checked.
  void wait_until(Instant deadline) {
    if (now_ < deadline) {
      io_.wait_until(deadline);
      ++report_.waits;
      now_ = judges_lateness() ? io_.now() : deadline;
    }
    report_.stopped = io_.stopped();
  }

  void send_due(std::size_t track, Duration due) {
    const Track& plan = timeline_.tracks[track];
    Cursor& cursor = cursors_[track];
    if (judges_lateness()) refuse_late(track);
    // with several tracks no track may run ahead of the others
    const Duration until = cursors_.size() == 1 ? now_ - start_ : due;
    const Duration limit = until + kGroup;
    std::size_t end = cursor.next;
    while (end < plan.due.size() && plan.due[end] <= limit) ++end;
    const Instant give_up = now_ + kMaxRetry;
    while (cursor.next < end && !ended()) {
      const TrackOutcome outcome = io_.send(track, cursor.next, end - cursor.next);
      ++report_.calls;
      count_of(track).sent += outcome.taken;
      cursor.next += outcome.taken;
      if (cursor.next == end) return;
      now_ = io_.now();
      record(track);
      retry_or_drop(track, outcome.full, give_up);
    }
  }

  // The record at the cursor was not taken.
  void retry_or_drop(std::size_t track, bool full, Instant give_up) {
    if (full && now_ < give_up) {
      ++report_.retries;
      io_.wait_until(now_ + kRetryPause);
      now_ = io_.now();
      if (judges_lateness()) refuse_late(track);
    } else {
      drop(track, full ? count_of(track).dropped_full : count_of(track).dropped_refused);
    }
  }

  // Due times never decrease, so the records that are too late are the first ones.
  void refuse_late(std::size_t track) {
    const Track& plan = timeline_.tracks[track];
    const Cursor& cursor = cursors_[track];
    while (cursor.next < plan.due.size() && lateness(track, cursor.next) > options_.late_limit) {
      if (options_.late == LatePolicy::kAbort) {
        report_.aborted = true;
        return;
      }
      drop(track, count_of(track).dropped_late);
    }
  }

  void drop(std::size_t track, std::uint64_t& counter) {
    Cursor& cursor = cursors_[track];
    ++counter;
    static_cast<void>(  // further ones are only counted
        report_.dropped_list.push({pass_, track, cursor.next, lateness(track, cursor.next)}));
    cursor.recorded = ++cursor.next;
  }

  void record(std::size_t track) {
    Cursor& cursor = cursors_[track];
    for (; cursor.recorded < cursor.next; ++cursor.recorded) {
      const Duration late = lateness(track, cursor.recorded);
      report_.lateness.add(late);
      if (pass_ != last_pass_) note_seam(late - last_late_);
      last_pass_ = pass_;
      last_late_ = late;
    }
  }

  void note_seam(Duration error) {
    report_.seam_error = std::max({report_.seam_error, error, -error});
  }

  Duration lateness(std::size_t track, std::size_t record) const {
    return now_ - (start_ + timeline_.tracks[track].due[record]);
  }

  static constexpr Duration kNothingLeft{INT64_MAX};

  const Timeline& timeline_;
  PlayOptions options_;
  Io& io_;
  std::vector<Cursor> cursors_;
  PlayReport report_;
  unsigned pass_ = 0, last_pass_ = 0;  // present pass; pass of the last record that was sent
  Instant start_{}, now_{};
  Duration last_late_{};
};

}  // namespace pitwall::replay
