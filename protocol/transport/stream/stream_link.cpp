// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/stream/stream_link.hpp"

#include <utility>

#include "protocol/transport/readiness.hpp"
#include "protocol/transport/stream/serial_port.hpp"

namespace pitwall::transport {

std::span<const std::uint8_t> StreamLink::read(std::span<std::uint8_t> into, Instant now) {
  advance(now);
  if (state_ != State::kOpen) return {};
  const ReadOutcome got = read_now(fd_.get(), into);
  if (got.ended) {
    close(now, counters_.ended);
    return {};
  }
  if (got.bytes > 0) since_ = now;
  counters_.bytes += got.bytes;
  const bool may_hang = std::holds_alternative<TcpAddress>(target_);
  if (may_hang && now - since_ > kTimeout) close(now, counters_.silent);
  return into.first(got.bytes);
}

void StreamLink::advance(Instant now) {
  if (state_ == State::kClosed && now >= not_before_ && !begin(now)) close(now, counters_.refused);
  if (state_ != State::kOpening) return;
  const auto outcome = connect_outcome(fd_.get());
  if (outcome && outcome->ok()) {
    state_ = State::kOpen;
    since_ = now;
    ++counters_.opened;
    return;
  }
  if (outcome || now - since_ > kTimeout) close(now, counters_.refused);
}

// A serial device is open at once.
bool StreamLink::begin(Instant now) {
  since_ = now;
  if (const auto* device = std::get_if<SerialDevice>(&target_)) {
    auto opened = open_serial(device->path, device->baud);
    if (!opened) return false;
    fd_ = *std::move(opened);
    state_ = State::kOpen;
    ++counters_.opened;
    return true;
  }
  auto begun = begin_connect(std::get<TcpAddress>(target_));
  if (!begun) return false;
  fd_ = *std::move(begun);
  state_ = State::kOpening;
  return true;
}

void StreamLink::close(Instant now, std::uint64_t& counter) {
  ++counter;
  fd_.reset();
  state_ = State::kClosed;
  not_before_ = now + kPause;
}

}  // namespace pitwall::transport
