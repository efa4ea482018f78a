// Reliable, in order, few and small: faults, changes of flags, results. The sender keeps each until
// it is acknowledged and repeats the oldest in every packet that has room; the receiver hands them
// out once and in order.
//   wire   kEvent: number u16, time u24 (tx_time units), kind u8, payload (<= kEventPayload bytes);
//          kEventAck: number of the newest that was taken in order u16
//   invariants
//          handed out exactly once, in order, within one session; a new session goes on where the
//          peer's acknowledgement says. A full queue drops the newest, counts it, and says so in an
//          event of its own when there is room again
//          the oldest that waits goes into every packet; the others when new, and again after
//          kEventRepeat
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/packet/received.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr std::size_t kEventPayload = 48, kEventsKept = 128;
inline constexpr Duration kEventRepeat = milliseconds(100);

enum class EventKind : std::uint8_t {
  kLost,        // payload: how many events were dropped u32
  kFault,       // payload: cause u8, begins 1 / ends 0 u8, value f32
  kModeChange,  // from u8, to u8, cause u8
  kFlagChange,  // which u8 (0 track, 1 vehicle), from u8, to u8
  kArming,      // u8
  kLap,         // number u16, time f32 s
  kRestart,     // of a part: u8
  kText,        // UTF-8
  kThreat       // which u8, begins 1 / ends 0 u8, seen by the base 1 / the car 0 u8, most per s u32
};
inline constexpr std::size_t kEventKinds = 9;

struct Event {
  EventKind kind = EventKind::kText;
  Instant at{};  // sender: own clock. Receiver: mapped to its own clock as well as is known
  FixedVector<std::uint8_t, kEventPayload> payload;
};

// Sender: offered, records written first and again, dropped for want of room, bad or impossible
// acknowledgements. Receiver: handed out, acknowledgements written, records had before, records
// too far ahead to be kept, bad records.
struct EventCounters {
  std::uint64_t events = 0, sent = 0, repeated = 0, dropped = 0, malformed = 0;
};

class EventSender {
 public:
  bool offer(const Event& event);  // false: the queue is full, counted
  std::size_t wanted() const;      // bytes that it would like in the next packet
  void fill(BodyWriter& body, Instant now);
  bool take(const Record& record, const Received& received);  // kEventAck
  void peer_restarted();  // begins again with what was not acknowledged
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
  void confess();
  bool write(BodyWriter& body, std::uint16_t number, Instant now);

  std::array<Kept, kEventsKept> kept_{};
  std::uint16_t first_ = 1, next_ = 1;  // not acknowledged: first_ to next_ - 1
  std::uint32_t lost_ = 0;              // not yet told to the peer
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

  std::array<Event, kEventsKept> held_{};  // a ring that begins at head_ with the event out_
  std::array<bool, kEventsKept> filled_{};
  std::size_t head_ = 0;
  std::uint16_t out_ = 1;       // the next to hand out
  std::uint16_t expected_ = 1;  // the first that did not come; out_ to expected_ - 1 are ready
  bool ack_due_ = false;
  EventCounters counters_;
};

}  // namespace pitwall::telemetry
