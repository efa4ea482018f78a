// IPv4 UDP socket: non-blocking, batched receive with sender and kernel time, every drop counted.
// Loopback unless the caller gives another address.
//   in     addresses, datagrams to send
//   out    datagrams with sender and receive time on the monotonic clock; counters
//   errors bind(), connect(): Problem with the address as place; afterwards counters only
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/udp_address.hpp"

struct sockaddr_in;

namespace pitwall::transport {

inline constexpr std::uint32_t kAnyIp = 0;  // every interface: only by an option

// "127.0.0.1:5000" or "5000" (loopback). Numbers only: a race car has no name service.
Result<UdpAddress, Problem> parse_udp_address(std::string_view text);

inline constexpr std::size_t kMaxDatagramBytes = 2'048;  // longer ones are counted and dropped

struct UdpDatagram {
  UdpAddress from;
  Instant at;  // when the kernel received it
  std::size_t length = 0;
  std::array<std::uint8_t, kMaxDatagramBytes> data;

  std::span<const std::uint8_t> payload() const { return {data.data(), length}; }
};

struct UdpSocketOptions {
  int receive_buffer_bytes = 1 << 20;
  bool reuse_address = false;
  std::uint8_t dscp = 0;  // differentiated services code point of sent datagrams; [0, 63]
  // Offset of the kernel stamps, for sockets whose times are compared, as in CanSocketOptions.
  std::optional<Duration> clock_offset{};
};

struct UdpCounters {
  std::uint64_t received = 0, sent = 0;
  std::uint64_t rx_truncated = 0;      // longer than kMaxDatagramBytes
  std::uint64_t rx_dropped_queue = 0;  // lost in this socket's receive queue
  std::uint64_t rx_failed = 0;
  std::uint64_t rx_refused = 0;  // ICMP: no socket listens at the other end
  std::uint64_t tx_would_block = 0, tx_failed = 0;
};

class UdpSocket {
 public:
  static constexpr std::size_t kBatch = 32;
  static constexpr Duration kMeasurementPeriod = milliseconds(100);  // of the clock offset

  static Result<UdpSocket, Problem> bind(UdpAddress local, const UdpSocketOptions& options = {});
  // Afterwards send() sends to `remote`, and only datagrams from it are received.
  Result<bool, Problem> connect(UdpAddress remote);

  bool send(std::span<const std::uint8_t> bytes);
  bool send_to(UdpAddress to, std::span<const std::uint8_t> bytes);
  // Reads the datagrams that wait, oldest first, at most datagrams.size(). Never blocks.
  std::size_t receive(std::span<UdpDatagram> datagrams);

  UdpAddress local() const { return local_; }
  const UdpCounters& counters() const { return counters_; }
  // Error number of the last send() or send_to() that returned false; 0: no call failed.
  int send_error() const { return send_error_; }
  int fd() const { return fd_.get(); }

 private:
  explicit UdpSocket(FileDescriptor fd) : fd_(std::move(fd)) {}
  bool transmit(const sockaddr_in* to, std::span<const std::uint8_t> bytes);
  bool receive_batch(std::span<UdpDatagram> datagrams, std::size_t& taken,
                     const ArrivalWindow& window);
  Duration clock_offset(Instant now);

  FileDescriptor fd_;
  UdpAddress local_;
  UdpCounters counters_;
  int send_error_ = 0;
  std::optional<Duration> given_offset_;  // from the options
  Duration measured_offset_{};
  Instant next_measurement_{};
  Instant empty_at_{};  // start of the last read that emptied the queue
};

}  // namespace pitwall::transport
