// SPDX-License-Identifier: Apache-2.0
#include "hil/bus/memory_bus.hpp"

#include <algorithm>

#include "hil/bus/frame_length.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::bus {

MemoryBus::MemoryBus(const BusConfig& config) : config_(config) {
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
  const std::uint32_t key = arbitration_key(frame);
  for (std::size_t i = 0; i < node.waiting; ++i) {
    if (node.queue[i].key != key) continue;
    node.queue[i].frame =
        frame;  // keeps its place: it has been contending since it was first offered
    ++counters_.overwritten;
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

// Begins every frame whose arbitration lies strictly before `now`: others may still be offered at
// it.
void MemoryBus::simulate_until(Instant now) {
  if (now < now_) return;
  while (true) {
    if (on_wire_ && wire_.at <= now) complete();
    if (on_wire_) break;
    const Candidate winner = next_candidate();
    if (!winner.found || winner.start >= now) break;
    transmit(winner);
  }
  now_ = now;
  roll_load_window(now);
}

MemoryBus::Candidate MemoryBus::next_candidate() const {
  // The earliest instant at which the bus is free and somebody wants to send.
  Instant start{};
  bool any = false;
  for (std::uint8_t p = 0; p < config_.ports; ++p)
    for (const Pending& waiting : ports_[p].waiting_frames()) {
      const Instant ready = std::max(waiting.since, free_at_);
      if (!any || ready < start) start = ready;
      any = true;
    }
  Candidate best{.start = start};
  const Pending* leader = nullptr;
  for (std::uint8_t p = 0; p < config_.ports; ++p)
    for (std::size_t i = 0; i < ports_[p].waiting; ++i) {
      const Pending& waiting = ports_[p].queue[i];
      if (waiting.since > start) continue;
      if (leader != nullptr && (leader->key < waiting.key || (leader->key == waiting.key &&
                                                              leader->sequence < waiting.sequence)))
        continue;
      leader = &waiting;
      best = {true, p, i, start};
    }
  return best;
}

void MemoryBus::transmit(const Candidate& winner) {
  Port& node = ports_[winner.port];
  const can::Frame frame = node.queue[winner.slot].frame;
  node.queue[winner.slot] = node.queue[--node.waiting];  // order is by key and sequence

  const std::uint32_t bits = frame_length(frame).bits;
  const auto span = [&](std::uint32_t n) {
    return nanoseconds(static_cast<std::int64_t>(n) * kNanosecondsPerSecond / config_.bit_rate);
  };
  wire_ = {frame, winner.start + span(bits - kInterframeBits)};
  free_at_ = winner.start + span(bits);
  on_wire_ = true;
  sender_ = winner.port;
  counters_.bits += bits;
  account_busy(winner.start, free_at_);
}

void MemoryBus::complete() {
  on_wire_ = false;
  ++counters_.sent;
  ++ports_[sender_].sent;
  for (std::uint8_t p = 0; p < config_.ports; ++p) {
    if (p == sender_ || !ports_[p].connected) continue;
    if (deliveries_.size() == kMaxDeliveries) {
      ++counters_.lost;
      continue;
    }
    deliveries_.push_back({p, sender_, wire_});
  }
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

}  // namespace pitwall::bus
