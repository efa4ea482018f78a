// Session: the keys of one key exchange, the numbers by which both ends know it, and what the other
// end told of itself.
//   in     what an exchange agreed on; the session whose numbers go on, if it renews one
//   out    what seals and opens packets
//   invariants
//          a renewed session seals on from the number of the one before and refuses what that one
//          had, so that a packet counts once whichever keys it came with
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

// Tells the key log of it, unless one of both ends is a real car. `renewed`: the session that it
// goes on from; none: its numbers begin.
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
