// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/crypto/noise_kk.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

namespace {

constexpr std::string_view kName = "Noise_KK_25519_ChaChaPoly_BLAKE2b";
static_assert(kName.size() <= kHashSize);  // then the name itself, padded, is the first hash

constexpr std::uint8_t kFirst = 1, kSecond = 2;  // HKDF, section 4.3

std::pair<Hash, Hash> hkdf(const Hash& chain, Bytes input) {
  const Hash secret = hmac(chain.span(), {input});
  const Hash first = hmac(secret.span(), {Bytes{&kFirst, 1}});
  const Hash second = hmac(secret.span(), {first.span(), Bytes{&kSecond, 1}});
  return {first, second};
}

Key key_of(const Hash& hash) {
  Key key;
  std::copy_n(hash.bytes.begin(), kKeySize, key.bytes.begin());
  return key;
}

}  // namespace

NoiseKk::NoiseKk(Side side, const Identity& own, const PublicKey& peer, Bytes prologue)
    : side_(side), own_(own), peer_(peer) {
  std::copy(kName.begin(), kName.end(), hash_.bytes.begin());
  chain_ = hash_;
  mix_hash(prologue);
  const bool initiator = side == Side::kInitiator;
  mix_hash(initiator ? own.public_key : peer);
  mix_hash(initiator ? peer : own.public_key);
}

bool NoiseKk::write(const Key& ephemeral, Bytes payload, std::span<std::uint8_t> out) {
  CHECK(out.size() == payload.size() + kNoiseOverhead);
  ephemeral_ = ephemeral;
  const PublicKey shown = public_of(ephemeral);
  std::copy(shown.begin(), shown.end(), out.begin());
  mix_hash(shown);
  if (!mix_tokens(true)) return false;
  const auto sealed = out.subspan(kKeySize);
  aead_seal(key_, 0, hash_.span(), payload, sealed);
  mix_hash(sealed);
  return true;
}

bool NoiseKk::read(Bytes message, std::span<std::uint8_t> payload) {
  CHECK(message.size() == payload.size() + kNoiseOverhead);
  std::copy_n(message.begin(), kKeySize, peer_ephemeral_.begin());
  mix_hash(peer_ephemeral_);
  if (!mix_tokens(false)) return false;
  const auto sealed = message.subspan(kKeySize);
  if (!aead_open(key_, 0, hash_.span(), sealed, payload)) return false;
  mix_hash(sealed);
  return true;
}

NoiseKk::Keys NoiseKk::split() const {
  CHECK(messages_ == 2);
  const auto [first, second] = hkdf(chain_, {});
  return {key_of(first), key_of(second)};
}

void NoiseKk::mix_hash(Bytes bytes) { hash_ = hash_of({hash_.span(), bytes}); }

void NoiseKk::mix_key(const Key& shared) {
  const auto [chain, key] = hkdf(chain_, shared.span());
  chain_ = chain;
  key_ = key_of(key);
}

bool NoiseKk::mix_agreement(const Key& own, const PublicKey& other) {
  Key shared;
  if (!agree(own, other, shared)) return false;
  mix_key(shared);
  return true;
}

// es, ss
bool NoiseKk::mix_first(bool writing) {
  const bool es =
      writing ? mix_agreement(ephemeral_, peer_) : mix_agreement(own_.secret_key, peer_ephemeral_);
  return es && mix_agreement(own_.secret_key, peer_);
}

// ee, se
bool NoiseKk::mix_second(bool writing) {
  if (!mix_agreement(ephemeral_, peer_ephemeral_)) return false;
  return writing ? mix_agreement(ephemeral_, peer_)
                 : mix_agreement(own_.secret_key, peer_ephemeral_);
}

bool NoiseKk::mix_tokens(bool writing) {
  const bool first = messages_++ == 0;
  CHECK(messages_ <= 2 && writing == ((side_ == Side::kInitiator) == first));
  return first ? mix_first(writing) : mix_second(writing);
}

}  // namespace pitwall::telemetry
