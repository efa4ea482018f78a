// One CAN bus in memory, in virtual time: bit-exact frame lengths, arbitration, queues, load.
//   in     offer(port, frame, now): a node hands a frame to its controller; `now` does not run
//          backwards (an offer in the past counts as now). Each port has one slot per identifier:
//          a newer frame overwrites the one that still waits.
//   out    advance(now): what every other port received up to `now`, in order of the end of frame;
//          valid until the next call of advance(). Arbitration is decided strictly before `now`,
//          so the order of offers at one instant does not matter (only on equal keys).
//   order  (time, arbitration key, sequence of the offer): total, hence reproducible
//   units  bit/s, Instant of the bench; a frame is received 3 bits before the bus is free again
//   errors full queue or a CAN FD frame -> offer() returns false, counted; nothing is silent
//   cost   O(pending) per frame; no allocation after construction
//   source Bosch CAN 2.0; virtual CAN of the kernel has neither length nor arbitration
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::bus {

inline constexpr std::size_t kMaxPorts = 8;
inline constexpr std::size_t kMaxPending = 64;       // per port: more than the database has ids
inline constexpr std::size_t kMaxDeliveries = 8192;  // per advance(): over a second of full load

struct BusConfig {
  std::uint8_t ports = 2;
  std::int64_t bit_rate = 500'000;  // bit/s
};

struct Delivery {
  std::uint8_t to = 0, from = 0;  // ports
  can::ReceivedFrame received;
};

struct BusCounters {
  std::uint64_t sent = 0;         // frames that made it onto the wire
  std::uint64_t overwritten = 0;  // replaced in their slot by a newer frame of the same identifier
  std::uint64_t lost = 0;         // queue full, port disconnected, or nobody called advance()
  std::uint64_t refused = 0;      // not a classic CAN frame
  std::uint64_t bits = 0;         // on the wire, interframe space included
};

class MemoryBus {
 public:
  explicit MemoryBus(const BusConfig& config);

  bool offer(std::uint8_t port, const can::Frame& frame, Instant now);
  std::span<const Delivery> advance(Instant now);

  // A cut wire: a disconnected port neither sends nor hears; what waits in its queue is lost.
  void connect(std::uint8_t port, bool connected);

  const BusCounters& counters() const { return counters_; }
  std::uint64_t sent_by(std::uint8_t port) const;
  std::size_t pending(std::uint8_t port) const;
  // Share of the last full second (up to the last advance or offer) in which the bus was busy.
  double load() const;

 private:
  struct Pending {
    can::Frame frame;
    Instant since;
    std::uint32_t key = 0;
    std::uint64_t sequence = 0;
  };
  struct Port {
    std::array<Pending, kMaxPending> queue{};
    std::size_t waiting = 0;  // entries of the queue in use

    std::span<const Pending> waiting_frames() const { return {queue.data(), waiting}; }
    std::uint64_t sent = 0;
    bool connected = true;
  };
  struct Candidate {
    bool found = false;
    std::uint8_t port = 0;
    std::size_t slot = 0;
    Instant start{};
  };

  void simulate_until(Instant now);
  Candidate next_candidate() const;
  void transmit(const Candidate& winner);
  void complete();
  void account_busy(Instant from, Instant until);
  void roll_load_window(Instant now);

  static constexpr std::size_t kLoadBuckets = 11;  // the newest is not full yet
  static constexpr Duration kLoadBucket = milliseconds(100);

  BusConfig config_;
  std::array<Port, kMaxPorts> ports_{};
  std::vector<Delivery> deliveries_, handed_out_;
  BusCounters counters_;
  std::uint64_t sequence_ = 0;
  Instant now_{}, free_at_{};
  bool on_wire_ = false;  // a frame has begun whose end has not been delivered yet
  std::uint8_t sender_ = 0;
  can::ReceivedFrame wire_{};
  std::array<std::int64_t, kLoadBuckets> busy_ns_{};
  std::int64_t bucket_ = 0;  // index of the newest bucket
};

}  // namespace pitwall::bus
