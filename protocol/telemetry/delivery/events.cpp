// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/delivery/events.hpp"

#include <algorithm>

#include "protocol/vocabulary/bytes.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

namespace {

constexpr std::size_t kNumberSize = 2, kTimeSize = 3;
constexpr std::size_t kTimeAt = kNumberSize, kKindAt = kTimeAt + kTimeSize;
constexpr std::size_t kEventFixed = kKindAt + 1, kAckPayload = kNumberSize;
constexpr Duration kTick = microseconds(100);
constexpr std::uint32_t kTimeMask = 0xFF'FFFF;
static_assert(65'536 % kEventsKept == 0);
// So many ask for room at once; a storm of events leaves the state its place.
constexpr std::size_t kEventsAtOnce = 4;

// How far `to` is after `from`; the numbers wrap.
constexpr std::uint16_t steps(std::uint16_t from, std::uint16_t to) {
  return static_cast<std::uint16_t>(to - from);
}
constexpr std::uint16_t plus(std::uint16_t number, int more) {
  return static_cast<std::uint16_t>(number + more);
}

// The tx_time of its sender at that moment. What is older than the clock can tell, or in the
// future, is told as the oldest, or as now.
std::uint32_t time_code(Instant at, Instant now) {
  const std::int64_t ticks_ago = std::clamp<std::int64_t>((now - at) / kTick, 0, kTimeMask);
  return static_cast<std::uint32_t>(now.ns / kTick.ns - ticks_ago) & kTimeMask;
}

}  // namespace

bool EventSender::offer(const Event& event) {
  report_lost();
  if (waiting() == kEventsKept) {
    ++counters_.dropped;
    ++lost_;
    lost_at_ = event.at;
    return false;
  }
  keep(event);
  return true;
}

void EventSender::keep(const Event& event) {
  at(next_) = {event, std::nullopt};
  next_ = plus(next_, 1);
  ++counters_.events;
}

// An event of its own for those that were dropped, as soon as there is room for it.
void EventSender::report_lost() {
  if (lost_ == 0 || waiting() == kEventsKept) return;
  Event event{.kind = EventKind::kLost, .at = lost_at_, .payload = {}};
  for (unsigned shift = 0; shift < 32; shift += 8) {
    CHECK(event.payload.push(static_cast<std::uint8_t>(lost_ >> shift)));
  }
  lost_ = 0;
  keep(event);
}

std::size_t EventSender::waiting() const { return steps(first_, next_); }

std::size_t EventSender::wanted() const {
  std::size_t bytes = 0, count = 0;
  for (std::uint16_t n = first_; n != next_ && count < kEventsAtOnce; n = plus(n, 1)) {
    if (n != first_ && at(n).sent_at) continue;
    ++count;
    bytes += BodyWriter::record_size(kEventFixed + at(n).event.payload.size());
  }
  return bytes;
}

void EventSender::fill(BodyWriter& body, Instant now) {
  for (std::uint16_t n = first_; n != next_; n = plus(n, 1)) {
    const auto& sent_at = at(n).sent_at;
    if (n != first_ && sent_at && now - *sent_at < kEventRepeat) continue;
    if (!write(body, n, now)) return;
  }
}

bool EventSender::write(BodyWriter& body, std::uint16_t number, Instant now) {
  Kept& kept = at(number);
  const auto payload = kept.event.payload.span();
  std::array<std::uint8_t, kEventFixed + kEventPayload> record{};
  store<std::uint16_t>(record, 0, number);
  store(std::span(record).subspan(kTimeAt, kTimeSize), time_code(kept.event.at, now));
  record[kKindAt] = static_cast<std::uint8_t>(kept.event.kind);
  std::copy(payload.begin(), payload.end(), record.begin() + kEventFixed);
  const auto bytes = std::span<const std::uint8_t>(record).first(kEventFixed + payload.size());
  if (!body.add_record(RecordType::kEvent, bytes)) return false;
  ++(kept.sent_at ? counters_.repeated : counters_.sent);
  kept.sent_at = now;
  return true;
}

bool EventSender::take(const Record& record, const Received& /*received*/) {
  CHECK(record.type == RecordType::kEventAck);
  if (record.payload.size() != kAckPayload) {
    ++counters_.malformed;
    return false;
  }
  const auto newest = load<std::uint16_t>(record.payload, 0);
  const std::uint16_t known = plus(first_, -1);
  if (steps(known, newest) <= waiting()) {
    first_ = plus(newest, 1);
    report_lost();
    return true;
  }
  // An older acknowledgement that was overtaken is no fault; one of what was never sent is.
  if (steps(newest, known) <= 2 * kEventsKept) return true;
  ++counters_.malformed;
  return false;
}

void EventSender::peer_restarted() {
  const auto count = static_cast<std::uint16_t>(waiting());
  // The new receiver waits for number 1.
  std::rotate(kept_.begin(), kept_.begin() + first_ % kEventsKept, kept_.end());
  std::rotate(kept_.begin(), kept_.end() - 1, kept_.end());
  first_ = 1;
  next_ = plus(first_, count);
  for (Kept& kept : kept_) kept.sent_at.reset();
}

std::size_t EventReceiver::slot_of(std::uint16_t number) const {
  return (head_ + steps(next_, number)) % kEventsKept;
}

bool EventReceiver::take(const Record& record, const Received& received) {
  CHECK(record.type == RecordType::kEvent);
  const auto bytes = record.payload;
  if (bytes.size() < kEventFixed || bytes.size() > kEventFixed + kEventPayload ||
      bytes[kKindAt] >= kEventKinds) {
    ++counters_.malformed;
    return false;
  }
  ack_due_ = true;
  const auto number = load<std::uint16_t>(bytes, 0);
  if (steps(next_, number) >= kEventsKept) {
    const bool behind = steps(number, next_) <= 2 * kEventsKept;
    ++(behind ? counters_.repeated : counters_.dropped);
    return true;
  }
  const std::size_t slot = slot_of(number);
  if (filled_[slot]) {
    ++counters_.repeated;
    return true;
  }
  const auto time = static_cast<std::uint32_t>(load(bytes.subspan(kTimeAt, kTimeSize)));
  const std::uint32_t ticks_ago = (received.tx_time_100us - time) & kTimeMask;
  Event& event = events_[slot];
  event.kind = static_cast<EventKind>(bytes[kKindAt]);
  event.at = received.sent_earliest.value_or(received.at) - kTick * ticks_ago;
  event.payload.clear();
  for (const std::uint8_t byte : bytes.subspan(kEventFixed)) CHECK(event.payload.push(byte));
  filled_[slot] = true;
  while (steps(next_, expected_) < kEventsKept && filled_[slot_of(expected_)]) {
    expected_ = plus(expected_, 1);
  }
  return true;
}

std::optional<Event> EventReceiver::next() {
  if (next_ == expected_) return std::nullopt;
  filled_[head_] = false;
  const Event& event = events_[head_];
  head_ = (head_ + 1) % kEventsKept;
  next_ = plus(next_, 1);
  ++counters_.events;
  return event;
}

std::size_t EventReceiver::wanted() const {
  return ack_due_ ? BodyWriter::record_size(kAckPayload) : 0;
}

void EventReceiver::fill(BodyWriter& body, Instant /*now*/) {
  if (!ack_due_) return;
  std::array<std::uint8_t, kAckPayload> payload{};
  store<std::uint16_t>(payload, 0, plus(expected_, -1));
  if (!body.add_record(RecordType::kEventAck, payload)) return;
  ack_due_ = false;
  ++counters_.sent;
}

void EventReceiver::peer_restarted() {
  const std::uint16_t ready = steps(next_, expected_);
  for (std::size_t i = ready; i < kEventsKept; ++i) filled_[(head_ + i) % kEventsKept] = false;
  // What is ready is still handed out; the new sender begins with number 1.
  expected_ = 1;
  next_ = plus(expected_, -ready);
  ack_due_ = false;
}

}  // namespace pitwall::telemetry
