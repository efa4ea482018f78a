// CAN_RAW socket of the kernel: batched, non-blocking, with receive times and with every lost frame
// counted. It serves the bus `unix:PATH` (unix_bus, unix_can_hub) too, for kernels without CAN,
// where
//   - the time of a frame is when the hub put it into this socket's queue
//   - the queue and its size are the hub's. The hub reports losses at their place among the frames;
//     losses after the last frame are reported once the queue has room
//   - there is no controller: error frames come only from other clients, and there is no bus state
//   - send() returns "would block" after about 277 frames while the hub does not read
//   - when the hub ends, hung_up() is true and counted, and send() says "network down" until
//     receive() or poll_drops(), which look every 100 ms, find a new hub at PATH
//   in     an interface name (can0, vcan0, unix:/run/bus), frames to send
//   out    frames with the kernel's receive time on the monotonic clock; counters; bus state
//   units  Instant (CLOCK_MONOTONIC nanoseconds), bytes
//   errors open(): Problem with the interface as place. Afterwards nothing throws or exits: each
//          refusal is a return value and a counter
//   source Linux Documentation/networking/can.rst
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/can/frame.hpp"
#include "protocol/transport/can/can_wire.hpp"
#include "protocol/transport/can/unix_bus.hpp"
#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::transport {

// A frame passes if (its id & mask) == (id & mask) and it is a data frame of the same kind
// (standard or extended): the kernel mask always includes CAN_EFF_FLAG and CAN_RTR_FLAG.
struct CanFilter {
  std::uint32_t id = 0;
  std::uint32_t mask = can::kMaxExtendedId;
  bool extended = false;
};

struct CanSocketOptions {
  std::vector<CanFilter> filters{};    // empty: every frame, remote frames too
  bool receive_own = false;            // receive the frames that this socket sends
  bool receive_errors = true;          // error frames: counted and decoded, never delivered as data
  bool fd = true;                      // accept CAN FD frames
  int receive_buffer_bytes = 8 << 20;  // 21,846 classic frames at 384 B (kernel doubles the value)
  // realtime_minus_monotonic() for all stamps; empty: measured every 100 ms. With the same value
  // for several sockets their times have the order of the kernel's stamps. If the calendar clock is
  // stepped meanwhile, the times are those of the read.
  std::optional<Duration> clock_offset{};
};

struct CanSocketCounters {
  std::uint64_t received = 0;        // data frames given to the caller
  std::uint64_t sent = 0;            // frames that the kernel accepted
  std::uint64_t tx_enobufs = 0;      // send() stopped because the interface queue was full
  std::uint64_t tx_would_block = 0;  // send() stopped because the socket's send buffer was full
  std::uint64_t tx_network_down = 0;
  std::uint64_t tx_failed = 0;   // any other error
  std::uint64_t tx_refused = 0;  // frames no bus can carry: dropped, not sent
  // Frames lost in this socket's receive queue, by two detectors: with each frame the kernel
  // reports the number lost before it (SO_RXQ_OVFL); on request, the number lost so far, trailing
  // losses included (SO_MEMINFO). rx_dropped_queue is the larger one.
  std::uint64_t rx_dropped_by_frames = 0;
  std::uint64_t rx_dropped_when_asked = 0;
  std::uint64_t rx_dropped_queue = 0;
  std::uint64_t rx_malformed = 0;  // truncated, or not a CAN frame
  std::uint64_t rx_failed = 0;     // recvmmsg errors except "would block"
  std::uint64_t error_frames = 0;
  std::uint64_t clock_steps =
      0;                    // the calendar clock jumped; stamps of that batch are arrival times
  CanErrorCounters errors;  // error_frames by class
  // For a unix bus: number of times that its hub ended, and that a new one was found.
  std::uint64_t hub_losses = 0, hub_returns = 0;
};

class CanSocket {
 public:
  // Frames per system call.
  static constexpr std::size_t kBatch = 64;

  static Result<CanSocket, Problem> open(std::string_view interface,
                                         const CanSocketOptions& options = {});

  // Reads the frames that wait, up to frames.size(), oldest first. Returns their number. Never
  // blocks.
  std::size_t receive(std::span<can::ReceivedFrame> frames);

  // Returns the number of leading frames that are sent, or refused and counted. The kernel did not
  // accept the rest (ENOBUFS or the like, counted); the caller may retry or drop them. Never
  // blocks.
  std::size_t send(std::span<const can::Frame> frames);
  bool send(const can::Frame& frame) { return send(std::span(&frame, 1)) == 1; }

  // Writes one error frame, as a controller driver would report it (for benches on vcan).
  bool send_error(std::uint32_t classes, std::span<const std::uint8_t> detail = {});

  // Reads from the kernel the number of frames lost so far and the bytes still to send. receive()
  // does it every 100 ms; call it once more at the end to count trailing losses.
  void poll_drops();
  // Bytes of our frames in the kernel's send queue at the last poll_drops(); about 768 per frame.
  std::uint32_t queued_bytes() const { return queued_bytes_; }

  const CanSocketCounters& counters() const { return counters_; }
  // State in the newest error frame that reports one, and the time of that frame.
  BusState bus_state() const { return bus_state_; }
  Instant bus_state_at() const { return bus_state_at_; }
  // Size granted by the kernel; 0 on a unix bus.
  int receive_buffer_bytes() const { return receive_buffer_bytes_; }
  int fd() const { return unix_ ? unix_->receiver() : fd_.get(); }
  // The bus is a unix bus without a hub: nothing arrives and nothing goes out.
  bool hung_up() const { return unix_ && !unix_->connected(); }

 private:
  CanSocket(FileDescriptor fd, std::optional<Duration> clock_offset)
      : fd_(std::move(fd)), given_offset_(clock_offset) {}
  CanSocket(UnixBusEnd end, std::optional<Duration> clock_offset)
      : unix_(std::move(end)), given_offset_(clock_offset) {}
  static Result<CanSocket, Problem> open_unix(std::string_view interface,
                                              const CanSocketOptions& options);
  int send_fd() const { return unix_ ? unix_->sender() : fd_.get(); }
  void hang_up();
  void look_for_hub();
  void follow_clock(Instant now);
  // Reads one batch: true if the kernel may have more.
  bool receive_batch(std::span<can::ReceivedFrame> frames, std::size_t& taken, Instant now);
  Instant arrival(UtcTime stamp, Instant now);
  // Handles frames that occur only on a unix bus or that SocketCAN would not deliver; true if done.
  bool take_unix(const CanWire& wire, std::size_t bytes);
  void count_dropped(std::uint64_t& detector, std::uint64_t so_far);
  void take_error(const CanWire& wire, Instant at);
  void count_send_error(const PosixOutcome& outcome);

  FileDescriptor fd_;
  std::optional<UnixBusEnd> unix_;
  std::uint64_t dropped_before_ = 0;  // frames that earlier hubs lost
  CanSocketCounters counters_;
  BusState bus_state_ = BusState::kUnknown;
  Instant bus_state_at_{};
  std::uint32_t queued_bytes_ = 0;
  int receive_buffer_bytes_ = 0;
  std::optional<Duration> given_offset_;
  Duration clock_offset_{};
  Instant next_poll_{};
  Instant empty_at_{};  // start of the last read that emptied the queue
  bool stamps_trusted_ = true;
  bool offset_known_ = false;
};

}  // namespace pitwall::transport
