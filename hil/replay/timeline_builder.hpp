// Builder of a timeline: frames and datagrams are added to their tracks in playing order.
//   in     tracks; frames and bytes with their recorded stamps
//   out    finish(): the timeline, without empty tracks
//   units  stamps: nanoseconds on the calendar clock of the recording
//   errors finish() returns a Problem if nothing is left to play, if an identifier of the filter
//          does not occur, if a pass takes more than a year, or if no frame could be restamped
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "hil/replay/frames/frame_filter.hpp"
#include "hil/replay/timeline.hpp"

namespace pitwall::replay {

class TimelineBuilder {
 public:
  // Which of the options is not allowed; empty if all are.
  static std::optional<Problem> problem_of(const TimelineOptions& options);

  // `name`: name of the recording in problems; `first`: its first stamp.
  TimelineBuilder(std::string name, UtcTime first, const TimelineOptions& options);

  // Track of an interface, which an earlier source may share; new track of bytes.
  std::size_t bus(const std::string& interface);
  std::size_t bytes(const ByteTarget& to);
  // Track of a topic, which an earlier source may share; empty if that source has another type.
  std::optional<std::size_t> topic(const RosTopic& to);

  void add(std::size_t track, UtcTime at, const can::Frame& frame, std::uint8_t fd_flags);
  void add(std::size_t track, UtcTime at, std::span<const std::uint8_t> bytes);
  void leave_out(LeftOut left_out) { out_.left_out.push_back(std::move(left_out)); }

  Result<Timeline, Problem> finish() &&;

 private:
  // Empty if the record is not played.
  std::optional<Duration> due_of(UtcTime at);
  bool is_in_time(UtcTime at);
  Problem nothing_left() const;
  void add_track(Track track);
  void restamp();

  std::string name_;
  TimelineOptions options_;
  Timeline out_;
  FrameFilter filter_;
  std::vector<CounterHistory> histories_{};  // of each track; empty without restamping
  UtcTime origin_, begin_, end_, latest_;
  UtcTime newest_;                // newest stamp of all added records
  Duration elapsed_{}, first_{};  // time of the recording without skipped gaps
  bool too_long_ = false, ended_ = false;
};

}  // namespace pitwall::replay
