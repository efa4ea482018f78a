// Key exchange of two ends with known public keys: Noise_KK_25519_ChaChaPoly_BLAKE2b.
//
//   initiator -- e, es, ss --> responder        write() then read()
//             <-- e, ee, se --                  read() then write()
//
//   in     own pair, the other end's public key, a prologue that both ends share, payloads
//   out    messages; after both of them one key for each direction
//   invariants
//          after read() refuses a message, the state is invalid and must be discarded
//   errors false: the other end did not write the message for this exchange
//   cost   write or read 150 us; no allocation
//   source The Noise Protocol Framework, revision 34, sections 4, 5, 7.5
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "protocol/telemetry/session/crypto/cipher.hpp"
#include "protocol/telemetry/session/crypto/keys.hpp"

namespace pitwall::telemetry {

inline constexpr std::size_t kNoiseOverhead = kKeySize + kTagSize;  // of a message

class NoiseKk {
 public:
  enum class Side : std::uint8_t { kInitiator, kResponder };

  NoiseKk(Side side, const Identity& own, const PublicKey& peer, Bytes prologue);

  // `ephemeral`: 32 fresh random bytes; `out` holds payload.size() + kNoiseOverhead bytes.
  [[nodiscard]] bool write(const Key& ephemeral, Bytes payload, std::span<std::uint8_t> out);
  // `payload` holds message.size() - kNoiseOverhead bytes.
  [[nodiscard]] bool read(Bytes message, std::span<std::uint8_t> payload);

  struct Keys {
    Key from_initiator, from_responder;
  };
  Keys split() const;  // after both messages
  const Hash& transcript() const { return hash_; }

 private:
  void mix_hash(Bytes bytes);
  void mix_key(const Key& shared);
  [[nodiscard]] bool mix_agreement(const Key& own, const PublicKey& other);
  [[nodiscard]] bool mix_first(bool writing);
  [[nodiscard]] bool mix_second(bool writing);
  [[nodiscard]] bool mix_tokens(bool writing);

  Side side_;
  Identity own_;
  PublicKey peer_;
  Hash chain_, hash_;
  Key key_, ephemeral_;
  PublicKey peer_ephemeral_{};
  int messages_ = 0;
};

}  // namespace pitwall::telemetry
