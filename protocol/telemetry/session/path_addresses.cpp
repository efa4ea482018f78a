// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/path_addresses.hpp"

#include "protocol/vocabulary/bytes.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

void PathAddresses::prove(UdpAddress at) {
  proved_ = at;
  trial_.reset();
}

void PathAddresses::receive(const Arrival& arrival, Instant now, Randomness& randomness) {
  if (trial_ && trial_->address == arrival.from) {
    trial_->received += arrival.size;
    return;
  }
  if (arrival.from == proved_) {
    if (!trial_ || arrival.number < trial_->first) return;  // only late
    if (arrival.newest) return trial_.reset();              // it is where it was
    trial_->opposed = now;
    return;
  }
  if (!arrival.newest) return;
  std::array<std::uint8_t, sizeof(std::uint64_t)> token{};
  randomness.fill(token);
  trial_ = Trial{.address = arrival.from,
                 .token = load<std::uint64_t>(token, 0),
                 .received = arrival.size,
                 .first = arrival.number};
}

bool PathAddresses::take_proof(UdpAddress from, std::uint64_t token, Instant now) {
  if (!trial_ || trial_->address != from || trial_->token != token) return false;
  if (trial_->opposed && now - *trial_->opposed < kInUse) return false;
  prove(from);
  return true;
}

FixedVector<UdpAddress, 2> PathAddresses::targets(std::size_t size) const {
  FixedVector<UdpAddress, 2> targets;
  if (proved_.known()) CHECK(targets.push(proved_));
  if (trial_ && trial_->sent + size <= kTrust * trial_->received) {
    CHECK(targets.push(trial_->address));
  }
  return targets;
}

void PathAddresses::note_sent(UdpAddress to, std::size_t size) {
  if (trial_ && trial_->address == to) trial_->sent += size;
}

std::optional<std::uint64_t> PathAddresses::token() const {
  if (!trial_) return std::nullopt;
  return trial_->token;
}

}  // namespace pitwall::telemetry
