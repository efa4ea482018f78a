// Reliable, in order, few and small: faults, changes of flags, results. The sender keeps each until
// it is acknowledged and repeats the oldest in every packet that has room; the receiver hands them
// out once and in order.
//   wire   kEvent: number u16, time u24 (tx_time units), kind u8, payload (<= kEventPayload bytes);
//          kEventAck: number of the newest that was taken in order u16
//   law    handed out exactly once, in order, within one session; a new session goes on where the
//          peer's acknowledgement says. A full queue drops the newest, counts it, and says so in an
//          event of its own when there is room again
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

enum class EventKind : std::uint8_t {
  kLost,        // payload: how many events were dropped u32
  kFault,       // payload: cause u8, begins 1 / ends 0 u8, value f32
  kModeChange,  // from u8, to u8, cause u8
  kFlagChange,  // which u8 (0 track, 1 vehicle), from u8, to u8
  kArming,      // u8
  kLap,         // number u16, time f32 s
  kRestart,     // of a part: u8
  kText         // UTF-8
};
inline constexpr std::size_t kEventKinds = 8;

struct Event {
  EventKind kind = EventKind::kText;
  Instant at{};  // sender: own clock. Receiver: mapped to its own clock as well as is known
  FixedVector<std::uint8_t, kEventPayload> payload;
};

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
  std::array<Event, kEventsKept> kept_{};
  std::uint16_t first_ = 1, next_ = 1;
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
  std::array<Event, kEventsKept> held_{};
  std::uint16_t expected_ = 1;
  EventCounters counters_;
};

}  // namespace pitwall::telemetry
