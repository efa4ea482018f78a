// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/memory_bus.hpp"

#include <algorithm>
#include <cmath>

#include "hil/can_bus/frame_length.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::can_bus {

MemoryBus::MemoryBus(const BusConfig& config) : config_(config), random_{config.seed} {
  CHECK(config.ports >= 1 && config.ports <= kMaxPorts);
  CHECK(config.bit_rate > 0);
  deliveries_.reserve(kMaxDeliveries);
  handed_out_.reserve(kMaxDeliveries);
}

bool MemoryBus::offer(std::uint8_t port, const can::Frame& frame, Instant now) {
  CHECK(port < config_.ports);
  simulate_until(now);
  if (frame.fd || frame.length > 8) {
    ++counters_.refused;
    return false;
  }
  Port& node = ports_[port];
  if (!node.connected) {
    ++counters_.lost;
    return false;
  }
  if (!node.blocked_since) node.blocked_since = now_;
  if (node.confinement.bus_off) {
    ++node.dropped;
    return false;
  }
  const std::uint32_t key = arbitration_key(frame);
  for (std::size_t i = 0; i < node.waiting; ++i) {
    if (node.queue[i].key != key) continue;
    // Keeps its place: it has been contending since it was first offered.
    node.queue[i].frame = frame;
    ++counters_.overwritten;
    ++node.dropped;
    return true;
  }
  if (node.waiting == kMaxPending) {
    ++counters_.lost;
    return false;
  }
  node.queue[node.waiting++] = {frame, now_, key, sequence_++};
  return true;
}

std::span<const Delivery> MemoryBus::advance(Instant now) {
  simulate_until(now);
  std::swap(deliveries_, handed_out_);
  deliveries_.clear();
  return handed_out_;
}

void MemoryBus::connect(std::uint8_t port, bool connected) {
  CHECK(port < config_.ports);
  Port& node = ports_[port];
  if (!connected) {
    counters_.lost += node.waiting;
    node.waiting = 0;
  }
  node.connected = connected;
}

std::uint64_t MemoryBus::sent_by(std::uint8_t port) const {
  CHECK(port < config_.ports);
  return ports_[port].sent;
}

std::size_t MemoryBus::pending(std::uint8_t port) const {
  CHECK(port < config_.ports);
  return ports_[port].waiting;
}

void MemoryBus::disturb(double bit_error) {
  CHECK(bit_error >= 0.0 && bit_error < 1.0);
  bit_error_ = bit_error;
}

void MemoryBus::damage_transmitter(std::uint8_t port, double share) {
  CHECK(port < config_.ports && share >= 0.0 && share <= 1.0);
  ports_[port].send_failure = share;
}

void MemoryBus::stall(std::uint8_t port, bool stalled) {
  CHECK(port < config_.ports);
  ports_[port].stalled = stalled;
}

void MemoryBus::babble(std::uint8_t port, const can::Frame& frame, double share, Instant now) {
  CHECK(port < config_.ports && share <= 1.0);
  simulate_until(now);
  std::optional<Babble>& babble = ports_[port].babble;
  if (!(share > 0.0)) {
    babble.reset();
  } else if (!babble) {
    babble = {frame, share, now_};
  } else {
    babble->frame = frame;
    babble->share = share;
  }
}

bool MemoryBus::restart(std::uint8_t port, Instant now) {
  CHECK(port < config_.ports);
  simulate_until(now);
  if (!can_bus::restart(ports_[port].confinement)) return false;
  ++ports_[port].restarts;
  return true;
}

PortStatus MemoryBus::status(std::uint8_t port) const {
  CHECK(port < config_.ports);
  const Port& node = ports_[port];
  return {.state = state_of(node.confinement),
          .send_errors = node.confinement.send_errors,
          .receive_errors = node.confinement.receive_errors,
          .dropped = node.dropped,
          .restarts = node.restarts,
          .blocked = node.blocked_since ? now_ - *node.blocked_since : Duration{}};
}

