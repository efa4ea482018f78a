// SHA-256 by libsodium, streaming: a digest that identifies a file or a type.
//   in     bytes in pieces of any size            out    32 bytes, or 64 hexadecimal digits
//   cost   O(bytes); only to_hex() allocates
//   source FIPS 180-4
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sodium.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace pitwall::bits {

class Sha256 {
 public:
  using Digest = std::array<std::uint8_t, crypto_hash_sha256_BYTES>;

  Sha256() { crypto_hash_sha256_init(&state_); }
  void update(std::span<const std::uint8_t> bytes) {
    crypto_hash_sha256_update(&state_, bytes.data(), bytes.size());
  }
  // Digest of all bytes so far; more may follow.
  Digest digest() const {
    crypto_hash_sha256_state state = state_;
    Digest digest{};
    crypto_hash_sha256_final(&state, digest.data());
    return digest;
  }

 private:
  crypto_hash_sha256_state state_{};
};

inline std::string to_hex(const Sha256::Digest& digest) {
  std::string text(2 * digest.size() + 1, '\0');  // with the final zero that libsodium writes
  sodium_bin2hex(text.data(), text.size(), digest.data(), digest.size());
  text.pop_back();
  return text;
}

}  // namespace pitwall::bits
