// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/crypto/randomness.hpp"

#include <sodium.h>

#include <array>

#include "protocol/telemetry/session/crypto/cipher.hpp"
#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::telemetry {

void SystemRandomness::fill(std::span<std::uint8_t> bytes) {
  prepare_sodium();
  randombytes_buf(bytes.data(), bytes.size());
}

void SeededRandomness::fill(std::span<std::uint8_t> bytes) {
  std::array<std::uint8_t, crypto_stream_chacha20_KEYBYTES> key{};
  std::array<std::uint8_t, crypto_stream_chacha20_NONCEBYTES> nonce{};
  store<std::uint64_t>(key, 0, seed_);
  store<std::uint64_t>(nonce, 0, block_++);
  crypto_stream_chacha20(bytes.data(), bytes.size(), nonce.data(), key.data());
}

}  // namespace pitwall::telemetry
