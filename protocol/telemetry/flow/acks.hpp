// Acknowledgement state of one end: ReceivedPackets for the packets received, whose Ack goes into
// each packet; SentPackets for the packets sent and their acknowledgements.
//   invariants
//          a packet is acknowledged at most once; a packet that an Ack does not name has an unknown
//          state, it is not lost
//   units  64-bit sequence numbers of one session, from 1
//   errors an Ack that names a packet that was never sent is counted and ignored as a whole; an Ack
//          for packets that are no longer kept is ignored
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "protocol/telemetry/packet/body.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr std::size_t kAckNames = 33;  // the newest and its mask

class ReceivedPackets {
 public:
  void received(std::uint64_t sequence, Instant at);
  // An empty optional until a packet is received.
  std::optional<Ack> ack(Instant now) const;
  void forget() { *this = {}; }

 private:
  std::uint64_t newest_ = 0;
  std::uint32_t mask_ = 0;
  Instant newest_at_{};
};

struct Delivery {
  std::uint64_t sequence = 0;
  Instant sent{};
  std::size_t bytes = 0;
};

class SentPackets {
 public:
  static constexpr std::size_t kKept = 256;

  // CHECKs that sequence numbers increase.
  void sent(std::uint64_t sequence, Instant at, std::size_t bytes);
  struct News {
    FixedVector<Delivery, kAckNames> delivered;  // acknowledged for the first time
    // Newest packet that the Ack names, for the clock; empty if the hold time is saturated.
    std::optional<Delivery> newest;
  };
  News take(const Ack& ack);
  std::uint64_t nonsense() const { return nonsense_; }
  void forget();  // a new session; the counter stays

 private:
  struct Entry {
    Delivery delivery;
    bool acked = false;
  };
  // nullptr: older than the kept packets, or never sent.
  const Entry* find(std::uint64_t sequence) const;
  bool makes_sense(std::uint64_t newest, std::uint32_t mask) const;
  void note(std::uint64_t sequence, News& news);

  std::array<Entry, kKept> kept_{};
  std::uint64_t oldest_ = 0, newest_ = 0, nonsense_ = 0;
};

}  // namespace pitwall::telemetry
