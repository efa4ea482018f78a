// Clock and sockets of the player: the real-time implementation of what Player requires.
//
//   deadline              |
//   sleep    ...........|  (lead before it)
//   wake             ....|  within this range, late by the usual lateness of a sleep
//   look                  |  busy wait on the clock until the deadline
//
// A sleep ends late, by 50 to 100 us in a guest and a few us on a quiet host, and by a varying
// amount. So each sleep is set to end early by the lead, and the rest is a busy wait on the clock;
// there is no sleep in gaps shorter than the lead. In a guest a system call takes as long as a
// short frame on the wire, so signals are polled only where there is time.
//
// Each track of frames has a CAN socket of its own, each track of datagrams a UDP socket, a TCP
// port or a serial device; ROS 2 topics share a participant. A stream takes a record whole or
// refuses it at once. Bytes that it could not write yet go out with the next record, or while the
// player waits.
//
//   in     timeline, which must not move while this object exists; the lead (measured, or given;
//          0: plain sleeps)
//   out    now(), wait_until(), send(), stopped(), as Player requires
//   errors open(): Problem. While playing: SendOutcome only
//   bound  a datagram that the kernel took may still be lost in a full receive queue, which only
//          the owner of the queue can count. If no socket listens, the kernel reports it, and
//          undelivered() counts it. DDS keeps the newest 64 messages of a topic for a slow reader;
//          only the reader can count what it misses
//   cost   one lead of busy waiting per wake-up; if that would exceed a quarter of all time
//          (BusyBudget), sleeps are plain for a while
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

// Result of a TCP port or a serial device: the counters of its bytes.
struct StreamReport {
  std::string target;
  transport::StreamSenderCounters counters;
};

class SocketIo {
 public:
  // Prepares all sockets and frames, and installs the stop signal.
  static Result<SocketIo, Problem> open(const Timeline& timeline);

  // Usual upper limit of the lateness of a sleep of this thread, at most kMaxLead; takes 40 ms.
  static Duration measured_lead();
  void set_lead(Duration lead);

  // Waits until each TCP port has a client and each topic a reader, at most `timeout`.
  void wait_for_clients(Duration timeout);
  // Waits until the streams have written their bytes and the readers of topics have received
  // theirs, at most `timeout`; what a stream has left then is lost.
  void finish(Duration timeout);

  Instant now();
  void wait_until(Instant deadline);
  TrackOutcome send(std::size_t track, std::size_t first, std::size_t count);
  // Restamps the frames of the track before `end`, which are already sent, for pass `pass`.
  void prepare(std::size_t track, std::size_t end, unsigned pass);
  bool stopped() const { return stopped_; }
  // Text of the last kernel error other than a full queue; empty if there was none.
  std::string last_error() const;
  // Datagrams of a track that no socket received, as far as the kernel reported it.
  std::uint64_t undelivered(std::size_t track) const;
  std::vector<StreamReport> streams() const;
  // The topics that have no reader now.
  std::vector<std::string> unread_topics() const;

 private:
  struct Bus {
    transport::CanSender sender;
    transport::PreparedFrames frames;
    const Track* track;
    std::size_t prepared = 0;  // frames before this index are stamped for `pass`
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
  SocketIo(std::unique_ptr<dds::Domain> domain, std::vector<Sender> senders,
           transport::StopSignal stop)
      : domain_(std::move(domain)), senders_(std::move(senders)), stop_(std::move(stop)) {
    for (std::size_t i = 0; i < senders_.size(); ++i)
      if (std::holds_alternative<Stream>(senders_[i])) streams_.push_back(i);
  }
  void poll_signals(Instant deadline);
  static bool is_awaited(const Sender& sender);
  void serve_streams();
  template <class Done>
  void serve_until(Instant give_up, Done&& done);

  std::unique_ptr<dds::Domain> domain_;  // null: no track is a topic
  std::vector<Sender> senders_;          // one per track
  std::vector<std::size_t> streams_;     // indices of the senders that are streams
  transport::StopSignal stop_;
  Duration lead_{};
  Duration half_reading_{};  // half the duration of one clock reading
  Instant read_{};           // the last clock reading
  Instant polled_at_{};      // time of the last poll for signals
  BusyBudget budget_;
  bool stopped_ = false;
  int last_error_ = 0;
};

}  // namespace pitwall::replay
