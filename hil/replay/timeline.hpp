// Timeline of a log or a recording: one sequence of frames per bus and one of datagrams per
// receiver, ready for a socket.
//   in     CanLog or traffic::Recording, the target of each recorded source, speed, what to leave
//          out
//   out    frames or datagrams of each track in the order of the recording, with due times from the
//          start; which sources of a recording are not played, and why
//   units  nanoseconds since the start of a pass
//   errors Problem: a named source or identifier does not occur, or there is nothing to send
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hil/replay/formats/can_log.hpp"
#include "hil/replay/frames/frame_filter.hpp"
#include "hil/replay/frames/restamp_plan.hpp"
#include "hil/replay/recordings/recording.hpp"
#include "hil/replay/targets/byte_target.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/dds/domain.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::replay {

// Datagrams in one buffer, one after the other.
struct Datagrams {
  std::vector<std::uint8_t> bytes{};
  std::vector<std::size_t> ends{};  // end of datagram i in the bytes

  std::size_t size() const { return ends.size(); }
  std::span<const std::uint8_t> operator[](std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends[i - 1];
    return std::span{bytes}.subspan(begin, ends[i] - begin);
  }
};

// Frames of a bus; or, if `to` is set, datagrams: records of a stream or samples of a ROS 2 topic.
struct Track {
  std::string target;                    // the interface, or `to` as text
  std::vector<can::Frame> frames{};      // as sent in the first pass
  std::vector<std::uint8_t> fd_flags{};  // of frames[i], as logged
  std::vector<Duration> due{};           // of frame or datagram i; never decreasing
  std::optional<ByteTarget> to{};
  Datagrams datagrams{};
  RestampPlan restamp{};  // counters and checksums of the frames in later passes
};

struct LeftOut {
  std::string source, why;
  std::uint64_t records = 0;
};

struct Timeline {
  std::vector<Track> tracks;
  Duration pass{};  // from the first frame or datagram of one pass to the first of the next
  std::uint64_t frames = 0, datagrams = 0;
  std::vector<LeftOut> left_out{};         // sources that are not played
  std::uint64_t filtered = 0;              // frames per pass that the filter leaves out
  std::uint64_t restamped = 0, unfit = 0;  // frames of a pass, as RestampPlan counts them

  std::optional<dds::DomainConfig> dds{};  // domain of the topics

  std::uint64_t size() const { return frames + datagrams; }
};

struct TimelineOptions {
  double speed = 1.0;
  // For every channel that `map` does not name; empty: the recorded name.
  std::string interface {};
  std::vector<std::pair<std::string, std::string>> map{};       // recorded name, name to send on
  std::vector<std::pair<std::string, ByteTarget>> receivers{};  // of a recording
  // For the ROS 2 topics of a recording; empty: they are not played.
  std::optional<dds::DomainConfig> dds{};
  Duration from{}, until{INT64_MAX};     // part to play, [from, until) since the first stamp
  Duration longest_gap{INT64_MAX};       // longer gaps are skipped: the next frame follows at once
  std::vector<std::string> topics{};     // only these sources or channels; empty: all
  std::vector<std::uint32_t> ids{};      // only frames with these identifiers; empty: all
  std::vector<std::uint32_t> not_ids{};  // no frames with these identifiers
  std::vector<SendingNode> nodes{};      // of a database; the filter leaves their frames out
  std::shared_ptr<const RestampRules> restamp{};  // null: frames as recorded
};

// A record with an earlier stamp than the one before is due together with it: the order of the log
// is kept. Due times are computed from the start, not from frame to frame, so the speed causes no
// drift. Passes follow each other with the mean gap of the log. `from`, `until` and `longest_gap`
// are times of the log, before the speed is applied.
Result<Timeline, Problem> make_timeline(const CanLog& log, const TimelineOptions& options);

// The same for a recording, in its total order; tracks are in the order of its sources. A CAN
// source needs `map` or `interface` if its name is not that of an interface. /can/out, which the
// car itself sent, is played only if `map` names it. Receivers go to their target in `receivers`,
// in datagrams of at most transport::kMaxDatagramBytes; ROS 2 topics keep their name and type.
Result<Timeline, Problem> make_timeline(const traffic::Recording& recording,
                                        const TimelineOptions& options);

}  // namespace pitwall::replay
