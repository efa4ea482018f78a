// Reliable, ordered delivery of few and small events: faults, changes of flags, results. The sender
// keeps each event until it is acknowledged and repeats the oldest one in every packet that has
// room; the receiver delivers each once and in order.
//   wire   kEvent: number u16, time u24 (tx_time units), kind u8, payload (<= kEventPayload bytes);
//          kEventAck: number of the newest event received in order u16
//   invariants
//          delivered exactly once, in order, within one session; a new session continues from the
//          acknowledgement of the peer. If the queue is full, a new event is dropped and counted;
//          an event of kind kLost reports it when there is room again
//          the oldest waiting event goes into every packet; the others when new, and again after
//          kEventRepeat
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "protocol/telemetry/packet/body.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr std::size_t kEventPayload = 48, kEventsKept = 128;
inline constexpr Duration kEventRepeat = milliseconds(100);

enum class EventKind : std::uint8_t {
  kLost,        // payload: number of dropped events u32
  kFault,       // payload: cause u8, begins 1 / ends 0 u8, value f32
  kModeChange,  // from u8, to u8, cause u8
  kFlagChange,  // which u8 (0 track, 1 vehicle), from u8, to u8
  kArming,      // u8
  kLap,         // number u16, time f32 s
  kRestart,     // part u8
  kText,        // UTF-8
  kThreat       // which u8, begins 1 / ends 0 u8, seen by base 1 / car 0 u8, highest rate per s u32
};
inline constexpr std::size_t kEventKinds = 9;

struct Event {
  EventKind kind = EventKind::kText;
  Instant at{};  // sender: own clock. Receiver: mapped to its own clock as exactly as known
  FixedVector<std::uint8_t, kEventPayload> payload;
};

// Sender, in order: events offered, records written first and repeated, events dropped because the
// queue was full, malformed or impossible acknowledgements. Receiver: events delivered,
// acknowledgements written, repeated records, records too far ahead to be kept, malformed records.
struct EventCounters {
  std::uint64_t events = 0, sent = 0, repeated = 0, dropped = 0, malformed = 0;
};

class EventSender {
 public:
  bool offer(const Event& event);  // false: the queue is full, counted
  std::size_t wanted() const;      // bytes wanted in the next packet
  void fill(BodyWriter& body, Instant now);
  bool take(const Record& record, const Received& received);  // kEventAck
  void peer_restarted();  // sends all unacknowledged events again
  std::size_t waiting() const;
  const EventCounters& counters() const { return counters_; }

 private:
  struct Kept {
    Event event;
    std::optional<Instant> sent_at;
  };

  Kept& at(std::uint16_t number) { return kept_[number % kEventsKept]; }
  const Kept& at(std::uint16_t number) const { return kept_[number % kEventsKept]; }
  void keep(const Event& event);
  void report_lost();
  bool write(BodyWriter& body, std::uint16_t number, Instant now);

  std::array<Kept, kEventsKept> kept_{};
  std::uint16_t first_ = 1, next_ = 1;  // not acknowledged: first_ to next_ - 1
  std::uint32_t lost_ = 0;              // dropped, not yet reported to the peer
  Instant lost_at_{};
  EventCounters counters_;
};

class EventReceiver {
 public:
  bool take(const Record& record, const Received& received);  // kEvent
  std::optional<Event> next();
  std::size_t wanted() const;
  void fill(BodyWriter& body, Instant now);  // kEventAck
  void peer_restarted();
  const EventCounters& counters() const { return counters_; }

 private:
  std::size_t slot_of(std::uint16_t number) const;

  std::array<Event, kEventsKept> events_{};  // ring; event number next_ is at head_
  std::array<bool, kEventsKept> filled_{};
  std::size_t head_ = 0;
  std::uint16_t next_ = 1;      // next event to deliver
  std::uint16_t expected_ = 1;  // first event not received; next_ to expected_ - 1 are ready
  bool ack_due_ = false;
  EventCounters counters_;
};

}  // namespace pitwall::telemetry
