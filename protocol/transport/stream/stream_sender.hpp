// Outgoing byte stream as a device offers it: a TCP port, whose caller gets the bytes, or a serial
// device. The other end of StreamLink.
//   in     records, each sent whole or not at all
//   out    bytes; counters
//   invariants
//          nothing waits: what the other end does not take at once is queued, at most
//          kMaxQueued_bytes, and a record that does not fit is dropped and counted
//          one caller at a time; the next one is taken when it has gone (or has closed its sending
//          side), and begins with a whole record. What a caller sends, commands to a device, is
//          read, counted and ignored
//   errors listen(), open(): Problem with the address or the path; afterwards counters
//   cost   one system call per record while nothing is queued; allocates when it is opened
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "protocol/transport/posix_call.hpp"
#include "protocol/transport/stream/stream_link.hpp"
#include "protocol/transport/stream/tcp_connection.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::transport {

struct StreamSenderCounters {
  std::uint64_t opened = 0;          // callers that were taken; a serial device: once
  std::uint64_t ended = 0;           // of these, those that have gone or were hung up on
  std::uint64_t sent_bytes = 0;      // that the kernel took
  std::uint64_t dropped_absent = 0;  // records while nobody was connected
  std::uint64_t dropped_full = 0;    // records while the other end did not read
  std::uint64_t lost_bytes = 0;      // queued for a caller that has gone
  std::uint64_t ignored_bytes = 0;   // that the other end sent
};

class StreamSender {
 public:
  // Also what the kernel is asked to hold of a TCP connection: a device has no more either.
  static constexpr std::size_t kMaxQueued_bytes = 65'536;

  static Result<StreamSender, Problem> listen(TcpAddress local);
  static Result<StreamSender, Problem> open(const SerialDevice& device);

  // False: dropped whole, and counted.
  bool send(std::span<const std::uint8_t> record);
  // Takes the next caller, reads what came, and gives queued bytes to the kernel.
  void service();
  // Hangs up; what is queued is lost.
  void close();

  bool is_open() const { return peer_.valid(); }
  std::size_t queued_bytes() const { return queue_.size(); }
  const StreamSenderCounters& counters() const { return counters_; }
  // Readable where service() has something to do, but for queued bytes; negative: never.
  int fd() const { return peer_.valid() ? peer_.get() : listener_.get(); }
  TcpAddress local() const { return local_; }

 private:
  StreamSender() = default;
  void take_caller();
  void read_input();
  void flush();
  std::size_t write_some(std::span<const std::uint8_t> bytes);

  FileDescriptor listener_, peer_;  // a serial device has no listener
  TcpAddress local_;
  std::vector<std::uint8_t> queue_;
  StreamSenderCounters counters_;
};

}  // namespace pitwall::transport
