// Datagrams over a tty in raw mode or over one end of a stream socket pair: the link from a guest
// to its host. Framing in line_framing.
//   in     a tty path or an open descriptor; datagrams to send
//   out    datagrams received; counters
//   errors open(): Problem with the path as place; afterwards counters only. Never blocks
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "protocol/transport/posix_call.hpp"
#include "protocol/transport/stream/line_framing.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::transport {

struct SerialCounters {
  std::uint64_t sent = 0;
  std::uint64_t tx_refused = 0;   // longer than kMaxLineDatagramBytes
  std::uint64_t tx_overflow = 0;  // dropped whole because the line was too slow
  std::uint64_t tx_failed = 0, rx_failed = 0;
  LineDecoderCounters received;
};

class SerialLine {
 public:
  // Bytes that may wait for a slow line; 64 KiB is about 400 radio datagrams.
  static constexpr std::size_t kMaxQueuedBytes = 65'536;

  static Result<SerialLine, Problem> open(const std::string& tty_path);
  static Result<SerialLine, Problem> adopt(FileDescriptor fd);  // sets raw mode if it is a tty

  // True: it is sent whole, now or at a later flush(). False: dropped whole and counted.
  bool send(std::span<const std::uint8_t> datagram);
  // Writes queued bytes as far as the line accepts them.
  void flush();
  bool has_unsent() const { return queue_begin_ != queue_end_; }
  // The next datagram, or an empty optional. Valid until the next call.
  std::optional<std::span<const std::uint8_t>> receive();
  bool closed() const { return closed_; }  // the other end has closed

  SerialCounters counters() const;
  int fd() const { return fd_.get(); }

 private:
  explicit SerialLine(FileDescriptor fd) : fd_(std::move(fd)) {}
  bool queue(std::span<const std::uint8_t> bytes);

  FileDescriptor fd_;
  LineDecoder decoder_;
  SerialCounters counters_;
  std::vector<std::uint8_t> queue_ = std::vector<std::uint8_t>(kMaxQueuedBytes);
  std::size_t queue_begin_ = 0, queue_end_ = 0;
  bool closed_ = false;
};

// Two connected ends of a byte stream; both are closed by an exec unless they are mapped.
Result<std::pair<FileDescriptor, FileDescriptor>, Problem> stream_pair();

}  // namespace pitwall::transport
