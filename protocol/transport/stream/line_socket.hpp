// Lines of text over a Unix stream socket, both ends: for occasional messages between programs on
// one machine.
//   in     a path shorter than sun_path; lines without their line end
//   out    whole lines in order, never a part of one
//   invariants
//          no call waits: bytes that the other end does not accept are queued, up to
//          kQueueMax_bytes; if the queue is full, the connection is closed
//          a line longer than kLineMax_bytes is skipped to its end and counted
//          the listener treats its path as unix_listener.hpp has it
//   errors Problem with the path as place; afterwards closed() and counters
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/transport/posix_call.hpp"
#include "protocol/transport/unix_listener.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::transport {

struct LineCounters {
  std::uint64_t received = 0, sent = 0;  // lines
  std::uint64_t too_long = 0;            // skipped
};

class LineSocket {
 public:
  static constexpr std::size_t kLineMax_bytes = 256 * 1024, kQueueMax_bytes = 4 << 20;

  explicit LineSocket(FileDescriptor connection) : connection_(std::move(connection)) {}
  static Result<LineSocket, Problem> connect(const std::string& path);

  // Returns the whole lines that are available now. First it sends queued bytes as far as possible.
  std::vector<std::string> receive();
  void send(std::string_view line);
  void flush();

  // The other end has closed, or was too slow; its earlier lines have been received.
  bool closed() const { return !connection_.valid(); }
  int fd() const { return connection_.get(); }
  bool sending() const { return !queue_.empty(); }
  const LineCounters& counters() const { return counters_; }

 private:
  void take(std::string_view bytes, std::vector<std::string>& lines);

  FileDescriptor connection_;
  std::string part_, queue_;  // start of an incomplete line; bytes to send
  bool skipping_ = false;     // skips the rest of a line that is too long
  LineCounters counters_;
};

class LineListener {
 public:
  static Result<LineListener, Problem> open(const std::string& path);

  std::optional<LineSocket> accept();
  int fd() const { return listener_.fd(); }

 private:
  explicit LineListener(UnixListener listener) : listener_(std::move(listener)) {}

  UnixListener listener_;
};

}  // namespace pitwall::transport
