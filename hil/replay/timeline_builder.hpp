// Builder of a timeline: frames and datagrams are put into their tracks in the order in which they
// are to be played.
//   in     tracks; frames and bytes with the stamp that they were recorded at
//   out    finish(): the timeline; tracks with nothing to play are not in it
//   units  stamps: nanoseconds on the calendar clock of the recording
//   errors finish() is a Problem where nothing is left to play, where an identifier of the filter
//          does not occur, or where it takes too long
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
  // Nothing, or which of the options cannot be.
  static std::optional<Problem> problem_of(const TimelineOptions& options);

  // `name`: what problems call the recording; `first`: its first stamp.
  TimelineBuilder(std::string name, UtcTime first, const TimelineOptions& options);

  // The track of an interface, which may be that of an earlier source; one of bytes.
  std::size_t bus(const std::string& interface);
  std::size_t bytes(const ByteTarget& to);
  // The track of a topic, which may be that of an earlier source; nothing: it has another type.
  std::optional<std::size_t> topic(const RosTopic& to);

  void add(std::size_t track, UtcTime at, const can::Frame& frame, std::uint8_t fd_flags);
  void add(std::size_t track, UtcTime at, std::span<const std::uint8_t> bytes);
  void leave_out(LeftOut left_out) { out_.left_out.push_back(std::move(left_out)); }

  Result<Timeline, Problem> finish() &&;

 private:
  // Nothing: it is not played.
  std::optional<Duration> due_of(UtcTime at);
  bool is_in_time(UtcTime at);
  Problem nothing_left() const;
  void add_track(Track track);
  void restamp();

  std::string name_;
  TimelineOptions options_;
  Timeline out_;
  FrameFilter filter_;
  std::vector<CounterHistory> histories_{};  // of each track where frames are restamped
  UtcTime origin_, begin_, end_, latest_;
  UtcTime newest_;                // of all that was added
  Duration elapsed_{}, first_{};  // of the recording, without what is left out
  bool too_long_ = false, ended_ = false;
};

}  // namespace pitwall::replay
