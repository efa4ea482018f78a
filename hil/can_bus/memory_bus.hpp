// CAN bus in memory, in virtual time: bit-exact frame lengths, arbitration, queues, load, and bus
// faults: bit errors with error frames and retransmission, nodes in the states warning,
// error-passive and bus-off, a babbling node, a stalled controller.
//   in     offer(port, frame, now): a node passes a frame to its controller; `now` never decreases
//          (an earlier time counts as the present one). Each port has one slot per identifier: a
//          newer frame overwrites the one that still waits
//   out    advance(now): the frames that every other port received up to `now`, in order of the end
//          of frame; valid until the next call of advance(). Arbitration is decided strictly before
//          `now`, so the order of offers at one instant does not matter (except for equal keys)
//   order  (time, arbitration key, sequence of the offer): total, hence reproducible
//   faults all off by default. A destroyed frame takes the bits up to the error, an error frame of
//          20 bits (flag 6, echo 6, delimiter 8) and the interframe space; it is sent again unless
//          its slot has a newer frame by then. An error-passive node waits 8 bits after each
//          attempt. Bus-off empties the queue and refuses offers until restart() and 128 runs of 11
//          recessive bits
//   units  bit/s, Instant of the bench; a frame is received 3 bits before the bus is free again
//   errors offer() returns false for a full queue or a CAN FD frame, and counts it; every loss is
//          counted
//   cost   O(pending) per frame; no allocation after construction
//   source Bosch CAN 2.0; the kernel's virtual CAN models neither frame length nor arbitration
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hil/can_bus/fault_confinement.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/random.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::can_bus {

inline constexpr std::size_t kMaxPorts = 8;
// per port: more than the identifiers of the database
inline constexpr std::size_t kMaxPending = 64;
// per advance(): more than one second of full load
inline constexpr std::size_t kMaxDeliveries = 8192;

struct BusConfig {
  std::uint8_t ports = 2;
  std::int64_t bit_rate = 500'000;  // bit/s
  std::uint64_t seed = 1;           // of the random bus errors
};

inline constexpr std::uint32_t kErrorFrameBits = 20;
inline constexpr std::uint32_t kSuspendBits = 8;  // wait of an error-passive node after it has sent

struct Delivery {
  std::uint8_t to = 0, from = 0;  // ports
  can::ReceivedFrame received;
};

struct BusCounters {
  std::uint64_t sent = 0;          // frames sent completely
  std::uint64_t overwritten = 0;   // replaced in their slot by a newer frame of the same identifier
  std::uint64_t lost = 0;          // queue full, port disconnected, or kMaxDeliveries exceeded
  std::uint64_t refused = 0;       // not a classic CAN frame
  std::uint64_t bits = 0;          // on the bus, interframe space included
  std::uint64_t error_frames = 0;  // each one counted once for the whole bus
};

// State of one node.
struct PortStatus {
  ErrorState state = ErrorState::kActive;
  std::uint16_t send_errors = 0, receive_errors = 0;
  std::uint64_t dropped = 0;   // overwritten, refused in bus-off, or discarded before sending
  std::uint64_t restarts = 0;  // from bus-off
  Duration blocked{};          // time without a sent frame while a frame waits
};

class MemoryBus {
 public:
  explicit MemoryBus(const BusConfig& config);

  bool offer(std::uint8_t port, const can::Frame& frame, Instant now);
  std::span<const Delivery> advance(Instant now);

  // Connects or disconnects a port, like a cut wire: a disconnected port neither sends nor
  // receives, and its waiting frames are lost.
  void connect(std::uint8_t port, bool connected);

  // Each bit on the bus is corrupted with this probability, for all nodes.
  void disturb(double bit_error);
  // This share of the frames of the port is destroyed, each at a random bit.
  void damage_transmitter(std::uint8_t port, double share);
  // The controller accepts frames and sends none.
  void stall(std::uint8_t port, bool stalled);
  // The node repeats this frame so that it fills `share` of the bus; 0 ends it.
  void babble(std::uint8_t port, const can::Frame& frame, double share, Instant now);
  // Starts the recovery from bus-off. Returns false unless the port is bus-off and not yet
  // recovering.
  bool restart(std::uint8_t port, Instant now);

  PortStatus status(std::uint8_t port) const;  // at the last advance() or offer()
  const BusCounters& counters() const { return counters_; }
  std::uint64_t sent_by(std::uint8_t port) const;
  std::size_t pending(std::uint8_t port) const;
  // Bus load: busy share of the last full second, up to the last advance() or offer().
  double load() const;

 private:
  struct Pending {
    can::Frame frame;
    Instant since;
    std::uint32_t key = 0;
    std::uint64_t sequence = 0;
  };
  struct Babble {
    can::Frame frame;
    double share = 1.0;
    Instant next{};
  };
  struct Port {
    std::array<Pending, kMaxPending> queue{};
    std::size_t waiting = 0;  // entries of the queue in use
    std::uint64_t sent = 0, dropped = 0, restarts = 0;
    bool connected = true, stalled = false;
    double send_failure = 0.0;
    FaultConfinement confinement;
    Instant suspended_until{};
    std::optional<Instant> blocked_since;
    std::optional<Babble> babble;

    std::span<const Pending> waiting_frames() const { return {queue.data(), waiting}; }
    bool may_send() const { return connected && !stalled && !confinement.bus_off; }
  };
  struct Candidate {
    bool found = false;
    std::uint8_t port = 0;
    Pending frame;
    std::size_t slot = 0;  // kMaxPending: frame of a babbling node, in no slot
    Instant start{};
  };

  void simulate_until(Instant now);
  template <class Visit>
  void each_contender(Visit visit) const;
  Candidate next_candidate() const;
  void transmit(const Candidate& winner);
  std::optional<std::uint32_t> error_bit(const Port& sender, std::uint32_t bits);
  void complete();
  void destroyed();
  void send_again();
  void go_bus_off(Port& node);
  void deliver();
  void count_idle_bits(Instant until);
  void let_frame_end();
  Duration span_of(std::uint32_t bits) const;
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
  bool on_wire_ = false;  // a frame has begun, and its end is not delivered yet
  bool is_destroyed_ = false;
  std::uint8_t sender_ = 0;
  Pending wire_;
  bool is_babble_ = false;
  Instant wire_ends_{};
  Instant idle_from_{};  // recovering nodes have counted the idle bits before it
  double bit_error_ = 0.0;
  Random random_;
  std::array<std::int64_t, kLoadBuckets> busy_ns_{};
  std::int64_t bucket_ = 0;  // index of the newest bucket
};

}  // namespace pitwall::can_bus
