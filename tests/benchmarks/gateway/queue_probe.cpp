// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/gateway/queue_probe.hpp"

#include <utility>

#include "protocol/transport/clock.hpp"

namespace pitwall::load {
namespace {

constexpr int kBufferBytes = 192 << 10;  // 512 frames: 20 ms of the traffic
constexpr std::size_t kProbeRead = 1'024;

}  // namespace

QueueProbe::QueueProbe(transport::CanSocket bus) : bus_(std::move(bus)), frames_(kProbeRead) {}

Result<QueueProbe, Problem> QueueProbe::open(const std::string& interface) {
  auto bus = transport::CanSocket::open(interface, {.filters = {{kNumberedId, kNumberedMask}},
                                                    .receive_errors = false,
                                                    .receive_buffer_bytes = kBufferBytes});
  if (!bus) return Unexpected{bus.error()};
  return QueueProbe{*std::move(bus)};
}

void QueueProbe::poll() {
  if (paused_) return;
  while (const std::size_t count = bus_.receive(frames_)) {
    for (std::size_t i = 0; i < count; ++i) take(frames_[i].frame);
    if (count < frames_.size()) break;
  }
  bus_.poll_drops();
}

void QueueProbe::take(const can::Frame& frame) {
  const std::uint64_t number = number_of(frame);
  missing_ += number - next_;
  next_ = number + 1;
  if (!open_) return;
  losses_.back().missing = missing_;
  open_ = false;
}

void QueueProbe::resume() {
  const Instant begun = transport::monotonic_now();
  paused_ = false;
  poll();
  losses_.push_back(
      {.counted = bus_.counters().rx_dropped_queue, .after = transport::monotonic_now() - begun});
  open_ = true;
}

void QueueProbe::settle_trailing(std::uint64_t numbered_sent) {
  if (!open_) return;
  losses_.back().missing = missing_ + numbered_sent - next_;
  losses_.back().trailing = true;
  open_ = false;
}

}  // namespace pitwall::load
