// SHA-256, streaming: the name of a file or of a type, to compare two by.
//   in     bytes in pieces of any size            out    32 bytes, or 64 hexadecimal digits
//   cost   O(bytes), no allocation but in hex()
//   source FIPS 180-4, sections 4.1.2, 5 and 6.2
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace pitwall::bits {

class Sha256 {
 public:
  using Digest = std::array<std::uint8_t, 32>;

  void update(std::span<const std::uint8_t> bytes);
  // Of everything so far; more may follow.
  Digest digest() const;

 private:
  static constexpr std::size_t kBlockBytes = 64;

  void compress(std::span<const std::uint8_t, kBlockBytes> block);

  std::array<std::uint32_t, 8> hash_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                     0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::uint8_t, kBlockBytes> block_{};
  std::uint64_t bytes_ = 0;
};

std::string to_hex(const Sha256::Digest& digest);

}  // namespace pitwall::bits
