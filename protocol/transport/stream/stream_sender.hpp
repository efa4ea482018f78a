// Outgoing byte stream of a simulated device: a TCP port that sends to its client, or a serial
// device. The counterpart of StreamLink.
//   in     records, each sent whole or not at all
//   out    bytes; counters
//   invariants
//          no call waits: bytes that the other end does not accept at once are queued, at most
//          kMaxQueued_bytes; a record that does not fit is dropped and counted
//          one client at a time; the next one is accepted when it has left (or has closed its
//          sending side), and starts with a whole record. Bytes that a client sends (commands to
//          the device) are read, counted and ignored
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
  std::uint64_t opened = 0;          // clients accepted; for a serial device 1
  std::uint64_t ended = 0;           // connections closed by either end
  std::uint64_t sent_bytes = 0;      // accepted by the kernel
  std::uint64_t dropped_absent = 0;  // records while no client was connected
  std::uint64_t dropped_full = 0;    // records while the other end did not read
  std::uint64_t lost_bytes = 0;      // queued bytes of closed connections
  std::uint64_t ignored_bytes = 0;   // bytes that the other end sent
};

class StreamSender {
 public:
  // Also the requested send buffer of a TCP connection: a device has no larger one.
  static constexpr std::size_t kMaxQueued_bytes = 65'536;

  static Result<StreamSender, Problem> listen(TcpAddress local);
  static Result<StreamSender, Problem> open(const SerialDevice& device);

  // False: dropped whole, and counted.
  bool send(std::span<const std::uint8_t> record);
  // Accepts the next client, reads its bytes, and writes queued bytes to the kernel.
  void service();
  // Closes the connection; queued bytes are lost.
  void close();

  bool is_open() const { return peer_.valid(); }
  std::size_t queued_bytes() const { return queue_.size(); }
  const StreamSenderCounters& counters() const { return counters_; }
  // Readable if service() has work other than queued bytes; negative: never readable.
  int fd() const { return peer_.valid() ? peer_.get() : listener_.get(); }
  TcpAddress local() const { return local_; }

 private:
  StreamSender() = default;
  void accept_client();
  void read_input();
  void flush();
  std::size_t write_some(std::span<const std::uint8_t> bytes);

  FileDescriptor listener_, peer_;  // a serial device has no listener
  TcpAddress local_;
  std::vector<std::uint8_t> queue_;
  StreamSenderCounters counters_;
};

}  // namespace pitwall::transport
