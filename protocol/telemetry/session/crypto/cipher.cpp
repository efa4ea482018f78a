// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/crypto/cipher.hpp"

#include <sodium.h>

#include <algorithm>

#include "protocol/vocabulary/bytes.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

namespace {

constexpr std::size_t kHashBlock = 128;  // of BLAKE2b, RFC 7693
constexpr std::size_t kNonceSize = crypto_aead_chacha20poly1305_ietf_NPUBBYTES;
static_assert(kKeySize == crypto_scalarmult_BYTES &&
              kKeySize == crypto_aead_chacha20poly1305_ietf_KEYBYTES);
static_assert(kTagSize == crypto_aead_chacha20poly1305_ietf_ABYTES);

std::array<std::uint8_t, kNonceSize> nonce_of(std::uint64_t number) {
  std::array<std::uint8_t, kNonceSize> nonce{};
  store<std::uint64_t>(nonce, kNonceSize - sizeof(number), number);
  return nonce;
}

class Hasher {
 public:
  explicit Hasher(std::size_t size = kHashSize, Bytes key = {}) : size_(size) {
    crypto_generichash_init(&state_, key.data(), key.size(), size);
  }
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;
  ~Hasher() { sodium_memzero(&state_, sizeof(state_)); }

  void add(Bytes bytes) { crypto_generichash_update(&state_, bytes.data(), bytes.size()); }
  void finish(std::span<std::uint8_t> out) {
    CHECK(out.size() == size_);
    crypto_generichash_final(&state_, out.data(), out.size());
  }

 private:
  crypto_generichash_state state_;
  std::size_t size_;
};

}  // namespace

void wipe(std::span<std::uint8_t> bytes) { sodium_memzero(bytes.data(), bytes.size()); }

void prepare_sodium() { CHECK(sodium_init() >= 0); }

PublicKey public_of(const Key& secret) {
  PublicKey key{};
  crypto_scalarmult_base(key.data(), secret.data());
  return key;
}

bool agree(const Key& secret, const PublicKey& other, Key& shared) {
  return crypto_scalarmult(shared.data(), secret.data(), other.data()) == 0;
}

void aead_seal(const Key& key, std::uint64_t number, Bytes clear, Bytes plain,
               std::span<std::uint8_t> out) {
  CHECK(out.size() == plain.size() + kTagSize);
  crypto_aead_chacha20poly1305_ietf_encrypt(out.data(), nullptr, plain.data(), plain.size(),
                                            clear.data(), clear.size(), nullptr,
                                            nonce_of(number).data(), key.data());
}

bool aead_open(const Key& key, std::uint64_t number, Bytes clear, Bytes sealed,
               std::span<std::uint8_t> plain) {
  CHECK(sealed.size() == plain.size() + kTagSize);
  return crypto_aead_chacha20poly1305_ietf_decrypt(plain.data(), nullptr, nullptr, sealed.data(),
                                                   sealed.size(), clear.data(), clear.size(),
                                                   nonce_of(number).data(), key.data()) == 0;
}

Hash hash_of(std::initializer_list<Bytes> parts) {
  Hasher hasher;
  for (const Bytes part : parts) hasher.add(part);
  Hash hash;
  hasher.finish(hash.bytes);
  return hash;
}

Hash hmac(Bytes key, std::initializer_list<Bytes> parts) {
  constexpr std::uint8_t kInner = 0x36, kOuter = 0x5C;
  CHECK(key.size() <= kHashBlock);
  Secret<kHashBlock> inner, outer;
  std::copy(key.begin(), key.end(), inner.bytes.begin());
  outer = inner;
  for (std::uint8_t& byte : inner.bytes) byte ^= kInner;
  for (std::uint8_t& byte : outer.bytes) byte ^= kOuter;
  Hasher hasher;
  hasher.add(inner.span());
  for (const Bytes part : parts) hasher.add(part);
  Hash hash;
  hasher.finish(hash.bytes);
  return hash_of({outer.span(), hash.span()});
}

Key derive(const Key& key, Bytes purpose) {
  Hasher hasher(kKeySize, key.span());
  hasher.add(purpose);
  Key derived;
  hasher.finish(derived.bytes);
  return derived;
}

Tag keyed_tag(const Key& key, std::initializer_list<Bytes> parts) {
  Hasher hasher(kTagSize, key.span());
  for (const Bytes part : parts) hasher.add(part);
  Tag tag{};
  hasher.finish(tag);
  return tag;
}

bool same(Bytes a, Bytes b) {
  CHECK(a.size() == b.size());
  return sodium_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace pitwall::telemetry
