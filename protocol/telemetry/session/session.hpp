// Session: the keys of one key exchange, its number at each end, and the greeting of the peer.
//   in     the result of an exchange; the session that it renews, if any
//   out    Sealer and Opener for the packets of the session
//   invariants
//          a renewed session continues the packet numbers and the replay window of the one before,
//          so that a packet is accepted once under any of its keys
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/telemetry/session/crypto/noise_kk.hpp"
#include "protocol/telemetry/session/exchange.hpp"
#include "protocol/telemetry/session/key_log.hpp"
#include "protocol/telemetry/session/traffic.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

struct Session {
  std::uint16_t own_number, peer_number;
  Sealer sealer;
  Opener opener;
  Greeting peer;
};

struct SessionTerms {
  const KeyFile& keys;
  std::uint64_t first_sequence;
  const KeyLog& key_log;
};

// Makes a session. Its keys are written to the key log if they are bench keys and the peer is not a
// real car. `renewed`: the session that it renews; nullptr: packet numbers start again.
inline Session make_session(const SessionTerms& terms, const NoiseKk& noise,
                            std::uint16_t own_number, const ExchangePayload& payload,
                            const Session* renewed, Instant now) {
  const NoiseKk::Keys agreed = noise.split();
  const bool car = terms.keys.role == Role::kCar;
  const Key& own = car ? agreed.from_initiator : agreed.from_responder;
  const Key& theirs = car ? agreed.from_responder : agreed.from_initiator;
  if (terms.key_log && terms.keys.bench && !payload.greeting.real_car) {
    terms.key_log(key_log_lines(payload.number, own) + key_log_lines(own_number, theirs));
  }
  return {.own_number = own_number,
          .peer_number = payload.number,
          .sealer = Sealer(own, renewed ? renewed->sealer.next() : terms.first_sequence, now),
          .opener = renewed ? Opener(theirs, now, renewed->opener.window()) : Opener(theirs, now),
          .peer = payload.greeting};
}

}  // namespace pitwall::telemetry
