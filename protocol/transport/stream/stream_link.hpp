// Reconnecting byte stream: a TCP connection to a device, or a serial device that may be unplugged.
//   in     the target; the time at every call
//   out    the available bytes; counters
//   invariants
//          a stream that ends, is refused, or does not open within kTimeout is tried again after
//          kPause. A TCP connection without bytes for kTimeout is closed too, because a pulled
//          cable does not end a connection
//   errors counters only
//   cost   never waits, and never allocates on the heap while the stream is open; opening a serial
//          device sets its rate, which takes milliseconds on some USB adapters
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>

#include "protocol/transport/posix_call.hpp"
#include "protocol/transport/stream/serial_port.hpp"
#include "protocol/transport/stream/tcp_connection.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::transport {

struct StreamCounters {
  std::uint64_t bytes = 0;
  std::uint64_t opened = 0;   // times that the stream opened
  std::uint64_t refused = 0;  // attempts that failed or took too long
  std::uint64_t ended = 0;    // closed by the other end or by the line
  std::uint64_t silent = 0;   // closed because no byte came
};

class StreamLink {
 public:
  static constexpr Duration kTimeout = seconds(2);
  static constexpr Duration kPause = milliseconds(500);

  using Target = std::variant<TcpAddress, SerialDevice>;

  // Does not open the stream; read() does.
  explicit StreamLink(Target target) : target_(std::move(target)) {}

  // Reads the available bytes, as many as fit; opens the stream if it is not open.
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
  Instant since_{};       // start of the opening, or time of the last byte
  Instant not_before_{};  // earliest next attempt
  StreamCounters counters_;
};

}  // namespace pitwall::transport
