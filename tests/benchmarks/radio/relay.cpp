// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/relay.hpp"

namespace pitwall::radio {

using telemetry::PathId;

Relay::Relay(VirtualRadio& radio, Duration way, Duration ahead)
    : radio_(radio), way_(way), ahead_(ahead) {
  radio.tap([this](bool down, PathId path, std::span<const std::uint8_t> bytes) {
    take(down, path, bytes, way_ - ahead_);
    return true;
  });
  radio.listen([this](bool down, PathId path, std::uint16_t port, auto bytes) {
    if (port == kAddress.port) take(down, path, bytes, Duration{});
  });
}

Relay::~Relay() {
  radio_.tap({});
  radio_.listen({});
}

void Relay::take(bool down, PathId path, std::span<const std::uint8_t> bytes, Duration way) {
  if (active_) copies_.push_back({radio_.now() + way, down, path, {bytes.begin(), bytes.end()}});
}

void Relay::step() {
  std::deque<Copy> later;
  std::deque<Copy> now;
  now.swap(copies_);
  for (Copy& copy : now) {
    if (copy.at > radio_.now()) {
      later.push_back(std::move(copy));
      continue;
    }
    if (!active_) continue;
    ++forwarded_;
    radio_.inject(copy.down, copy.path, kAddress, copy.bytes);
  }
  later.insert(later.end(), copies_.begin(), copies_.end());
  copies_ = std::move(later);
}

}  // namespace pitwall::radio
