// Addresses of the peer on one path: the validated one, and at most one on trial, from which an
// authentic packet came but which is not yet validated.
//
//   newest authentic packet from B     token comes back from B
//   A proved ------------------------> A proved, B on trial -------------> B proved
//
//   invariants
//          only a packet newer than all before begins a trial: a replayed or late packet redirects
//          no traffic. An address on trial gets at most kTrust times the bytes that came from it
//          while packets as new as the trial still come from the validated address, the other
//          address is that of a relay: it stays on trial even with the right token
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocol/telemetry/session/crypto/randomness.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/udp_address.hpp"

namespace pitwall::telemetry {

class PathAddresses {
 public:
  static constexpr std::uint64_t kTrust = 3;
  // The validated address counts as in use for this time after its last packet: two slots and the
  // jitter of a loop.
  static constexpr Duration kInUse = milliseconds(60);

  void prove(UdpAddress at);  // sets a validated address: from the car's file, or by the exchange
  // Arrival of an authentic packet or of a copy of one.
  struct Arrival {
    UdpAddress from;
    std::size_t size = 0;
    std::uint64_t number = 0;
    bool newest = false;  // the newest of all packets on this path
  };
  void receive(const Arrival& arrival, Instant now, Randomness& randomness);
  // Returns true if the token validates the address on trial.
  bool take_proof(UdpAddress from, std::uint64_t token, Instant now);

  // Destinations of packets: the validated address, and the address on trial if `size` more bytes
  // may be sent there.
  FixedVector<UdpAddress, 2> targets(std::size_t size) const;
  void note_sent(UdpAddress to, std::size_t size);
  UdpAddress proved() const { return proved_; }
  bool on_trial() const { return trial_.has_value(); }
  // Payload of the kPathProbe for the next packet to the address on trial.
  std::optional<std::uint64_t> token() const;

 private:
  friend struct Fingerprint;  // for the exhaustive state exploration of the tests
  struct Trial {
    UdpAddress address;
    std::uint64_t token = 0, received = 0, sent = 0;
    std::uint64_t first = 0;  // number of the packet that began it
    // Time of the last packet from the validated address that is not older than the trial.
    std::optional<Instant> opposed{};
  };

  UdpAddress proved_;
  std::optional<Trial> trial_;
};

}  // namespace pitwall::telemetry