// Begins every frame whose arbitration lies strictly before `now`: others may still be offered at
// it.
void MemoryBus::simulate_until(Instant now) {
  if (now < now_) return;
  while (true) {
    if (on_wire_ && wire_ends_ <= now) complete();
    if (on_wire_) break;
    const Candidate winner = next_candidate();
    if (!winner.found || winner.start >= now) break;
    transmit(winner);
  }
  now_ = now;
  if (!on_wire_) count_idle_bits(now);
  roll_load_window(now);
}

// Everything that waits for the bus, with the earliest instant at which it would begin.
template <class Visit>
void MemoryBus::each_contender(Visit visit) const {
  for (std::uint8_t p = 0; p < config_.ports; ++p) {
    const Port& node = ports_[p];
    if (!node.may_send()) continue;
    const Instant free = std::max(free_at_, node.suspended_until);
    for (std::size_t i = 0; i < node.waiting; ++i)
      visit(p, i, node.queue[i], std::max(node.queue[i].since, free));
    if (node.babble)
      visit(p, kMaxPending,
            Pending{node.babble->frame, node.babble->next, arbitration_key(node.babble->frame), 0},
            std::max(node.babble->next, free));
  }
}

MemoryBus::Candidate MemoryBus::next_candidate() const {
  // The earliest instant at which the bus is free and somebody wants to send.
  Candidate best;
  each_contender([&](std::uint8_t, std::size_t, const Pending&, Instant ready) {
    if (!best.found || ready < best.start) best.start = ready;
    best.found = true;
  });
  bool any = false;
  each_contender([&](std::uint8_t port, std::size_t slot, const Pending& frame, Instant ready) {
    if (ready > best.start) return;
    if (any && (best.frame.key < frame.key ||
                (best.frame.key == frame.key && best.frame.sequence < frame.sequence)))
      return;
    any = true;
    best.port = port;
    best.slot = slot;
    best.frame = frame;
  });
  return best;
}

Duration MemoryBus::span_of(std::uint32_t bits) const {
  return nanoseconds(static_cast<std::int64_t>(bits) * kNanosecondsPerSecond / config_.bit_rate);
}

void MemoryBus::transmit(const Candidate& winner) {
  count_idle_bits(winner.start);
  Port& node = ports_[winner.port];
  wire_ = winner.frame;
  sender_ = winner.port;
  is_babble_ = winner.slot == kMaxPending;
  const std::uint32_t whole = frame_length(wire_.frame).bits;
  if (is_babble_) {
    const double every_ns = static_cast<double>(span_of(whole).ns) / node.babble->share;
    node.babble->next = std::max(node.babble->next, winner.start - span_of(whole)) +
                        nanoseconds(static_cast<std::int64_t>(every_ns));
  } else {
    node.queue[winner.slot] = node.queue[--node.waiting];  // order is by key and sequence
  }
  const auto error = error_bit(node, whole - kInterframeBits);
  const std::uint32_t bits = error ? *error + kErrorFrameBits + kInterframeBits : whole;
  is_destroyed_ = error.has_value();
  wire_ends_ = winner.start + span_of(bits - kInterframeBits);
  free_at_ = winner.start + span_of(bits);
  on_wire_ = true;
  counters_.bits += bits;
  account_busy(winner.start, free_at_);
}

// How many bits were sent when the frame was destroyed; none: it is whole. Nothing is drawn while
// nothing is wrong.
std::optional<std::uint32_t> MemoryBus::error_bit(const Port& sender, std::uint32_t bits) {
  const double whole = std::pow(1.0 - bit_error_, bits) * (1.0 - sender.send_failure);
  if (whole >= 1.0 || random_.uniform() < whole) return std::nullopt;
  return static_cast<std::uint32_t>(1 + random_.below(bits));
}

