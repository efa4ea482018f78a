// Addresses of the peer on one path: one that the peer has proved to be at, and at most one
// candidate from which an authentic packet came but that has yet to prove itself.
//
//   newest authentic packet from B     token comes back from B
//   A proved ------------------------> A proved, B on trial -------------> B proved
//
//   invariants
//          only a packet newer than all before begins a trial: a replayed or late one redirects
//          nothing. An address on trial gets at most kTrust times the bytes that came from it
//          while packets that are not older than the trial still come from the proved address, the
//          other one is a relay's or a copier's: it stays on trial, whatever it proves
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocol/telemetry/session/address.hpp"
#include "protocol/telemetry/session/crypto/randomness.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

class PathAddresses {
 public:
  static constexpr std::uint64_t kTrust = 3;
  // For so long after its last packet the proved address counts as in use. Two slots and the
  // jitter of a loop.
  static constexpr Duration kInUse = milliseconds(60);

  void prove(Address at);  // known by other means: the car's file, or the exchange
  // An authentic packet came, or a copy of one.
  struct Arrival {
    Address from;
    std::size_t size = 0;
    std::uint64_t number = 0;
    bool newest = false;  // of all that came by this path
  };
  void receive(const Arrival& arrival, Instant now, Randomness& randomness);
  // True where this makes the address on trial the proved one.
  bool take_proof(Address from, std::uint64_t token, Instant now);

  FixedVector<Address, 2> targets(std::size_t size) const;
  void note_sent(Address to, std::size_t size);
  std::optional<std::uint64_t> token() const;
  Address proved() const { return proved_; }

 private:
  friend struct Fingerprint;  // of the exhaustive explorer, which compares states
  struct Trial {
    Address address;
    std::uint64_t token = 0, received = 0, sent = 0;
    std::uint64_t first = 0;           // number of the packet that began it
    std::optional<Instant> opposed{};  // by a packet from the proved address that is not older
  };

  Address proved_;
  std::optional<Trial> trial_;
};

}  // namespace pitwall::telemetry
