// Sends a timeline at its due times: sleep to an absolute deadline, then hand every frame that is
// due within kGroup to the bus in one call.
//
//   due      |a b|  c        |d e f|            a, b and d, e, f: one call each
//   wake      ^     ^         ^  (+ wake-up latency: whatever became due meanwhile goes along)
//
//   in     Timeline; a rim that has now(), wait_until(), send(bus, frames), stopped()
//   out    PlayReport: counts and lateness (sent minus due; negative up to kGroup)
//   units  nanoseconds
//   errors a full queue is retried for kMaxRetry, then the frame is dropped and counted
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hil/replay/timeline.hpp"

namespace pitwall::replay {

inline constexpr Duration kGroup = microseconds(20);        // below what a wake-up costs
inline constexpr Duration kRetryPause = microseconds(200);  // a frame at 1 Mbit/s takes about 110
inline constexpr Duration kMaxRetry = milliseconds(50);

enum class LatePolicy : std::uint8_t {
  kCatchUp,  // late frames go out at once, in order; the schedule stays where it was
  kAbort,    // a frame later than PlayOptions::abort_after ends the replay
};

struct PlayOptions {
  unsigned passes = 1;
  LatePolicy late = LatePolicy::kCatchUp;
  Duration abort_after = milliseconds(100);
};

// Lateness by the microsecond; what is later than the last cell is kept as a maximum.
class LatenessHistogram {
 public:
  static constexpr std::size_t kCells = 20'000;
  void add(Duration lateness, std::uint64_t frames);
  // Upper edge of the cell that holds the given share of frames (0 < share <= 1).
  Duration quantile(double share) const;
  Duration latest() const { return latest_; }
  Duration earliest() const { return earliest_; }
  std::uint64_t count() const { return count_; }

 private:
  std::vector<std::uint64_t> cells_ = std::vector<std::uint64_t>(kCells + 1);
  std::uint64_t count_ = 0;
  Duration latest_{INT64_MIN};
  Duration earliest_{INT64_MAX};
};

struct PlayReport {
  std::uint64_t sent = 0, retries = 0, dropped = 0, calls = 0;
  bool aborted = false;  // by LatePolicy::kAbort
  bool stopped = false;  // by the rim
  Duration took{};
  LatenessHistogram lateness;
};

// One pass of one bus: where it is, and what is due next.
struct TrackCursor {
  std::size_t next = 0;
  bool done(const BusTrack& track) const { return next == track.frames.size(); }
};

// Number of frames from `next` on that are due at or before `limit` (since the start of the pass).
inline std::size_t due_count(const BusTrack& track, std::size_t next, Duration limit) {
  const auto begin = track.due.begin() + static_cast<std::ptrdiff_t>(next);
  return static_cast<std::size_t>(std::upper_bound(begin, track.due.end(), limit) - begin);
}

template <class Rim>
class Player {
 public:
  Player(const Timeline& timeline, const PlayOptions& options, Rim& rim)
      : timeline_(timeline), options_(options), rim_(rim), cursors_(timeline.buses.size()) {}

  PlayReport play(Instant start) {
    for (unsigned pass = 0; pass < options_.passes && !ended(); ++pass)
      play_pass(start + timeline_.pass * static_cast<std::int64_t>(pass));
    report_.took = rim_.now() - start;
    return std::move(report_);
  }

 private:
  bool ended() const { return report_.aborted || report_.stopped; }

  void play_pass(Instant start) {
    std::fill(cursors_.begin(), cursors_.end(), TrackCursor{});
    while (!ended()) {
      const Duration due = next_due();
      if (due == kNothingLeft) return;
      rim_.wait_until(start + due);
      if (rim_.stopped()) {
        report_.stopped = true;
        return;
      }
      for (std::size_t bus = 0; bus < cursors_.size() && !ended(); ++bus) send_due(bus, start);
    }
  }

  Duration next_due() const {
    Duration first = kNothingLeft;
    for (std::size_t bus = 0; bus < cursors_.size(); ++bus)
      if (!cursors_[bus].done(timeline_.buses[bus]))
        first = std::min(first, timeline_.buses[bus].due[cursors_[bus].next]);
    return first;
  }

  void send_due(std::size_t bus, Instant start) {
    const BusTrack& track = timeline_.buses[bus];
    TrackCursor& cursor = cursors_[bus];
    Instant now = rim_.now();
    const std::size_t count = due_count(track, cursor.next, now - start + kGroup);
    const std::size_t end = cursor.next + count;
    const Instant give_up = now + kMaxRetry;
    while (cursor.next < end) {
      const Duration late = now - (start + track.due[cursor.next]);
      if (options_.late == LatePolicy::kAbort && late > options_.abort_after) {
        report_.aborted = true;
        return;
      }
      const std::span<const can::Frame> rest(track.frames.data() + cursor.next, end - cursor.next);
      const std::size_t taken = rim_.send(bus, rest);
      now = rim_.now();
      ++report_.calls;
      record(track, cursor.next, taken, start, now);
      cursor.next += taken;
      if (taken == rest.size()) return;
      if (now < give_up) {
        ++report_.retries;
        rim_.wait_until(now + kRetryPause);
        now = rim_.now();
      } else {
        ++report_.dropped;
        ++cursor.next;
      }
    }
  }

  void record(const BusTrack& track, std::size_t first, std::size_t count, Instant start,
              Instant now) {
    for (std::size_t i = first; i < first + count; ++i)
      report_.lateness.add(now - (start + track.due[i]), 1);
    report_.sent += count;
  }

  static constexpr Duration kNothingLeft{INT64_MAX};

  const Timeline& timeline_;
  PlayOptions options_;
  Rim& rim_;
  std::vector<TrackCursor> cursors_;
  PlayReport report_;
};

}  // namespace pitwall::replay
