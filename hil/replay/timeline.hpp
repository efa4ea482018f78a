// Timeline of a log: one sequence of frames per bus, ready for a socket.
//   in     CanLog, which recorded channel goes to which bus, speed, what to leave out
//   out    frames of each bus in the order of the log, with due times from the start
//   units  nanoseconds since the start of a pass
//   errors Problem: a channel without a bus, or nothing to send
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hil/replay/formats/can_log.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::replay {

struct BusTrack {
  std::string interface;
  std::vector<can::Frame> frames;
  std::vector<std::uint8_t> fd_flags{};  // of frames[i], as logged
  std::vector<Duration> due{};           // of frames[i]; never decreasing
};

struct Timeline {
  std::vector<BusTrack> buses;
  Duration pass{};  // from the first frame of one pass to the first of the next
  std::uint64_t frames = 0;
};

struct TimelineOptions {
  double speed = 1.0;
  std::string interface {};  // for every channel that the map does not name; empty: its own name
  std::vector<std::pair<std::string, std::string>> map{};  // recorded name, name to send on
  Duration start{};                  // of the log that is left out at its beginning
  Duration longest_gap{INT64_MAX};   // a longer one is skipped: the next frame follows at once
  std::vector<std::uint32_t> ids{};  // only these; none: all
};

// A stamp that goes back is due with the frame before it: the order of the log is kept. Due times
// are computed from the start, not from frame to frame, so speed brings no drift. Passes follow
// each other with the mean gap of the log. Start and gaps are those of the log, before speed.
Result<Timeline, Problem> make_timeline(const CanLog& log, const TimelineOptions& options);

}  // namespace pitwall::replay
