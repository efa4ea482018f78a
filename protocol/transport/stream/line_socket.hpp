// Lines of text over a Unix stream socket, both ends: for programs of one machine that tell each
// other something now and then.
//   in     a path shorter than sun_path; lines without their end
//   out    whole lines in their order, never part of one
//   invariants
//          nobody waits: what the other end does not take is queued, up to kQueueMax_bytes; who
//          reads slower than that is hung up on
//          a line longer than kLineMax_bytes is skipped to its end, and counted
//   listener  the path is its owner's only (0600); a socket that nobody serves is replaced,
//          one that is served, and whatever is no socket, is refused and left alone
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

  // What is there now; what waits to be sent is sent first, as far as it goes.
  std::vector<std::string> receive();
  void send(std::string_view line);
  void flush();

  // The other end is gone, or was too slow; what it said before that has been received.
  bool closed() const { return !connection_.valid(); }
  int fd() const { return connection_.get(); }
  bool sending() const { return !queue_.empty(); }
  const LineCounters& counters() const { return counters_; }

 private:
  void take(std::string_view bytes, std::vector<std::string>& lines);

  FileDescriptor connection_;
  std::string part_, queue_;  // of a line that has not ended yet; what waits to be sent
  bool skipping_ = false;     // the rest of a line that is too long
  LineCounters counters_;
};

class LineListener {
 public:
  static Result<LineListener, Problem> open(const std::string& path);
  LineListener(LineListener&& other) noexcept;
  LineListener& operator=(LineListener&&) = delete;
  ~LineListener();

  std::optional<LineSocket> accept();
  int fd() const { return listener_.get(); }

 private:
  LineListener(std::string path, FileDescriptor listener)
      : path_(std::move(path)), listener_(std::move(listener)) {}

  std::string path_;
  FileDescriptor listener_;
};

}  // namespace pitwall::transport
