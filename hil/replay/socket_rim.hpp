// The player's rim on this machine: real clock, real sockets.
//
//   deadline              |
//   sleep    ...........|  (lead before it)
//   wake             ....|  somewhere here: late by what a sleep is usually late
//   look                  |  at the clock, until it is time
//
// A sleep ends late, by 50 to 100 us in a guest and a few on a quiet host, and not always by the
// same. So it is set to end early by the lead, and what is left is spent looking at the clock; gaps
// shorter than the lead are not slept through at all. In a guest a system call takes as long as a
// short frame on the wire, so signals are looked at only where there is time.
//
// Each track of frames has a CAN socket, each track of datagrams a UDP socket, a TCP port or a
// serial device of its own; ROS 2 topics share a participant. A stream takes a record whole or
// refuses it at once, and what it could not write yet goes out with the next record, or while the
// rim waits.
//
//   in     timeline, which stays where it is as long as the rim; the lead (measured, or
//          given; 0: plain sleeps)
//   out    now(), wait_until(), send(), stopped() as Player asks for them
//   errors open(): Problem. While playing: SendOutcome only
//   bound  a datagram that the kernel took may still be lost: a full receive queue drops it, which
//          only its owner can count. That nobody listens the kernel tells, and unheard() says. Of a
//          topic DDS keeps the newest 64 messages for a reader that is behind; what it then misses
//          only the reader can count
//   cost   the lead is time of the processor that nobody else gets, once per wake-up; where that
//          would be more than a quarter of all time (BusyBudget), sleeps are plain for a while
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "hil/replay/busy_budget.hpp"
#include "hil/replay/player.hpp"
#include "hil/replay/timeline.hpp"
#include "protocol/dds/domain.hpp"
#include "protocol/transport/can/can_sender.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/stream/stream_sender.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::replay {

inline constexpr Duration kMaxLead = microseconds(200);
inline constexpr std::size_t kMaxStreams = 16;

// A TCP port or a serial device: what became of its bytes.
struct StreamReport {
  std::string target;
  transport::StreamSenderCounters counters;
};

class SocketRim {
 public:
  // Everything is laid out for the kernel here. The stop signal is installed.
  static Result<SocketRim, Problem> open(const Timeline& timeline);

  // How late sleeps of this thread are nearly always at most, up to kMaxLead; takes 40 ms.
  static Duration measured_lead();
  void set_lead(Duration lead);

  // Until each TCP port has a caller and each topic a reader, at most so long.
  void wait_for_callers(Duration patience);
  // Until the streams have written what they have and the readers of topics have it, at most so
  // long; what a stream has left then is lost.
  void finish(Duration patience);

  Instant now();
  void wait_until(Instant deadline);
  TrackOutcome send(std::size_t track, std::size_t first, std::size_t count);
  // Restamps the frames of the track before `end`, which have gone, for the pass.
  void prepare(std::size_t track, std::size_t end, unsigned pass);
  bool stopped() const { return stopped_; }
  // The last error of the kernel but a full queue, for people; empty: none.
  std::string last_error() const;
  // Datagrams of a track that nobody listened to, as far as the kernel said so.
  std::uint64_t unheard(std::size_t track) const;
  std::vector<StreamReport> streams() const;
  // Of the topics, those that nobody reads now.
  std::vector<std::string> unread_topics() const;

 private:
  struct Bus {
    transport::CanSender sender;
    transport::PreparedFrames frames;
    const Track* track;
    std::size_t prepared = 0;  // frames before it are those of `pass`
    unsigned pass = 0;
  };
  struct Line {
    transport::UdpSocket socket;
    const Datagrams* datagrams;
  };
  struct Stream {
    std::string target;
    transport::StreamSender sender;
    const Datagrams* datagrams;
  };
  struct Topic {
    std::string target;
    dds::Writer* writer;
    const Datagrams* datagrams;
  };
  using Sender = std::variant<Bus, Line, Stream, Topic>;
  static Result<Sender, Problem> open(const Track& track, dds::Domain* domain);
  static Result<Sender, Problem> open_receiver(const Track& track);
  static Result<Sender, Problem> open_topic(const Track& track, dds::Domain& domain);
  static transport::SendOutcome send(Line& line, std::size_t first, std::size_t count);
  static TrackOutcome send(Stream& stream, std::size_t first, std::size_t count);
  static TrackOutcome send(Topic& topic, std::size_t first, std::size_t count);
  SocketRim(std::unique_ptr<dds::Domain> domain, std::vector<Sender> senders,
            transport::StopSignal stop)
      : domain_(std::move(domain)), senders_(std::move(senders)), stop_(std::move(stop)) {
    for (std::size_t i = 0; i < senders_.size(); ++i)
      if (std::holds_alternative<Stream>(senders_[i])) streams_.push_back(i);
  }
  void look_for_signals(Instant deadline);
  static bool is_awaited(const Sender& sender);
  void serve_streams();
  template <class Done>
  void serve_until(Instant give_up, Done&& done);

  std::unique_ptr<dds::Domain> domain_;  // none: no track is a topic
  std::vector<Sender> senders_;          // of each track
  std::vector<std::size_t> streams_;     // those of them that are streams
  transport::StopSignal stop_;
  Duration lead_{};
  Duration half_look_{};  // of what one look at the clock takes
  Instant read_{};        // what the clock last said
  Instant looked_{};      // for signals
  BusyBudget budget_;
  bool stopped_ = false;
  int last_error_ = 0;
};

}  // namespace pitwall::replay
