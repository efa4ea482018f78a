// Timeline of a log or a recording: one sequence of frames per bus and one of datagrams per
// receiver, ready for a socket.
//   in     CanLog or traffic::Recording, which recorded source goes where, speed, what to leave out
//   out    frames or datagrams of each track in the order of the recording, with due times from the
//          start; what of a recording is not played, and why
//   units  nanoseconds since the start of a pass
//   errors Problem: a source or an identifier that is named and does not occur, or nothing to send
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

// Datagrams one behind the other.
struct Datagrams {
  std::vector<std::uint8_t> bytes{};
  std::vector<std::size_t> ends{};  // of datagram i in the bytes

  std::size_t size() const { return ends.size(); }
  std::span<const std::uint8_t> operator[](std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends[i - 1];
    return std::span{bytes}.subspan(begin, ends[i] - begin);
  }
};

// Frames of a bus, or datagrams where there is a target of bytes: records of a stream, samples of a
// ROS 2 topic.
struct Track {
  std::string target;                    // the interface, or `to` as text
  std::vector<can::Frame> frames{};      // as they go out in the first pass
  std::vector<std::uint8_t> fd_flags{};  // of frames[i], as logged
  std::vector<Duration> due{};           // of frame or datagram i; never decreasing
  std::optional<ByteTarget> to{};
  Datagrams datagrams{};
  RestampPlan restamp{};  // of the frames, for the passes that follow
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
  std::uint64_t filtered = 0;              // frames of a pass that ids and nodes leave out
  std::uint64_t restamped = 0, unfit = 0;  // frames of a pass, as RestampPlan counts them

  std::optional<dds::DomainConfig> dds{};  // where the topics are

  std::uint64_t size() const { return frames + datagrams; }
};

struct TimelineOptions {
  double speed = 1.0;
  std::string interface {};  // for every channel that the map does not name; empty: its own name
  std::vector<std::pair<std::string, std::string>> map{};       // recorded name, name to send on
  std::vector<std::pair<std::string, ByteTarget>> receivers{};  // of a recording
  std::optional<dds::DomainConfig> dds{};  // for the ROS 2 topics of a recording; none: not played
  Duration from{}, until{INT64_MAX};       // what is played, since the first stamp; without its end
  Duration longest_gap{INT64_MAX};       // a longer one is skipped: the next frame follows at once
  std::vector<std::string> topics{};     // sources or channels: only these; none: all
  std::vector<std::uint32_t> ids{};      // of frames: only these; none: all
  std::vector<std::uint32_t> not_ids{};  // of frames: but these
  std::vector<SendingNode> nodes{};  // of a database; the frames of those left out are not played
  std::shared_ptr<const RestampRules> restamp{};  // none: frames as they were recorded
};

// A stamp that goes back is due with the frame before it: the order of the log is kept. Due times
// are computed from the start, not from frame to frame, so speed brings no drift. Passes follow
// each other with the mean gap of the log. From, until and gaps are those of the log, before speed.
Result<Timeline, Problem> make_timeline(const CanLog& log, const TimelineOptions& options);

// The same of a recording, in its total order; tracks stand in the order of its sources. A CAN
// source whose name is that of no interface needs `map` or `interface`; /can/out, which the car
// said itself, is played where `map` names it only. Receivers go to their target of `receivers`,
// in datagrams of at most transport::kMaxDatagramBytes; ROS 2 topics keep their name and type.
Result<Timeline, Problem> make_timeline(const traffic::Recording& recording,
                                        const TimelineOptions& options);

}  // namespace pitwall::replay