void MemoryBus::complete() {
  on_wire_ = false;
  let_frame_end();
  Port& node = ports_[sender_];
  if (is_destroyed_) {
    destroyed();
  } else {
    ++counters_.sent;
    ++node.sent;
    can_bus::sent(node.confinement);
    if (node.waiting > 0)
      node.blocked_since = wire_ends_;
    else
      node.blocked_since.reset();
    deliver();
  }
  if (state_of(node.confinement) == ErrorState::kPassive)
    node.suspended_until = free_at_ + span_of(kSuspendBits);
}

void MemoryBus::deliver() {
  for (std::uint8_t p = 0; p < config_.ports; ++p) {
    Port& node = ports_[p];
    if (p == sender_ || !node.connected || node.confinement.bus_off) continue;
    can_bus::receive(node.confinement);
    if (deliveries_.size() == kMaxDeliveries) {
      ++counters_.lost;
      continue;
    }
    deliveries_.push_back({p, sender_, {wire_.frame, wire_ends_}});
  }
}

void MemoryBus::destroyed() {
  ++counters_.error_frames;
  for (std::uint8_t p = 0; p < config_.ports; ++p)
    if (p != sender_ && ports_[p].connected) note_receive_error(ports_[p].confinement);
  if (failed_to_send(ports_[sender_].confinement)) return go_bus_off(ports_[sender_]);
  if (!is_babble_) send_again();
}

void MemoryBus::send_again() {
  Port& node = ports_[sender_];
  for (const Pending& waiting : node.waiting_frames())
    if (waiting.key == wire_.key) {  // a newer one
      ++counters_.overwritten;
      ++node.dropped;
      return;
    }
  if (node.waiting == kMaxPending || !node.connected) {
    ++counters_.lost;
    ++node.dropped;
    return;
  }
  node.queue[node.waiting++] = wire_;
}

// Bus-off: the driver throws away what waits.
void MemoryBus::go_bus_off(Port& node) {
  node.dropped += node.waiting + (is_babble_ ? 0U : 1U);
  node.waiting = 0;
}

// For those that recover.
void MemoryBus::count_idle_bits(Instant until) {
  if (until <= idle_from_) return;
  if (std::none_of(ports_.begin(), ports_.end(),
                   [](const Port& node) { return node.confinement.recovering; })) {
    idle_from_ = until;
    return;
  }
  const std::int64_t bits = (until - idle_from_).ns * config_.bit_rate / kNanosecondsPerSecond;
  idle_from_ += span_of(static_cast<std::uint32_t>(bits));
  for (Port& node : ports_) see_idle_bits(node.confinement, static_cast<std::uint64_t>(bits));
}

void MemoryBus::let_frame_end() {
  idle_from_ = free_at_;
  for (Port& node : ports_) see_frame(node.confinement);
}

void MemoryBus::account_busy(Instant from, Instant until) {
  while (from < until) {
    roll_load_window(from);
    const Instant edge = Instant{} + kLoadBucket * (from.ns / kLoadBucket.ns + 1);
    const Instant end = std::min(edge, until);
    busy_ns_[static_cast<std::size_t>(bucket_) % kLoadBuckets] += (end - from).ns;
    from = end;
  }
}

void MemoryBus::roll_load_window(Instant now) {
  const std::int64_t bucket = now.ns / kLoadBucket.ns;
  if (bucket - bucket_ > static_cast<std::int64_t>(kLoadBuckets)) {
    busy_ns_.fill(0);
    bucket_ = bucket;
  }
  while (bucket_ < bucket) busy_ns_[static_cast<std::size_t>(++bucket_) % kLoadBuckets] = 0;
}

double MemoryBus::load() const {
  std::int64_t busy_ns = 0;
  const std::size_t newest = static_cast<std::size_t>(bucket_) % kLoadBuckets;
  for (std::size_t i = 0; i < kLoadBuckets; ++i)
    if (i != newest) busy_ns += busy_ns_[i];
  const Duration window = kLoadBucket * static_cast<std::int64_t>(kLoadBuckets - 1);
  return static_cast<double>(busy_ns) / static_cast<double>(window.ns);
}

}  // namespace pitwall::can_bus
