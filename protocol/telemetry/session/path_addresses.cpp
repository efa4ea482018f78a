// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/path_addresses.hpp"

#include "protocol/telemetry/little_endian.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

void PathAddresses::prove(Address at) {
  proved_ = at;
  trial_.reset();
}

void PathAddresses::heard(Address from, std::size_t size, bool newest, Randomness& randomness) {
  if (trial_ && trial_->address == from) {
    trial_->received += size;
    return;
  }
  if (!newest) return;
  if (from == proved_) {
    trial_.reset();  // it is where it was
    return;
  }
  std::array<std::uint8_t, sizeof(std::uint64_t)> token{};
  randomness.fill(token);
  trial_ = Trial{.address = from, .token = load<std::uint64_t>(token, 0), .received = size};
}

bool PathAddresses::take_proof(Address from, std::uint64_t token) {
  if (!trial_ || trial_->address != from || trial_->token != token) return false;
  prove(from);
  return true;
}

FixedVector<Address, 2> PathAddresses::targets(std::size_t size) const {
  FixedVector<Address, 2> targets;
  if (proved_.known()) CHECK(targets.push(proved_));
  if (trial_ && trial_->sent + size <= kTrust * trial_->received) {
    CHECK(targets.push(trial_->address));
  }
  return targets;
}

void PathAddresses::note_sent(Address to, std::size_t size) {
  if (trial_ && trial_->address == to) trial_->sent += size;
}

std::optional<std::uint64_t> PathAddresses::token() const {
  if (!trial_) return std::nullopt;
  return trial_->token;
}

}  // namespace pitwall::telemetry
