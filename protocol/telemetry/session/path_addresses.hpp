// Where packets of one path go: an address that the peer proved to be at, and beside it at most one
// from which an authentic packet came but that has yet to prove itself.
//
//   newest authentic packet from B     token comes back from B
//   A proved ------------------------> A proved, B on trial -------------> B proved
//
//   law    only a packet newer than all before begins a trial: a replayed or late one redirects
//          nothing. An address on trial gets at most kTrust times the bytes that came from it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocol/telemetry/session/address.hpp"
#include "protocol/telemetry/session/randomness.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"

namespace pitwall::telemetry {

class PathAddresses {
 public:
  static constexpr std::uint64_t kTrust = 3;

  void prove(Address at);  // known by other means: the car's file, or the exchange
  // An authentic packet of `size` bytes came.
  void heard(Address from, std::size_t size, bool newest, Randomness& randomness);
  // True where this makes the address on trial the proved one.
  bool take_proof(Address from, std::uint64_t token);

  FixedVector<Address, 2> targets(std::size_t size) const;
  void note_sent(Address to, std::size_t size);
  std::optional<std::uint64_t> token() const;
  Address proved() const { return proved_; }

 private:
  struct Trial {
    Address address;
    std::uint64_t token = 0, received = 0, sent = 0;
  };

  Address proved_;
  std::optional<Trial> trial_;
};

}  // namespace pitwall::telemetry
