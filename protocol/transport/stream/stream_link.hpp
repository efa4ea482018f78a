// A byte stream that is opened again whenever it ends: a TCP connection to a device, or a serial
// device that may be unplugged.
//   in     where to; now, at every call
//   out    the bytes that are there; counters
//   invariants
//          a stream that ends, is refused, or is not there within kPatience is tried again kPause
//          later. A connection that is silent for kPatience is given up too: a cable that was
//          pulled ends nothing
//   errors of a stream that cannot be opened: the newest reason, and counters
//   cost   never waits and never allocates in the heap while the stream is open; opening a serial
//          device again sets its rate, which some USB adapters take milliseconds for
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>

#include "protocol/transport/posix_call.hpp"
#include "protocol/transport/stream/tcp_connection.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::transport {

struct SerialDevice {
  std::string path;
  int baud = 0;

  bool operator==(const SerialDevice&) const = default;
};

struct StreamCounters {
  std::uint64_t bytes = 0;
  std::uint64_t opened = 0;   // times that the stream came up
  std::uint64_t refused = 0;  // attempts that failed or took too long
  std::uint64_t ended = 0;    // by the other end, or by the line
  std::uint64_t silent = 0;   // given up because nothing came
};

class StreamLink {
 public:
  static constexpr Duration kPatience = seconds(2);
  static constexpr Duration kPause = milliseconds(500);

  using Target = std::variant<TcpAddress, SerialDevice>;

  // Opens nothing yet.
  explicit StreamLink(Target target) : target_(std::move(target)) {}

  // What is there, as much as fits; opens the stream where it is not open.
  std::span<const std::uint8_t> read(std::span<std::uint8_t> into, Instant now);

  bool is_open() const { return state_ == State::kOpen; }
  const StreamCounters& counters() const { return counters_; }

 private:
  enum class State : std::uint8_t { kClosed, kOpening, kOpen };

  void advance(Instant now);
  bool begin(Instant now);
  void close(Instant now, std::uint64_t& counter);

  Target target_;
  FileDescriptor fd_;
  State state_ = State::kClosed;
  Instant since_{};       // that the stream is opening, or that a byte came
  Instant not_before_{};  // the next attempt
  StreamCounters counters_;
};

}  // namespace pitwall::transport
